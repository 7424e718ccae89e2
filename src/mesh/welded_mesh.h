// Welding (paper, Appendix A "Bad Input Meshes"): tri-vertices at one position become one, triangles without area are dropped, and their
// neighbours stay connected.
#pragma once

#include <cstdint>
#include <vector>

#include "base/exact.h"
#include "base/point.h"

namespace mandoline::detail {

enum class TriangleState : uint8_t { kept, zeroArea, duplicate };

/// A welded edge whose inside carries vertices of dropped triangles without area; neighbours on both sides share them ("stitching").
struct Stitch {
  uint32_t low, high;              ///< the edge's ends, low < high
  std::vector<uint32_t> vertices;  ///< strictly between, in order from low to high
};

struct WeldedMesh {
  std::vector<Point> points;                       ///< per tri-vertex
  std::vector<std::array<uint32_t, 3>> triangles;  ///< welded tri-vertices, per input triangle
  std::vector<TriangleState> states;               ///< per input triangle
  std::vector<Stitch> stitches;                    ///< sorted by (low, high)

  bool kept(size_t triangle) const { return states[triangle] == TriangleState::kept; }
};

/// Per tri-vertex the lowest one at its position; itself unless `referenced`.
std::vector<uint32_t> weld(const std::vector<uint8_t>& referenced, const std::vector<Point>& points);

/// Marks the triangles without area, exactly, and returns them.
std::vector<uint32_t> dropZeroArea(WeldedMesh& mesh, Predicates& predicates);

/// The vertices that dropped triangles without area put on edges. Such triangles that share an edge lie on one line; each of their edges
/// gets all their vertices that lie inside it.
std::vector<Stitch> findStitches(const WeldedMesh& mesh, const std::vector<uint32_t>& zeroArea);

}  // namespace mandoline::detail
