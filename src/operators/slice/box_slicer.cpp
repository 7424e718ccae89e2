#include "operators/slice/box_slicer.h"

namespace mandoline::operators {

void BoxSlicer::run(const CuttingPlane& plane, Points& points, PolygonWriter& writer) {
  plane_ = &plane;
  points_ = &points;
  writer_ = &writer;
  boxes_.forUntouched(plane, [&](int32_t begin, int32_t end, int32_t j, int32_t k, uint32_t region) {
    loadCorners({begin, j, k}, 0);
    for (int32_t i = begin; i < end; ++i) {
      loadCorners({i, j, k}, 1);
      cut({i, j, k}, region);
      for (size_t c = 0; c < 8; c += 2) corners_[c] = corners_[c + 1];  // the next cell's
    }
  });
}

/// Those on the lower or the upper plane of the x axis.
void BoxSlicer::loadCorners(const GridCell& gridCell, size_t upper) {
  for (size_t c = upper; c < 8; c += 2) {
    const ScaledPoint at = grid_.corner(size_t(gridCell[0]) + upper, size_t(gridCell[1]) + (c >> 1 & 1), size_t(gridCell[2]) + (c >> 2));
    if (upper == 1 && plane_->normal()[0] == 0) {
      corners_[c] = {at, corners_[c - 1].distance, corners_[c - 1].above};  // along the plane
    } else {
      corners_[c] = {at, plane_->distanceAt(at), plane_->isAbove(at)};
    }
  }
}

void BoxSlicer::cut(const GridCell& gridCell, uint32_t region) {
  unsigned above = 0;
  for (size_t c = 0; c < 8; ++c) above |= unsigned(corners_[c].above) << c;
  pointOfCorner_.fill(kNone);
  loop_.clear();
  for (const uint8_t edge : cuts_[uint8_t(above)].outline()) {
    const uint32_t point = pointOn(edge);
    if (loop_.empty() || loop_.back() != point) loop_.push_back(point);
  }
  while (loop_.size() > 1 && loop_.back() == loop_.front()) loop_.pop_back();
  if (loop_.size() < 3) return;  // an edge or a corner
  writer_->addPolygon(loop_, gridCell, region);
}

uint32_t BoxSlicer::pointOn(uint8_t edge) {
  const std::array<size_t, 2> ends = {size_t(edge / 8), size_t(edge % 8)};
  const Corner &a = corners_[ends[0]], &b = corners_[ends[1]];
  const auto [at, end] = CuttingPlane::crossing({a.at, a.distance}, {b.at, b.distance});
  if (end < 0) return points_->add(at);
  uint32_t& point = pointOfCorner_[ends[size_t(end)]];
  if (point == kNone) point = points_->add(at);
  return point;
}

}  // namespace mandoline::operators
