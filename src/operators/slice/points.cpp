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

uint64_t GridPoints::keyOf(const std::array<int32_t, 3>& at, int kind) const {
  uint64_t vertex = 0;
  for (size_t d = 3; d-- > 0;) vertex = vertex * grid_.planes[d].size() + uint64_t(at[d]);
  return 4 * vertex + uint64_t(kind);
}

uint32_t GridPoints::pointOn(const GridEdge& edge) {
  const auto [known, isNew] = known_.try_emplace(keyOf(edge.at, edge.axis), 0);
  if (!isNew) return known->second;
  std::array<int32_t, 3> other = edge.at;
  ++other[size_t(edge.axis)];
  const auto [at, end] = plane_.crossing(grid_.corner(edge.at), grid_.corner(other));
  if (end < 0) return known->second = points_.add(at);
  const auto [vertex, isNewVertex] = known_.try_emplace(keyOf(end == 0 ? edge.at : other, 3), 0);
  if (isNewVertex) vertex->second = points_.add(at);
  return known_[keyOf(edge.at, edge.axis)] = vertex->second;
}

}  // namespace mandoline::operators
