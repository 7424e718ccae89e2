#include "operators/slice/points.h"

namespace mandoline::operators {

void EdgePoints::start(const CuttingPlane& plane, Points& points) {
  plane_ = &plane;
  points_ = &points;
  for (const uint32_t v : vertices_) pointOfVertex_[v] = kNone;
  vertices_.clear();
}

uint32_t EdgePoints::pointOn(const std::array<uint32_t, 2>& edge) {
  const auto [at, end] = plane_->crossing(position(edge[0]), position(edge[1]));
  return end < 0 ? points_->add(at) : pointAt(edge[size_t(end)]);
}

uint32_t EdgePoints::pointAt(uint32_t vertex) {
  if (pointOfVertex_.empty()) pointOfVertex_.assign(cutMesh_.vertexCount(), kNone);
  uint32_t& point = pointOfVertex_[vertex];
  if (point == kNone) {
    point = points_->add(position(vertex));
    vertices_.push_back(vertex);
  }
  return point;
}

}  // namespace mandoline::operators
