// The points of a plane's cut.
#pragma once

#include <unordered_map>
#include <vector>

#include "operators/slice/plane_stack.h"

namespace mandoline::operators {

/// Of one plane at a time; the buffers are kept from plane to plane.
class Points {
 public:
  void start(const CuttingPlane& plane) {
    plane_ = &plane;
    scaled_.clear();
    seen_.clear();
  }
  uint32_t add(const ScaledPoint& p) {
    scaled_.push_back(p);
    seen_.push_back(plane_->seen(p));
    return uint32_t(scaled_.size()) - 1;
  }
  size_t size() const { return scaled_.size(); }
  const ScaledPoint& operator[](size_t p) const { return scaled_[p]; }
  /// Seen so that the plane's normal points up.
  const std::vector<PlanePoint>& seen() const { return seen_; }

 private:
  const CuttingPlane* plane_ = nullptr;
  std::vector<ScaledPoint> scaled_;
  std::vector<PlanePoint> seen_;
};

/// Makes the points on edges of a cut-mesh; those at vertices are one for all edges there. The buffers are kept from plane to plane.
class EdgePoints {
 public:
  EdgePoints(const CutMesh& cutMesh, const ScaledSpace& space) : cutMesh_(cutMesh), space_(space) {}

  void start(const CuttingPlane& plane, Points& points);
  uint32_t pointOn(const std::array<uint32_t, 2>& edge);

 private:
  static constexpr uint32_t kNone = ~0u;

  ScaledPoint position(uint32_t v) const { return space_.scaled(&cutMesh_.positions[3 * size_t(v)]); }
  uint32_t pointAt(uint32_t vertex);

  const CutMesh& cutMesh_;
  const ScaledSpace& space_;
  const CuttingPlane* plane_ = nullptr;
  Points* points_ = nullptr;
  std::vector<uint32_t> pointOfVertex_;  // empty until there is one
  std::vector<uint32_t> vertices_;       // that have one
};

/// An edge of the grid, from the grid vertex `at` along an axis.
struct GridEdge {
  int axis;
  std::array<int32_t, 3> at;
};

/// Makes the points on edges of the grid, one for each that is cut; those at grid vertices are one for all edges there.
class GridPoints {
 public:
  GridPoints(const ScaledGrid& grid, const CuttingPlane& plane, Points& points) : grid_(grid), plane_(plane), points_(points) {}

  uint32_t pointOn(const GridEdge& edge);

 private:
  /// The place of one, of the grid's edges along x, y and z and the grid's vertices (kind 3).
  uint64_t keyOf(const std::array<int32_t, 3>& at, int kind) const;

  const ScaledGrid& grid_;
  const CuttingPlane& plane_;
  Points& points_;
  std::unordered_map<uint64_t, uint32_t> known_;
};

}  // namespace mandoline::operators
