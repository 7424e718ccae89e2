#include "mpi/absorbed_cells.h"

#include <algorithm>
#include <optional>

#include "base/sort.h"
#include "mandoline/distributed.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/merge/merge_parts.h"

namespace mandoline::detail {
namespace {

constexpr const char* kDeciding = "merging of cells";

// What the first process learns of cells, by the ids of the whole.

struct KnownCell {
  uint64_t id;
  double volume;
  std::array<double, 3> centroid;
  std::array<int32_t, 3> corner;
  uint32_t region;
  uint64_t level;
};

struct KnownFace {
  uint64_t id;
  std::array<uint64_t, 2> cells;
  double area;
  std::array<double, 3> normal, centroid;
};

/// Cells that triangles are between. How many there are and where makes no difference.
struct Separated {
  std::array<uint64_t, 2> cells;
  auto operator<=>(const Separated&) const = default;
};

/// What a process tells: of its own cells, and of the faces of which it has the first cell.
class Known {
 public:
  std::vector<KnownCell> cells;
  std::vector<KnownFace> faces;
  std::vector<Separated> separated;

  Known(const RankComplex& complex, int rank) : complex_(complex), of_(complex.cells), rank_(rank) {
    findDistances();
    for (size_t c = 0; c < of_.cellCount(); ++c) {
      if (isOwn(c) && distance_[c] < kFar) addCell(c);
    }
    for (size_t f = 0; f < of_.faceCount(); ++f) {
      const int32_t a = of_.faceCells[2 * f], b = of_.faceCells[2 * f + 1];
      if (a < 0 || b < 0 || !isOwn(size_t(a))) continue;
      if (of_.faceTag[f] == FaceTag::surface)
        addSeparated(size_t(a), size_t(b));
      else if (std::min(distance_[size_t(a)], distance_[size_t(b)]) <= 1)
        addFace(f);
    }
    sortItems(separated, std::less<>());
    separated.erase(std::unique(separated.begin(), separated.end()), separated.end());
  }

 private:
  static constexpr uint8_t kFar = 3;

  /// Of cells here from cut-cells, in faces: right for own cells, and those beside them.
  void findDistances() {
    for (const uint64_t id : complex_.cellIds) distance_.push_back(id < complex_.wholeCutCells ? 0 : kFar);
    for (uint8_t next = 1; next < kFar; ++next) {
      for (size_t f = 0; f < of_.faceCount(); ++f) {
        for (size_t side = 0; side < 2; ++side) {
          const int32_t from = of_.faceCells[2 * f + side], to = of_.faceCells[2 * f + 1 - side];
          if (from >= 0 && to >= 0 && distance_[size_t(from)] == next - 1) distance_[size_t(to)] = std::min(distance_[size_t(to)], next);
        }
      }
    }
  }

  bool isOwn(size_t cell) const { return complex_.cellRanks[cell] == rank_; }

  static std::array<double, 3> pointOf(const std::vector<double>& points, size_t i) {
    return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  }

  void addCell(size_t c) {
    const int32_t* corner = &of_.cellCorner[3 * c];
    cells.push_back({complex_.cellIds[c],
                     of_.cellVolume[c],
                     pointOf(of_.cellCentroid, c),
                     {corner[0], corner[1], corner[2]},
                     of_.cellRegion[c],
                     of_.cellLevel[c]});
  }

  void addFace(size_t f) {
    faces.push_back({complex_.faceIds[f],
                     {complex_.cellIds[size_t(of_.faceCells[2 * f])], complex_.cellIds[size_t(of_.faceCells[2 * f + 1])]},
                     of_.faceArea[f],
                     pointOf(of_.faceNormal, f),
                     pointOf(of_.faceCentroid, f)});
  }

  /// Cells of different regions never merge, whether triangles are between them or not.
  void addSeparated(size_t a, size_t b) {
    if (a == b || of_.cellRegion[a] != of_.cellRegion[b]) return;
    separated.push_back({{std::min(complex_.cellIds[a], complex_.cellIds[b]), std::max(complex_.cellIds[a], complex_.cellIds[b])}});
  }

  const RankComplex& complex_;
  const CellComplex& of_;
  const int rank_;
  std::vector<uint8_t> distance_;  // per cell
};

/// As much of the whole's cell complex as decides which cells merge. Its cells are those known, in the order of their ids, which decides
/// where all else is alike; and so are its faces.
class Deciding {
 public:
  CellComplex complex;

  Deciding(const std::vector<KnownCell>& cells, const std::vector<KnownFace>& faces, const std::vector<Separated>& separated,
           uint64_t wholeCutCells)
      : cells_(cells) {
    complex.cutCells = uint32_t(std::min(wholeCutCells, uint64_t(cells.size())));  // all of them are known
    addCells();
    const size_t count = faces.size() + separated.size();
    complex.faceCells.reserve(2 * count);
    complex.faceTag.reserve(count);
    complex.faceArea.reserve(count);
    complex.faceNormal.reserve(3 * count);
    complex.faceCentroid.reserve(3 * count);
    for (const KnownFace& face : faces) addFace(face, FaceTag::inner);
    for (const Separated& pair : separated) addFace({0, pair.cells, 0, {}, {}}, FaceTag::surface);
    operators::gatherHalfFaces(complex, 1);
  }

 private:
  void addCells() {
    complex.cellVolume.reserve(cells_.size());
    complex.cellCentroid.reserve(3 * cells_.size());
    complex.cellCorner.reserve(3 * cells_.size());
    complex.cellRegion.reserve(cells_.size());
    complex.cellLevel.reserve(cells_.size());
    for (const KnownCell& cell : cells_) {
      complex.cellVolume.push_back(cell.volume);
      complex.cellCentroid.insert(complex.cellCentroid.end(), cell.centroid.begin(), cell.centroid.end());
      complex.cellCorner.insert(complex.cellCorner.end(), cell.corner.begin(), cell.corner.end());
      complex.cellRegion.push_back(cell.region);
      complex.cellLevel.push_back(uint8_t(cell.level));
    }
  }

  void addFace(const KnownFace& face, FaceTag tag) {
    for (const uint64_t id : face.cells) complex.faceCells.push_back(placeOf(id));
    complex.faceTag.push_back(tag);
    complex.faceArea.push_back(face.area);
    complex.faceNormal.insert(complex.faceNormal.end(), face.normal.begin(), face.normal.end());
    complex.faceCentroid.insert(complex.faceCentroid.end(), face.centroid.begin(), face.centroid.end());
  }

  int32_t placeOf(uint64_t id) const {
    const auto at =
        std::lower_bound(cells_.begin(), cells_.end(), id, [](const KnownCell& cell, uint64_t other) { return cell.id < other; });
    return int32_t(at - cells_.begin());
  }

  const std::vector<KnownCell>& cells_;
};

/// The items of all in the first process, by their ids.
template <class Item>
std::vector<Item> inFirst(Communicator& comm, std::vector<Item> items) {
  std::vector<Item> all = comm.gather(items, false);
  items = {};
  comm.together(kDeciding, [&] { sortItems(all, [](const Item& a, const Item& b) { return a.id < b.id; }); });
  return all;
}

}  // namespace

std::vector<Absorbed> absorbedCells(Communicator& comm, const CutMesh& common, const RankComplex& complex, const MergeOptions& options) {
  std::optional<Known> known;
  comm.together(kDeciding, [&] { known.emplace(complex, comm.rank()); });
  const std::vector<KnownCell> cells = inFirst(comm, std::move(known->cells));
  std::vector<KnownFace> faces = inFirst(comm, std::move(known->faces));
  std::vector<Separated> separated = comm.gather(known->separated, false);
  known.reset();
  std::vector<Absorbed> absorbed;
  comm.together(kDeciding, [&] {
    if (comm.rank() > 0) return;
    const Deciding deciding(cells, faces, separated, complex.wholeCutCells);
    faces = {};
    const std::vector<uint32_t> first = operators::mergedWith(common, deciding.complex, options);
    for (size_t c = 0; c < cells.size(); ++c) {
      const KnownCell& to = cells[first[c]];
      if (first[c] != c) absorbed.push_back({cells[c].id, to.id, to.corner[2]});
    }
  });
  comm.broadcast(absorbed, 0);
  return absorbed;
}

}  // namespace mandoline::detail
