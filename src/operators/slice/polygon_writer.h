// Fills in a Slice.
#pragma once

#include "mandoline/slice.h"
#include "operators/slice/cut_boxes.h"
#include "operators/slice/points.h"
#include "operators/triangulate/polygon_triangulator.h"

namespace mandoline::operators {

class PolygonWriter {
 public:
  explicit PolygonWriter(const ScaledSpace& space) : space_(space) {}

  /// From now on fills in `slice`, whose points are `points`.
  void start(const Points& points, Slice& slice);

  void addLoop(std::span<const uint32_t> points);
  /// Adds a loop of the polygon to be filled, the outline first.
  void addFillLoop(std::span<const uint32_t> points);
  /// Ends a polygon: it has the loops added since the last one.
  void endPolygon(int32_t cell, const GridCell& gridCell, uint32_t region);
  /// A polygon of an untouched grid cell.
  void addPolygon(std::span<const uint32_t> loop, const GridCell& gridCell, uint32_t region);
  /// Ends the slice.
  void finish();

 private:
  bool fillFan(std::span<const uint32_t> loop);

  const ScaledSpace& space_;
  const Points* points_ = nullptr;
  Slice* slice_ = nullptr;
  PolygonTriangulator triangulator_;
};

}  // namespace mandoline::operators
