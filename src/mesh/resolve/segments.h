// The segments that a triangle shares with others, and where they meet each other.
#pragma once

#include "mesh/resolve/mesh_points.h"

namespace mandoline::detail {

/// The segment that a triangle shares with another one, unless it runs along a side.
struct Segment {
  uint32_t triangle;
  std::array<uint32_t, 2> ends;  ///< points
  std::array<bool, 2> inside;    ///< whether each end lies strictly inside of the triangle
  Line line;                     ///< not yet directed
};

/// A point inside of a segment.
struct PointOnSegment {
  uint32_t segment, point;
};

/// Two segments that cross in a point which is not known yet.
struct Crossing {
  std::array<uint32_t, 2> segments;
  PointKey key;
};

/// Finds where segments and points of one triangle meet. One per thread.
class SegmentCrosser {
 public:
  SegmentCrosser(const WeldedMesh& mesh, const MeshPoints& points, const std::vector<Segment>& segments)
      : mesh_(mesh), points_(points), segments_(segments) {}

  /// Of one triangle: ids of its segments, and points in it that end none of them.
  void cross(uint32_t triangle, std::span<const uint32_t> segments, std::span<const uint32_t> isolated);

  std::vector<PointOnSegment> touches;
  std::vector<Crossing> crossings;
  Predicates predicates;

 private:
  struct Extent {
    std::array<double, 3> low, high;
    uint32_t item;  // segment, or ~point
  };
  Extent extentOf(uint32_t item, std::span<const uint32_t> points) const;
  void crossPair(uint32_t j, uint32_t k);
  void touch(uint32_t segment, uint32_t point);
  int sideOf(uint32_t segment, uint32_t point);
  bool isBetween(uint32_t segment, uint32_t point);
  PointKey keyOf(const Line& a, const Line& b) const;

  const WeldedMesh& mesh_;
  const MeshPoints& points_;
  const std::vector<Segment>& segments_;
  uint32_t triangle_ = 0;
  int axis_ = 0;  // one that the triangle's plane is not parallel to
  std::vector<Extent> extents_;
};

/// An axis along which two different points differ; if it can be told, the one along which they differ most.
int axisAlong(const MeshPoints& points, uint32_t u, uint32_t v, Predicates& predicates);

}  // namespace mandoline::detail
