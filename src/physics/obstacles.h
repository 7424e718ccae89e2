// The triangles of the mesh as obstacles of segments, decided exactly.
#pragma once

#include "base/box_tree.h"
#include "base/exact.h"
#include "mandoline/grid.h"
#include "mesh/prepared.h"

namespace mandoline::physics {

using detail::Point;

using Triangle = std::array<Point, 3>;
struct Segment {
  Point from, to;
};

class Obstacles {
 public:
  /// Those with an area.
  Obstacles(const MeshView& mesh, const Grid& grid);

  /// Whether a segment, in world units, has no point in common with any triangle, borders included. Each thread needs its own
  /// predicates.
  bool isFree(const Segment& segment, detail::Predicates& predicates) const;
  /// The last point of the segment that can be reached from its start; the start itself if that lies on a triangle.
  Point reached(const Segment& segment, detail::Predicates& predicates) const;

 private:
  Point scaled(const Point& p) const;

  detail::Scale scale_;
  std::vector<Triangle> triangles_;
  detail::BoxTree tree_;
};

}  // namespace mandoline::physics
