// A mesh without self-intersections: the exact arrangement of a mesh's triangles as triangles again, and the boundary of the solid.
#pragma once

#include "mandoline/fields.h"
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

  static void fields(auto& self, const auto& f) {
    Mesh::fields(self.mesh, f);
    f("vertexTriVertex", self.vertexTriVertex);
    f("parentOffsets", self.parentOffsets);
    f("parents", self.parents);
    f("parentSigns", self.parentSigns);
    f("frontWinding", Optional(self.frontWinding, &self.hasWinding));
    f("backWinding", Optional(self.backWinding, &self.hasWinding));
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

/// Which winding numbers are inside of the solid.
enum class WindingRule : uint8_t {
  positive,  ///< above 0: parts that overlap are one, inverted ones are nothing
  nonZero,   ///< any but 0
  odd        ///< where two parts overlap, there is a hole
};

/// The surface of the solid, oriented outwards: every edge has an even number of triangles. Throws CallError for a mesh without winding
/// numbers, or whose arrays don't fit together.
Mesh boundary(const ResolvedMesh& mesh, WindingRule rule = WindingRule::positive);
/// The same of a cut-mesh, in pieces cut by the grid, of the part of the solid inside the grid: where the solid reaches the grid's sides,
/// sides of its cut-cells and of the cells of coarsen() close it. Throws CallError if the cut-mesh is empty or has no winding numbers.
Mesh boundary(const CutMesh& cutMesh, WindingRule rule = WindingRule::positive);

}  // namespace mandoline
