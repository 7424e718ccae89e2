// Welding (paper, Appendix A "Bad Input Meshes"): tri-vertices at one position become one, triangles without area are dropped, and their
// neighbours stay connected.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "base/exact.h"
#include "base/parallel.h"
#include "base/point.h"
#include "mesh/ids.h"

namespace mandoline::detail {

enum class TriangleState : uint8_t {
  kept,
  zeroArea,
  duplicate,
  beside  ///< of an excerpt: not cut, but named by others
};

/// A welded edge whose inside carries vertices of dropped triangles without area; neighbours on both sides share them ("stitching").
struct Stitch {
  uint32_t low, high;              ///< the edge's ends, low < high
  std::vector<uint32_t> vertices;  ///< strictly between, in order from low to high
};

/// A triangle with the same three vertices as a lower one, which stands for it.
struct Duplicate {
  uint32_t original, triangle;
  bool sameWay;  ///< whether their normals are the same

  auto operator<=>(const Duplicate&) const = default;
};

struct WeldedMesh {
  std::vector<Point> points;                       ///< per tri-vertex
  std::vector<std::array<uint32_t, 3>> triangles;  ///< welded tri-vertices, per input triangle
  std::vector<TriangleState> states;               ///< per input triangle
  std::vector<Stitch> stitches;                    ///< sorted by (low, high)
  std::vector<Duplicate> duplicates;               ///< ascending by the triangle they are copies of
  bool closed = false;                             ///< every tri-edge is traversed equally often in both directions, counting duplicates
  bool oriented = false;                           ///< two triangles alone at a tri-edge traverse it in opposite directions

  bool kept(size_t triangle) const { return states[triangle] == TriangleState::kept; }
  bool kept(TriangleId t) const { return kept(t.number); }
  std::array<VertexId, 3> verticesOf(TriangleId t) const {
    const auto& v = triangles[t.number];
    return {VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}};
  }
  /// Of a tri-vertex; near a made vertex.
  const Point& point(VertexId v) const { return points[v.number]; }
  /// The ends of a side, which leads from a triangle's corner to the next: the lower tri-vertex, then the higher.
  std::array<uint32_t, 2> edgeOf(uint32_t triangle, int side) const {
    const auto& t = triangles[triangle];
    const auto [low, high] = std::minmax(t[size_t(side)], t[size_t(side + 1) % 3]);
    return {low, high};
  }
  Ids<TriangleId> triangleIds() const { return Ids<TriangleId>(triangles.size()); }
  /// The triangles with the same three vertices.
  std::span<const Duplicate> duplicatesOf(TriangleId t) const;
  /// The stitch on an edge, or null.
  const Stitch* findStitch(uint32_t low, uint32_t high) const;
};

/// Sign of a triangle's normal along an axis.
int normalSign(const WeldedMesh& mesh, TriangleId triangle, int axis, Predicates& predicates);

/// Per tri-vertex the lowest one at its position; itself unless `referenced`.
std::vector<uint32_t> weld(const std::vector<uint8_t>& referenced, const std::vector<Point>& points);

/// Per tri-vertex: whether it is elsewhere than before, in a mesh whose triangles were connected alike.
using Moved = IdVector<VertexId, uint8_t>;

inline bool hasMoved(const Moved& moved, const std::array<uint32_t, 3>& triangle) {
  return (moved[{triangle[0]}] | moved[{triangle[1]}] | moved[{triangle[2]}]) != 0;  // one branch
}

/// Marks the triangles without area, exactly, and returns them. Triangles that are not among `some`, which ascend, are known to have one;
/// null: none is.
std::vector<uint32_t> dropZeroArea(WeldedMesh& mesh, const std::vector<uint32_t>* some, Monitor& monitor, Predicates& predicates);

/// The vertices that dropped triangles without area put on edges. Such triangles that share an edge lie on one line; each of their edges
/// gets all their vertices that lie inside it.
std::vector<Stitch> findStitches(const WeldedMesh& mesh, const std::vector<uint32_t>& zeroArea);

}  // namespace mandoline::detail
