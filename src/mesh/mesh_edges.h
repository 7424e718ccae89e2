// Unique tri-edges: those of the kept triangles of a mesh and, where triangles meet, of their arrangement.
#pragma once

#include <optional>

#include "mesh/resolve/arrangement.h"

namespace mandoline::detail {

struct MeshEdges {
  IdVector<TriEdgeId, std::array<VertexId, 2>> ends;  ///< tri-vertices and made vertices, lower one first; ascending
  std::vector<uint32_t> sideEdges;   ///< 3 per input triangle: tri-edge of side (i, i + 1), or kStitched + index into stitched
  Csr<TriEdgeId> stitched;           ///< tri-edges that together make a stitched side, from its lower tri-vertex to its higher
  Csr<TriEdgeId, TriangleId> inner;  ///< per triangle: tri-edges in its inside, ascending; no groups if there are none at all
  IdVector<TriEdgeId, Line> lines;   ///< that they lie on, directed from the lower end to the higher; empty if those are tri-vertices all
  /// Whether a triangle has a tri-edge that is not of two triangles; empty if none has. If they are known.
  std::optional<IdVector<TriangleId, uint8_t>> unpaired;

  static constexpr uint32_t kStitched = 1u << 31;

  /// The tri-edges inside of a triangle.
  std::span<const TriEdgeId> innerOf(TriangleId triangle) const {
    if (inner.size() == 0) return {};
    return inner[triangle];
  }
  /// Calls f(tri-edge) for those of a triangle, inner ones too.
  template <class F>
  void forTriangle(TriangleId triangle, const F& f) const {
    for (size_t side = 0; side < 3; ++side) {
      const uint32_t edge = sideEdges[3 * size_t(triangle.number) + side];
      if (edge < kStitched) {
        f(TriEdgeId{edge});
      } else {
        for (const TriEdgeId e : stitched[edge - kStitched]) f(e);
      }
    }
    for (const TriEdgeId e : innerOf(triangle)) f(e);
  }
  /// The line that a tri-edge lies on.
  Line line(TriEdgeId edge) const { return lines.empty() ? Line{ends[edge][0].number, ends[edge][1].number, false} : lines[edge]; }
  bool hasStitchedSide(TriangleId triangle) const {
    const auto* side = &sideEdges[3 * size_t(triangle.number)];
    return stitched.size() > 0 && (side[0] >= kStitched || side[1] >= kStitched || side[2] >= kStitched);
  }
  /// Calls f(tri-edge, whether it is traversed from its lower end) for the tri-edges of a side, in the triangle's direction.
  template <class F>
  void forSide(const WeldedMesh& mesh, TriangleId triangle, int side, const F& f) const {
    const auto v = mesh.verticesOf(triangle);
    const VertexId from = v[size_t(side)], to = v[side == 2 ? 0 : size_t(side) + 1];
    const bool forward = from < to;
    const uint32_t edge = sideEdges[3 * size_t(triangle.number) + side];
    if (edge < kStitched) return f(TriEdgeId{edge}, forward);
    const auto edges = stitched[edge - kStitched];
    for (size_t i = 0; i < edges.size(); ++i) {
      const size_t at = forward ? i : edges.size() - 1 - i;
      const bool sameWay = (ends[edges[at]][0] == (at == 0 ? std::min(from, to) : commonEnd(edges[at - 1], edges[at])));
      f(edges[at], forward == sameWay);
    }
  }
  VertexId commonEnd(TriEdgeId e, TriEdgeId f) const {
    return ends[e][0] == ends[f][0] || ends[e][0] == ends[f][1] ? ends[e][0] : ends[e][1];
  }
};

/// One use of a tri-edge by a side of a triangle.
struct TriangleUse {
  uint32_t triangleAndWay;  ///< 2 * triangle, + 1 if it runs through the edge from the lower end

  uint32_t triangle() const { return triangleAndWay / 2; }
  int32_t sign() const { return triangleAndWay % 2 != 0 ? 1 : -1; }
};

using EdgeUses = Csr<TriangleUse, TriEdgeId>;

/// Without an arrangement: drops duplicate triangles (paper, Appendix A) on the way, and finds whether the mesh is closed and oriented.
/// `usesIfOpen`, if given: gets those by sides of triangles, duplicates too, per edge, unless the mesh is closed.
MeshEdges findMeshEdges(WeldedMesh& mesh, const Arrangement* arrangement, EdgeUses* usesIfOpen);

}  // namespace mandoline::detail
