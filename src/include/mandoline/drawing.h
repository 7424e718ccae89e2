// Buffers to draw all cut-cells with, in one draw call for their faces and one for their edges.
#pragma once

#include <array>

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// Every cut-cell has vertices of its own, so that it can be coloured, moved or hidden by its id. Within a cell, faces share them, except
/// where the surface has a crease: there, each side has its own. So a face between two cut-cells is drawn for both, and an edge for each of
/// its cells.
struct CellDrawing {
  std::vector<float> positions;  ///< 3 per vertex, less the origin
  /// 4 per vertex: where pieces of triangles have it, 127 times the surface's unit normal, made smooth and on the side of the fronts of
  /// triangles, whichever side the cell is on; and 1. Else 0.
  std::vector<int8_t> normals;
  std::vector<uint32_t> vertexCell;  ///< per vertex: the cut-cell

  /// 3 vertices per triangle, counter-clockwise seen from outside of the cell: first pieces of triangles, then pieces of grid-faces.
  std::vector<uint32_t> triangles;
  uint32_t surfaceTriangles = 0;  ///< so many are pieces of triangles
  /// 2 vertices per edge: first hybrid edges, then grid-edges, then pieces of tri-edges that lie in no axial plane.
  std::vector<uint32_t> edges;
  uint32_t hybridEdges = 0;  ///< those in one axial plane
  uint32_t gridEdges = 0;    ///< those in two

  // For sorting, colours and exploding, not for computing: see measure().
  std::vector<double> cellVolume;   ///< per cut-cell, from its triangles
  std::vector<float> cellCentroid;  ///< 3 per cut-cell, less the origin; of the thinnest cells, the mean of their faces' corners
  Fingerprint madeFrom;             ///< of the cut-mesh

  static void fields(auto& self, const auto& f) {
    f("positions", self.positions);
    f("normals", self.normals);
    f("vertexCell", self.vertexCell);
    f("triangles", self.triangles);
    f("surfaceTriangles", self.surfaceTriangles);
    f("edges", self.edges);
    f("hybridEdges", self.hybridEdges);
    f("gridEdges", self.gridEdges);
    f("cellVolume", self.cellVolume);
    f("cellCentroid", self.cellCentroid);
    f("madeFrom", self.madeFrom);
  }
};

/// Triangles are those of triangulateFaces(). Where the surface bends by less than 45 degrees, its normals are interpolated between those
/// at the corners of its triangles. `origin` is subtracted before positions are rounded to 32 bits: the middle of the grid's box is best.
/// `mesh` is the input that `cutMesh` was made from. Throws CallError if it is not (badArgument), or if vertices can't be numbered in 32
/// bits (meshTooLarge).
CellDrawing cellDrawing(const MeshView& mesh, const CutMesh& cutMesh, const std::array<double, 3>& origin = {});

}  // namespace mandoline
