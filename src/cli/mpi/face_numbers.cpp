#include "cli/mpi/face_numbers.h"

#include <algorithm>
#include <numeric>

#include "base/sort.h"
#include "mpi/untouched_order.h"
#include "operators/coarsen/coarsen_runs.h"

namespace mandoline::cli {
namespace {

using detail::PolyMesh;
using detail::PolyPatch;
using detail::PolySide;

constexpr size_t kSides = 6;  // of the grid: patches before those of the surface

/// Numbers faces of one kind, of which each process has some.
struct Counter {
  uint64_t next = 0, all = 0;
};

class Numberer {
 public:
  Numberer(detail::Communicator& comm, const RankCells& mine, const PolyMesh& mesh)
      : comm_(comm), mine_(mine), cells_(mine.complex.cells), mesh_(mesh), patches_(mesh.patches.size() - mine.complex.seams.size()) {}

  std::vector<uint64_t> run(const CutMesh& common) {
    comm_.together("writing", [&] {
      order_ = orderOf(common);
      first_.assign(2 * cells_.faceCount(), 0);
      sortInner();
    });
    numberInner();
    for (size_t p = 0; p < patches_; ++p) numberPatch(p);
    exchange();
    return list();
  }

 private:
  detail::UntouchedOrder orderOf(const CutMesh& common) const {
    if (mine_.coarsening.maxLevel == 0) return detail::untouchedOrder(common, mine_.complex.allLayers);
    return detail::octreeOrder(operators::coarsenRuns(common, mine_.coarsening), mine_.complex.allLayers);
  }

  static size_t faceOf(const PolySide& side) { return side.halfFace / 2; }
  bool isOwn(int32_t cell) const { return mine_.complex.cellRanks[size_t(cell)] == comm_.rank(); }
  bool isCut(int32_t cell) const { return size_t(cell) < cells_.cutCells; }
  const detail::UntouchedCounts& before(int32_t cell) const { return order_.before[size_t(cell) - cells_.cutCells]; }

  uint64_t polygonsOf(size_t face) const {
    uint64_t count = 0;
    mine_.polygons.forEach(face, [&](std::span<const uint32_t>) { ++count; });
    return count;
  }

  /// Of so many that each process has, one process after the other.
  Counter counterOf(uint64_t here) {
    const std::vector<uint64_t> counts = comm_.gatherAll(here);
    Counter counter;
    counter.next = std::accumulate(counts.begin(), counts.begin() + comm_.rank(), uint64_t(0));
    counter.all = std::accumulate(counts.begin(), counts.end(), uint64_t(0));
    return counter;
  }

  /// Inner faces whose owner is a cell of this process, by owner and neighbour.
  void sortInner() {
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t a = cells_.faceCells[2 * size_t(f)], b = cells_.faceCells[2 * size_t(f) + 1];
      if (cells_.faceTag[f] == FaceTag::inner && a >= 0 && b >= 0 && isOwn(std::min(a, b)))
        inner_.push_back({std::min(a, b), std::max(a, b), f});
    }
    detail::sortItems(inner_, detail::isUpperBefore);
  }

  /// Those of cut-cells, process by process, then those between untouched cells.
  void numberInner() {
    uint64_t here = 0;
    for (const Inner& face : inner_) here += isCut(face.owner) ? polygonsOf(face.face) : 0;
    Counter counter = counterOf(here);
    int32_t last = -1;
    for (const Inner& face : inner_) {
      if (!isCut(face.owner) && face.owner != last) counter.next = counter.all + before(face.owner).inner;
      last = face.owner;
      first_[2 * face.face] = first_[2 * face.face + 1] = counter.next;
      counter.next += polygonsOf(face.face);
    }
    begin_ = counter.all + order_.all.inner;
  }

  /// A face of the surface between two processes is numbered by the lower one, which also has its id.
  bool numbers(const PolySide& side) const {
    const int32_t other = cells_.faceCells[side.halfFace ^ 1];
    return other < 0 || mine_.complex.cellRanks[size_t(other)] >= comm_.rank();
  }

  /// Faces that pieces of the whole's cut have, then those of untouched cells at a side of the grid.
  void numberPatch(size_t p) {
    const std::vector<PolySide>& sides = mesh_.patches[p].sides;
    std::vector<uint32_t> cut;  // half-faces, with those of the process above
    for (const PolySide& side : sides) {
      if (faceOf(side) >= cells_.cutFaces || !numbers(side)) continue;
      cut.push_back(side.halfFace);
      const int32_t other = cells_.faceCells[side.halfFace ^ 1];
      if (other >= 0 && !isOwn(other)) cut.push_back(side.halfFace ^ 1);
    }
    detail::sortItems(cut);
    uint64_t here = 0;
    for (const uint32_t h : cut) here += polygonsOf(h / 2);
    Counter counter = counterOf(here);
    for (const uint32_t h : cut) {
      first_[h] = begin_ + counter.next;
      counter.next += polygonsOf(h / 2);
    }
    for (const PolySide& side : sides) {
      if (faceOf(side) >= cells_.cutFaces) first_[side.halfFace] = begin_ + counter.all + before(cells_.faceCells[side.halfFace]).sides[p];
    }
    begin_ += counter.all + (p < kSides ? order_.all.sides[p] : 0);
  }

  /// The processes tell each other the numbers of the faces between them. Each knows those that it has given.
  void exchange() {
    std::vector<std::vector<uint64_t>> numbers;  // per process
    comm_.together("writing", [&] {
      numbers.resize(size_t(comm_.size()));
      for (const ComplexSeam& seam : mine_.complex.seams) {
        for (const uint32_t f : seam.faces)
          numbers[size_t(seam.rank)].insert(numbers[size_t(seam.rank)].end(), {first_[2 * size_t(f)], first_[2 * size_t(f) + 1]});
      }
    });
    numbers = comm_.exchangeAll(numbers);
    for (const ComplexSeam& seam : mine_.complex.seams) {
      const std::vector<uint64_t>& theirs = numbers[size_t(seam.rank)];
      for (size_t i = 0; i < theirs.size(); ++i) {
        const uint32_t h = 2 * seam.faces[i / 2] + uint32_t(i % 2);
        if (isOther(h)) first_[h] = theirs[i];
      }
    }
  }

  /// Whether the other process has numbered it.
  bool isOther(uint32_t h) const {
    const int32_t a = cells_.faceCells[h], b = cells_.faceCells[h ^ 1];
    if (cells_.faceTag[h / 2] == FaceTag::inner) return !isOwn(std::min(a, b));
    return std::min(mine_.complex.cellRanks[size_t(a)], mine_.complex.cellRanks[size_t(b)]) < comm_.rank();
  }

  std::vector<uint64_t> list() const {
    std::vector<uint64_t> numbers;
    mesh_.forEach([&](const PolySide& side) {
      uint64_t number = first_[side.halfFace];
      mine_.polygons.forEach(faceOf(side), [&](std::span<const uint32_t>) { numbers.push_back(number++); });
    });
    return numbers;
  }

  struct Inner {
    int32_t owner, neighbour;  // cells of the complex
    uint32_t face;
  };
  detail::Communicator& comm_;
  const RankCells& mine_;
  const CellComplex& cells_;
  const PolyMesh& mesh_;
  const size_t patches_;  // of the whole
  detail::UntouchedOrder order_;
  std::vector<Inner> inner_;
  std::vector<uint64_t> first_;  // per half-face: the number of its first polygon
  uint64_t begin_ = 0;           // of the next patch
};

}  // namespace

std::vector<uint64_t> faceNumbers(detail::Communicator& comm, const CutMesh& common, const RankCells& mine, const PolyMesh& mesh) {
  return Numberer(comm, mine, mesh).run(common);
}

}  // namespace mandoline::cli
