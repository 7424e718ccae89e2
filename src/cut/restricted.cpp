#include "cut/restricted.h"

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

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t index, size_t items = 1) {
  to.insert(to.end(), from.begin() + ptrdiff_t(index * items), from.begin() + ptrdiff_t((index + 1) * items));
}
/// If there is such an array.
template <class T>
void appendIfAny(std::vector<T>& to, const std::vector<T>& from, size_t index) {
  if (!from.empty()) to.push_back(from[index]);
}

class Restrictor {
 public:
  Restrictor(const BrickBox& box, const CutMesh& all)
      : box_(box), all_(all), faces_(all.faceCount()), vertices_(all.vertexCount()), regions_(all.regionCount) {}

  CutMesh run() {
    takeRuns();
    listCells();
    takeFaces();
    takeVertices();
    takeRegions();
    takeCells();
    takeTriangles();
    std::array<std::vector<double>, 3> planes;
    for (size_t d = 0; d < 3; ++d) {
      const auto first = all_.grid.planes[d].begin() + box_.first[d];
      planes[d].assign(first, first + box_.count[d] + 1);
    }
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
    out_.rowRunOffsets.push_back(0);
    for (int32_t k = box_.first[2]; k < box_.first[2] + box_.count[2]; ++k) {
      for (int32_t j = box_.first[1]; j < box_.first[1] + box_.count[1]; ++j) {
        const size_t row = size_t(k) * ny + size_t(j);
        for (uint32_t r = all_.rowRunOffsets[row]; r < all_.rowRunOffsets[row + 1]; ++r) {
          const int32_t begin = std::max(all_.runBegin[r], first), end = std::min(all_.runEnd[r], past);
          if (begin >= end) continue;
          out_.runBegin.push_back(begin - first);
          out_.runEnd.push_back(end - first);
          out_.runRegion.push_back(all_.runRegion[r]);
          regions_.keep(all_.runRegion[r]);
        }
        out_.rowRunOffsets.push_back(uint32_t(out_.runBegin.size()));
      }
    }
  }

  void listCells() {
    for (size_t c = 0; c < all_.cellCount(); ++c) {
      if (!box_.has(cellOf(c))) continue;
      cells_.push_back(c);
      regions_.keep(all_.cellRegion[c]);
      for (const uint32_t h : all_.halfFaces(c)) faces_.keep(h / 2);
    }
  }

  void takeFaces() {
    out_.loopOffsets.push_back(0);
    out_.faceLoopOffsets.push_back(0);
    out_.faceParentOffsets.push_back(0);
    faces_.number([&](uint32_t f) {
      for (const std::span<const uint32_t> loop : all_.loops(f)) {
        out_.loopVertices.insert(out_.loopVertices.end(), loop.begin(), loop.end());
        out_.loopOffsets.push_back(uint32_t(out_.loopVertices.size()));
      }
      out_.faceLoopOffsets.push_back(uint32_t(out_.loopOffsets.size() - 1));
      for (uint32_t i = all_.faceParentOffsets[f]; i < all_.faceParentOffsets[f + 1]; ++i) {
        append(out_.faceParents, all_.faceParents, i);
        append(out_.faceParentSigns, all_.faceParentSigns, i);
      }
      out_.faceParentOffsets.push_back(uint32_t(out_.faceParents.size()));
      append(out_.faceTriangle, all_.faceTriangle, f);
      append(out_.faceAxis, all_.faceAxis, f);
      const int32_t axis = all_.faceAxis[f];
      out_.facePlane.push_back(all_.facePlane[f] - (axis < 0 ? 0 : box_.first[size_t(axis)]));
    });
    for (const uint32_t v : out_.loopVertices) vertices_.keep(v);
  }

  void takeVertices() {
    vertices_.number([&](uint32_t v) {
      append(out_.positions, all_.positions, v, 3);
      for (size_t d = 0; d < 3; ++d) out_.vertexCell.push_back(all_.vertexCell[3 * size_t(v) + d] - box_.first[d]);
      append(out_.vertexMask, all_.vertexMask, v);
      append(out_.vertexTriVertex, all_.vertexTriVertex, v);
      append(out_.vertexParents, all_.vertexParents, v, 2);
    });
    for (uint32_t& v : out_.loopVertices) v = vertices_[v];
    for (size_t i = 0; i < all_.madeVertices.size(); ++i) {
      if (!vertices_.has(all_.madeVertices[i])) continue;
      out_.madeVertices.push_back(vertices_[all_.madeVertices[i]]);
      append(out_.madeVertexKinds, all_.madeVertexKinds, i);
      append(out_.madeVertexParents, all_.madeVertexParents, i, 4);
    }
  }

  void takeRegions() {
    out_.hasWinding = all_.hasWinding;
    regions_.number([&](uint32_t r) {
      ++out_.regionCount;
      appendIfAny(out_.regionWinding, all_.regionWinding, r);
      appendIfAny(out_.regionPartWinding, all_.regionPartWinding, r);
      appendIfAny(out_.regionParity, all_.regionParity, r);
    });
    for (uint32_t& region : out_.runRegion) region = regions_[region];
  }

  void takeCells() {
    out_.cellHalfFaceOffsets.push_back(0);
    for (const size_t c : cells_) {
      for (const uint32_t h : all_.halfFaces(c)) out_.cellHalfFaces.push_back(2 * faces_[h / 2] + h % 2);
      out_.cellHalfFaceOffsets.push_back(uint32_t(out_.cellHalfFaces.size()));
      for (size_t d = 0; d < 3; ++d) out_.cellGridCell.push_back(all_.cellGridCell[3 * c + d] - box_.first[d]);
      out_.cellRegion.push_back(regions_[all_.cellRegion[c]]);
    }
  }

  void takeTriangles() {
    out_.triangleCount = all_.triangleCount;
    out_.parityTriangles = all_.parityTriangles;
    out_.openTriangles = all_.openTriangles;
    Kept triangles(all_.triangleCount);
    for (const uint32_t t : out_.faceParents) triangles.keep(t);
    for (uint32_t t = 0; t < all_.triangleCount; ++t) {
      if (!triangles.has(t)) out_.droppedTriangles.push_back(t);
    }
  }

  const BrickBox& box_;
  const CutMesh& all_;
  CutMesh out_;
  std::vector<size_t> cells_;
  Kept faces_, vertices_, regions_;
};

}  // namespace

CutMesh restrictedTo(const BrickBox& box, const CutMesh& cutMesh) { return Restrictor(box, cutMesh).run(); }

}  // namespace mandoline::detail
