// P6: the order of triangles around a tri-edge that they share (paper, 3.5), as the order of their corners off that edge.
#pragma once

#include <vector>

#include "cut/ids.h"
#include "mesh/resolve/lines.h"

namespace mandoline::detail {

/// One of the triangles that share a tri-edge.
struct Flap {
  const Point* tip;  ///< its corner off the edge
  uint32_t item;     ///< what the caller sorts
  int quarter = 0;   ///< scratch
};

/// Sorts flaps by angle, counter-clockwise about a -> b. If `open` they span less than half a turn, otherwise the order starts at the
/// half-plane of flaps[0]. Returns the place of the first flap that lies in one half-plane with the flap before it, or 0 if there is none.
size_t sortRadially(const Point& a, const Point& b, bool open, std::vector<Flap>& flaps, Predicates& predicates);

/// Half of a triangle's plane, bounded by a line in it.
struct HalfPlane {
  TriangleId triangle;
  bool ascending;   ///< whether it lies left of the line's direction, seen from where the triangle's normal points
  uint32_t item;    ///< what the caller sorts
  int quarter = 0;  ///< scratch
};

/// The same for half-planes about a line.
size_t sortRadially(const WeldedMesh& mesh, const Line& line, bool open, std::vector<HalfPlane>& halfPlanes, Predicates& predicates);

}  // namespace mandoline::detail
