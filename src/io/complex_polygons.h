// The faces of a cell complex as simple polygons.
#pragma once

#include "io/polygons.h"
#include "mandoline/cell_complex.h"
#include "operators/require_cut_mesh.h"

namespace mandoline::detail {

/// As Polygons; those of octree cells are simple as they are.
class ComplexPolygons {
 public:
  /// `cells` is made from the cut-mesh, else throws CallError; both must outlive this.
  ComplexPolygons(const CutMesh& cutMesh, const CellComplex& cells) : cells_(cells), polygons_(cutMesh) {
    operators::requireCellsOf(cutMesh, cells);
  }

  /// Calls visit(std::span<const uint32_t> vertices) for each polygon of a face, counter-clockwise about the face's normal.
  template <class Visit>
  void forEach(size_t face, const Visit& visit) const {
    if (face < cells_.cutFaces) return polygons_.forEach(face, visit);
    visit(cells_.loops(face)[0]);
  }

 private:
  const CellComplex& cells_;
  Polygons polygons_;
};

}  // namespace mandoline::detail
