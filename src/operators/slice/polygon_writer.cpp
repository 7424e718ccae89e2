#include "operators/slice/polygon_writer.h"

namespace mandoline::operators {

void PolygonWriter::start(const Points& points, Slice& slice) {
  points_ = &points;
  slice_ = &slice;
}

void PolygonWriter::addLoop(std::span<const uint32_t> points) {
  slice_->loopPoints.insert(slice_->loopPoints.end(), points.begin(), points.end());
  slice_->loopOffsets.push_back(uint32_t(slice_->loopPoints.size()));
}

void PolygonWriter::addFillLoop(std::span<const uint32_t> points) {
  triangulator_.startLoop();
  for (const uint32_t p : points) triangulator_.addCorner(p, points_->seen()[p]);
}

void PolygonWriter::endPolygon(int32_t cell, const GridCell& gridCell, uint32_t region) {
  triangulator_.run(slice_->triangles);
  slice_->polygonTriangleOffsets.push_back(uint32_t(slice_->triangles.size() / 3));
  slice_->polygonLoopOffsets.push_back(uint32_t(slice_->loopOffsets.size() - 1));
  slice_->polygonCell.push_back(cell);
  slice_->polygonGridCell.insert(slice_->polygonGridCell.end(), gridCell.begin(), gridCell.end());
  slice_->polygonRegion.push_back(region);
}

void PolygonWriter::addPolygon(std::span<const uint32_t> loop, const GridCell& gridCell, uint32_t region) {
  addLoop(loop);
  if (!fillFan(loop)) addFillLoop(loop);
  endPolygon(-1, gridCell, region);
}

/// What the triangulator makes of a convex polygon, at less cost.
bool PolygonWriter::fillFan(std::span<const uint32_t> loop) {
  const std::vector<PlanePoint>& at = points_->seen();
  for (size_t i = 2; i < loop.size(); ++i) {
    if (!(orientation(at[loop[0]], at[loop[i - 1]], at[loop[i]]) > 0)) return false;
  }
  for (size_t i = 2; i < loop.size(); ++i) slice_->triangles.insert(slice_->triangles.end(), {loop[0], loop[i - 1], loop[i]});
  return true;
}

void PolygonWriter::finish() {
  slice_->positions.resize(3 * points_->size());
  double* position = slice_->positions.data();
  for (size_t p = 0; p < points_->size(); ++p) {
    for (const double x : (*points_)[p]) *position++ = space_.world(x);
  }
}

}  // namespace mandoline::operators
