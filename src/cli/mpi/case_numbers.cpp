#include "cli/mpi/case_numbers.h"

#include <algorithm>

#include "base/sort.h"
#include "cli/mpi/count_keys.h"

namespace mandoline::cli {
namespace {

using detail::PolyMesh;
using detail::PolyPatch;
using detail::PolySide;

class Numberer {
 public:
  Numberer(detail::Communicator& comm, const RankComplex& complex, const detail::PolyFiles& files)
      : comm_(comm),
        complex_(complex),
        cells_(complex.cells),
        files_(files),
        mesh_(files.mesh),
        patches_(mesh_.patches.size() - complex.seams.size()) {}

  CaseNumbers run() {
    CaseNumbers numbers;
    numbers.cells = numbered(complex_.cellIds, [&](size_t c) { return isWritten(int32_t(c)); });
    numbers.points = numbered(complex_.vertexIds, [&](size_t v) { return mesh_.pointNumbers[v] != PolyMesh::kUnused; });
    comm_.together(kNoun, [&] {
      first_.assign(2 * cells_.faceCount(), 0);
      sortInner();
    });
    numberInner();
    for (size_t p = 0; p < patches_; ++p) numberPatch(mesh_.patches[p].sides);
    exchange();
    comm_.together(kNoun, [&] { numbers.faces = list(); });
    return numbers;
  }

 private:
  static constexpr const char* kNoun = "writing";

  bool isOwn(int32_t cell) const { return complex_.cellRanks[size_t(cell)] == comm_.rank(); }

  bool isWritten(int32_t cell) const { return mesh_.cellNumbers[size_t(cell)] != PolySide::kLeftOut; }

  uint64_t polygonsOf(size_t face) const {
    uint64_t count = 0;
    files_.polygons.forEach(face, [&](std::span<const uint32_t>) { ++count; });
    return count;
  }

  /// Those that are written, by their ids.
  template <class IsWritten>
  std::vector<uint64_t> numbered(const std::vector<uint64_t>& ids, const IsWritten& isWritten) {
    std::vector<KeyCount> keys;
    comm_.together(kNoun, [&] {
      for (size_t i = 0; i < ids.size(); ++i) {
        if (isWritten(i)) keys.push_back({ids[i], 1});
      }
    });
    return countKeys(comm_, keys).before;
  }

  /// Inner faces whose owner is a cell of this process, by owner and neighbour.
  void sortInner() {
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t a = cells_.faceCells[2 * size_t(f)], b = cells_.faceCells[2 * size_t(f) + 1];
      if (cells_.faceTag[f] == FaceTag::inner && a >= 0 && b >= 0 && isOwn(std::min(a, b)) && isWritten(std::min(a, b)))
        inner_.push_back({std::min(a, b), std::max(a, b), f});
    }
    detail::sortItems(inner_, detail::isUpperBefore);
  }

  void numberInner() {
    std::vector<KeyCount> owners;
    comm_.together(kNoun, [&] {
      for (const Inner& face : inner_) {
        const uint64_t id = complex_.cellIds[size_t(face.owner)];
        if (owners.empty() || owners.back().key != id) owners.push_back({id, 0});
        owners.back().count += polygonsOf(face.face);
      }
    });
    const KeysBefore found = countKeys(comm_, owners);
    size_t owner = 0;
    uint64_t next = 0;
    for (size_t i = 0; i < inner_.size(); ++i) {
      const bool isFirst = i == 0 || inner_[i].owner != inner_[i - 1].owner;
      if (isFirst) next = found.before[owner++];
      first_[2 * size_t(inner_[i].face)] = first_[2 * size_t(inner_[i].face) + 1] = next;
      next += polygonsOf(inner_[i].face);
    }
    begin_ = found.all;
  }

  /// By face and side.
  void numberPatch(const std::vector<PolySide>& sides) {
    std::vector<KeyCount> keys;
    comm_.together(kNoun, [&] {
      for (const PolySide& side : sides)
        keys.push_back({2 * complex_.faceIds[side.halfFace / 2] + side.halfFace % 2, polygonsOf(side.halfFace / 2)});
    });
    const KeysBefore found = countKeys(comm_, keys);
    for (size_t i = 0; i < sides.size(); ++i) first_[sides[i].halfFace] = begin_ + found.before[i];
    begin_ += found.all;
  }

  /// The processes tell each other the numbers of the inner faces between them, which that of the owner knows.
  void exchange() {
    std::vector<std::vector<uint64_t>> numbers;  // per process
    const auto forInner = [&](const ComplexSeam& seam, const auto& visit) {
      for (const uint32_t f : seam.faces) {
        if (cells_.faceTag[f] == FaceTag::inner) visit(f);
      }
    };
    comm_.together(kNoun, [&] {
      numbers.resize(size_t(comm_.size()));
      for (const ComplexSeam& seam : complex_.seams)
        forInner(seam, [&](uint32_t f) { numbers[size_t(seam.rank)].push_back(first_[2 * size_t(f)]); });
    });
    numbers = comm_.exchangeAll(numbers);
    comm_.together(kNoun, [&] {
      for (const ComplexSeam& seam : complex_.seams) {
        size_t next = 0;
        forInner(seam, [&](uint32_t f) {
          const uint64_t theirs = numbers[size_t(seam.rank)].at(next++);
          if (!isOwn(std::min(cells_.faceCells[2 * size_t(f)], cells_.faceCells[2 * size_t(f) + 1])))
            first_[2 * size_t(f)] = first_[2 * size_t(f) + 1] = theirs;
        });
      }
    });
  }

  std::vector<uint64_t> list() const {
    std::vector<uint64_t> numbers;
    mesh_.forEach([&](const PolySide& side) {
      uint64_t number = first_[side.halfFace];
      files_.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) { numbers.push_back(number++); });
    });
    return numbers;
  }

  struct Inner {
    int32_t owner, neighbour;  // cells of the complex
    uint32_t face;
  };
  detail::Communicator& comm_;
  const RankComplex& complex_;
  const CellComplex& cells_;
  const detail::PolyFiles& files_;
  const PolyMesh& mesh_;
  const size_t patches_;  // of the whole
  std::vector<Inner> inner_;
  std::vector<uint64_t> first_;  // per half-face: the number of its first polygon
  uint64_t begin_ = 0;           // of the next patch
};

}  // namespace

CaseNumbers caseNumbers(detail::Communicator& comm, const RankComplex& complex, const detail::PolyFiles& files) {
  return Numberer(comm, complex, files).run();
}

}  // namespace mandoline::cli
