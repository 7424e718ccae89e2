// A mesh without self-intersections: the exact arrangement of a mesh's triangles as triangles again, and the boundary of the solid.
#pragma once

#include "mandoline/fields.h"
#include "mandoline/inside.h"
#include "mandoline/prepare.h"

namespace MANDOLINE_API mandoline {

/// The arrangement of a mesh's triangles: two triangles meet in shared vertices and edges alone, up to the rounding of vertices.
struct ResolvedMesh {
  Mesh mesh;                             ///< vertices of the input are not moved; made ones are rounded once
  std::vector<int32_t> vertexTriVertex;  ///< per vertex: the tri-vertex of the input (lowest id at its position), or -1 for a made one
  // The triangles of the input that contain each triangle: several where they lie on each other.
  std::vector<uint32_t> parentOffsets;  ///< per triangle, into parents
  std::vector<uint32_t> parents;        ///< ascending; the triangle's normal is that of the first
  std::vector<int8_t> parentSigns;      ///< per parent: 1 if its normal is the triangle's, -1 if it is the opposite
  bool hasWinding = false;              ///< whether the input has winding numbers: see CutMesh
  std::vector<int32_t> frontWinding;    ///< per triangle: the winding number on the side of its normal; empty unless hasWinding
  std::vector<int32_t> backWinding;     ///< the same behind it; empty unless hasWinding
  // The same of CutMesh::regionPartWinding and regionParity, for inputs that have no winding numbers as a whole.
  std::vector<int32_t> frontPartWinding;  ///< per triangle, on the side of its normal; empty if no part has winding numbers
  std::vector<int32_t> backPartWinding;   ///< per triangle, behind it; empty if no part has winding numbers
  std::vector<uint8_t> frontParity;       ///< per triangle, on the side of its normal; empty if no part has parity
  std::vector<uint8_t> backParity;        ///< per triangle, behind it; empty if no part has parity

  static void fields(auto& self, const auto& f) {
    Mesh::fields(self.mesh, f);
    f("vertexTriVertex", self.vertexTriVertex);
    f("parentOffsets", self.parentOffsets);
    f("parents", self.parents);
    f("parentSigns", self.parentSigns);
    f("frontWinding", Optional(self.frontWinding, &self.hasWinding));
    f("backWinding", Optional(self.backWinding, &self.hasWinding));
    f("frontPartWinding", Optional(self.frontPartWinding));
    f("backPartWinding", Optional(self.backPartWinding));
    f("frontParity", Optional(self.frontParity));
    f("backParity", Optional(self.backParity));
  }
};

struct ResolveResult {
  Error error;
  ResolvedMesh mesh;  ///< empty unless ok
  CutStats stats;     ///< of a cut in one grid cell around the mesh; its `intersections` are the pairs of the input
  /// Pairs of triangles of `mesh` that meet again because vertices were rounded, found exactly. Often there are none.
  PairCounts remaining;

  explicit operator bool() const { return error.status == Status::ok; }
};

/// Failures come back as a status; it throws nothing but what options.progress throws.
ResolveResult resolve(const MeshView& mesh, const RunOptions& options = {});

/// The surface of the solid, oriented outwards: every edge has an even number of triangles. Inside is what insideRegions() says; open
/// parts are left out. Throws CallError for a mesh that has no others, or whose arrays don't fit together.
Mesh boundary(const ResolvedMesh& mesh, WindingRule rule = WindingRule::positive);
/// The same of a cut-mesh, in pieces cut by the grid, of the part of the solid inside the grid: where the solid reaches the grid's sides,
/// sides of its cut-cells and of the cells of coarsen() close it. Throws CallError as insideRegions() does.
Mesh boundary(const CutMesh& cutMesh, WindingRule rule = WindingRule::positive);
/// The same of any regions. `isInside`: per region. Throws CallError if the cut-mesh is empty or has another number of regions.
Mesh boundary(const CutMesh& cutMesh, std::span<const uint8_t> isInside);

}  // namespace mandoline
