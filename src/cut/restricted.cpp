#include "cut/restricted.h"

#include "base/csr.h"
#include "base/disjoint_sets.h"
#include "cut/append.h"
#include "cut/stages/untouched_runs.h"

namespace mandoline::detail {
namespace {

/// New numbers for things of which some are kept.
class Kept {
 public:
  explicit Kept(size_t count) : isKept_(count, 0) {}

  void keep(uint32_t old) { isKept_[old] = 1; }
  /// To be called when all are known. Calls f(old number) for those kept, in order.
  template <class F>
  void number(const F& f) {
    numbers_.resize(isKept_.size());
    uint32_t next = 0;
    for (uint32_t old = 0; old < isKept_.size(); ++old) {
      if (!isKept_[old]) continue;
      numbers_[old] = next++;
      f(old);
    }
  }
  bool has(uint32_t old) const { return isKept_[old] != 0; }
  uint32_t operator[](uint32_t old) const { return numbers_[old]; }

 private:
  std::vector<uint8_t> isKept_;
  std::vector<uint32_t> numbers_;
};

/// If there is such an array.
template <class T>
void appendIfAny(std::vector<T>& to, const std::vector<T>& from, size_t index) {
  if (!from.empty()) to.push_back(from[index]);
}

class Restrictor {
 public:
  Restrictor(const BrickBox& box, const CutMesh& all) : box_(box), all_(all), faces_(all.faceCount()), vertices_(all.vertexCount()) {}

  CutMesh run() {
    takeRuns();
    listCells();
    takeFaces();
    takeVertices();
    takeRegions();
    takeCells();
    takeTriangles();
    std::array<std::vector<double>, 3> planes;
    for (size_t d = 0; d < 3; ++d) planes[d] = planesOf(all_.grid.planes[d], box_, d);
    out_.grid = Grid::rectilinear(std::move(planes));
    return std::move(out_);
  }

 private:
  Slab cellOf(size_t c) const {
    const int32_t* g = &all_.cellGridCell[3 * c];
    return {2 * g[0] + 1, 2 * g[1] + 1, 2 * g[2] + 1};
  }

  void takeRuns() {
    const size_t ny = size_t(all_.grid.cells(1));
    const int32_t first = box_.first[0], past = first + box_.count[0];
    runs_.ny = size_t(box_.count[1]);
    runs_.rowOffsets.push_back(0);
    for (int32_t k = box_.first[2]; k < box_.first[2] + box_.count[2]; ++k) {
      for (int32_t j = box_.first[1]; j < box_.first[1] + box_.count[1]; ++j) {
        const size_t row = size_t(k) * ny + size_t(j);
        for (uint32_t r = all_.rowRunOffsets[row]; r < all_.rowRunOffsets[row + 1]; ++r) {
          const int32_t begin = std::max(all_.runBegin[r], first), end = std::min(all_.runEnd[r], past);
          if (begin >= end) continue;
          runs_.begin.push_back(begin - first);
          runs_.end.push_back(end - first);
          regionsOfRuns_.push_back(all_.runRegion[r]);
        }
        runs_.rowOffsets.push_back(uint32_t(runs_.size()));
      }
    }
  }

  void listCells() {
    for (size_t c = 0; c < all_.cellCount(); ++c) {
      if (!box_.has(cellOf(c))) continue;
      cells_.push_back(c);
      for (const uint32_t h : all_.halfFaces(c)) faces_.keep(h / 2);
    }
  }

  void takeFaces() {
    beginFaces(out_);
    faces_.number([&](uint32_t f) {
      appendFace(all_, f, out_);
      if (const int8_t axis = all_.faceAxis[f]; axis >= 0) out_.facePlane.back() -= box_.first[size_t(axis)];
    });
    for (const uint32_t v : out_.loopVertices) vertices_.keep(v);
  }

  void takeVertices() {
    vertices_.number([&](uint32_t v) {
      appendVertex(all_, v, out_);
      for (size_t d = 0; d < 3; ++d) out_.vertexCell[out_.vertexCell.size() - 3 + d] -= box_.first[d];
    });
    for (uint32_t& v : out_.loopVertices) v = vertices_[v];
    for (size_t i = 0; i < all_.madeVertices.size(); ++i) {
      if (vertices_.has(all_.madeVertices[i])) appendMade(all_, i, vertices_[all_.madeVertices[i]], out_);
    }
  }

  /// Joins cells, then runs, that pieces of grid-faces connect within the box.
  DisjointSets joined() const {
    constexpr uint32_t kNone = ~0u;
    const uint32_t firstRun = uint32_t(cells_.size());
    DisjointSets nodes(firstRun + runs_.size());
    runs_.forNeighbours([&](uint32_t a, uint32_t b) { nodes.unite(firstRun + a, firstRun + b); });
    std::vector<uint32_t> owners(all_.faceCount(), kNone);  // the first of each face
    for (uint32_t i = 0; i < cells_.size(); ++i) {
      for (const uint32_t h : all_.halfFaces(cells_[i])) {
        const uint32_t f = h / 2;
        if (all_.faceTriangle[f] >= 0) continue;
        if (owners[f] != kNone) nodes.unite(owners[f], i);
        owners[f] = i;
        Slab beside = cellOf(cells_[i]);
        const size_t axis = size_t(all_.faceAxis[f]);
        beside[axis] += 2 * all_.facePlane[f] > beside[axis] ? 2 : -2;
        const auto run = box_.has(beside) ? runAt(beside) : std::nullopt;
        if (run) nodes.unite(i, firstRun + *run);
      }
    }
    return nodes;
  }

  /// The run that has a cell of the box, if that is untouched.
  std::optional<uint32_t> runAt(Slab cell) const {
    for (size_t d = 0; d < 3; ++d) cell[d] -= 2 * box_.first[d];
    const uint32_t run = runs_.at(cell);
    if (run == runs_.rowOffsets[runs_.rowOf(cell) + 1] || runs_.begin[run] > cell[0] >> 1) return {};
    return run;
  }

  /// Numbers regions in the order of their first grid cells.
  void takeRegions() {
    constexpr uint32_t kUnset = ~0u;
    DisjointSets nodes = joined();
    std::vector<KeyedItem> order;
    for (uint32_t i = 0; i < cells_.size(); ++i) order.push_back({box_.indexOf(cellOf(cells_[i])), i});
    for (size_t row = 0; row + 1 < runs_.rowOffsets.size(); ++row) {
      for (uint32_t r = runs_.rowOffsets[row]; r < runs_.rowOffsets[row + 1]; ++r)
        order.push_back({row * uint64_t(box_.count[0]) + uint64_t(runs_.begin[r]), uint32_t(cells_.size()) + r});
    }
    sortByKey(order, uint64_t(box_.count[0]) * (runs_.rowOffsets.size() - 1));
    std::vector<uint32_t> numbers(order.size(), kUnset);  // of roots
    regions_.resize(order.size());
    out_.hasWinding = all_.hasWinding;
    for (const KeyedItem& at : order) {
      uint32_t& number = numbers[nodes.find(at.item)];
      if (number == kUnset) {
        number = out_.regionCount++;
        const bool isCell = at.item < cells_.size();
        const uint32_t r = isCell ? all_.cellRegion[cells_[at.item]] : regionsOfRuns_[at.item - cells_.size()];
        appendIfAny(out_.regionWinding, all_.regionWinding, r);
        appendIfAny(out_.regionPartWinding, all_.regionPartWinding, r);
        appendIfAny(out_.regionParity, all_.regionParity, r);
      }
      regions_[at.item] = number;
    }
    out_.runRegion.assign(regions_.begin() + ptrdiff_t(cells_.size()), regions_.end());
    out_.rowRunOffsets = std::move(runs_.rowOffsets);
    out_.runBegin = std::move(runs_.begin);
    out_.runEnd = std::move(runs_.end);
  }

  void takeCells() {
    out_.cellHalfFaceOffsets.push_back(0);
    for (size_t i = 0; i < cells_.size(); ++i) {
      const size_t c = cells_[i];
      for (const uint32_t h : all_.halfFaces(c)) out_.cellHalfFaces.push_back(2 * faces_[h / 2] + h % 2);
      out_.cellHalfFaceOffsets.push_back(uint32_t(out_.cellHalfFaces.size()));
      for (size_t d = 0; d < 3; ++d) out_.cellGridCell.push_back(all_.cellGridCell[3 * c + d] - box_.first[d]);
      out_.cellRegion.push_back(regions_[i]);
    }
  }

  void takeTriangles() {
    out_.triangleCount = all_.triangleCount;
    out_.parityTriangles = all_.parityTriangles;
    out_.openTriangles = all_.openTriangles;
    listWithoutFace(out_);
  }

  const BrickBox& box_;
  const CutMesh& all_;
  CutMesh out_;
  std::vector<size_t> cells_;
  Kept faces_, vertices_;
  UntouchedRuns runs_;
  std::vector<uint32_t> regionsOfRuns_;  // in `all_`
  std::vector<uint32_t> regions_;        // per cell, then per run
};

}  // namespace

std::vector<double> planesOf(const std::vector<double>& planes, const BrickBox& box, size_t axis) {
  const auto first = planes.begin() + box.first[axis];
  return {first, first + box.count[axis] + 1};
}

CutMesh restrictedTo(const BrickBox& box, const CutMesh& cutMesh) { return Restrictor(box, cutMesh).run(); }

}  // namespace mandoline::detail
