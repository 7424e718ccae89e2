// The faces of a cell complex as simple polygons.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "io/polygons.h"
#include "mandoline/cell_complex.h"
#include "operators/require_cut_mesh.h"

namespace mandoline::detail {

/// The triangle that a face is a piece of, the first one if it is joined of several pieces; -1 if it is no piece of one.
inline int32_t triangleOf(const CutMesh& cutMesh, const CellComplex& cells, size_t face) {
  const uint32_t first = cells.membersOfFace(face)[0];
  return first < cutMesh.faceCount() ? cutMesh.faceTriangle[first] : -1;
}

/// As Polygons; those of octree cells, and of several faces that were joined, are simple as they are.
class ComplexPolygons {
 public:
  /// `cells` is made from the cut-mesh, else throws CallError; both must outlive this.
  ComplexPolygons(const CutMesh& cutMesh, const CellComplex& cells) : cells_(cells), cutFaces_(cutMesh.faceCount()), polygons_(cutMesh) {
    operators::requireCellsOf(cutMesh, cells);
  }

  /// Calls visit(std::span<const uint32_t> vertices) for each polygon of a face, counter-clockwise about the face's normal.
  template <class Visit>
  void forEach(size_t face, const Visit& visit) const {
    if (!replaced_.empty()) {
      const auto found = replaced_.find(uint32_t(face));
      if (found != replaced_.end()) {
        for (const std::vector<uint32_t>& polygon : found->second) visit(std::span<const uint32_t>(polygon));
        return;
      }
    }
    const Members members = cells_.membersOfFace(face);
    if (members.size() == 1 && members[0] < cutFaces_) return polygons_.forEach(members[0], visit);
    visit(cells_.loops(face)[0]);
  }

  using Replacement = std::vector<std::vector<uint32_t>>;
  /// From now on a face has these polygons, if any.
  void replace(size_t face, Replacement polygons) { replaced_[uint32_t(face)] = std::move(polygons); }
  bool isEmpty(size_t face) const {
    const auto found = replaced_.find(uint32_t(face));
    return found != replaced_.end() && found->second.empty();
  }

 private:
  const CellComplex& cells_;
  const size_t cutFaces_;
  Polygons polygons_;
  std::unordered_map<uint32_t, Replacement> replaced_;  // per face
};

}  // namespace mandoline::detail
