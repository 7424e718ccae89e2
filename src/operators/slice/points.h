// The points of a plane's cut.
#pragma once

#include <vector>

#include "operators/slice/cutting_plane.h"

namespace mandoline::operators {

class Points {
 public:
  explicit Points(const CuttingPlane& plane) : plane_(plane) {}

  uint32_t add(const ScaledPoint& p) {
    scaled_.push_back(p);
    seen_.push_back(plane_.seen(p));
    return uint32_t(scaled_.size()) - 1;
  }
  size_t size() const { return scaled_.size(); }
  const ScaledPoint& operator[](size_t p) const { return scaled_[p]; }
  /// Seen so that the plane's normal points up.
  const std::vector<PlanePoint>& seen() const { return seen_; }

 private:
  const CuttingPlane& plane_;
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

}  // namespace mandoline::operators
