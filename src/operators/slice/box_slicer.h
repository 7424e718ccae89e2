// The cut of a plane through untouched grid cells.
#pragma once

#include "operators/slice/box_cut.h"
#include "operators/slice/cut_boxes.h"
#include "operators/slice/polygon_writer.h"

namespace mandoline::operators {

/// One plane at a time.
class BoxSlicer {
 public:
  BoxSlicer(const CutMesh& cutMesh, const ScaledGrid& grid) : grid_(grid), boxes_(cutMesh, grid) {}

  /// Adds the points and polygons of the untouched grid cells.
  void run(const CuttingPlane& plane, Points& points, PolygonWriter& writer);

 private:
  struct Corner {
    ScaledPoint at;
    double distance;
    bool above;
  };

  void loadCorners(const GridCell& gridCell, size_t upper);
  void cut(const GridCell& gridCell, uint32_t region);
  uint32_t pointOn(uint8_t edge);

  const ScaledGrid& grid_;
  CutBoxes boxes_;
  BoxCuts cuts_;
  const CuttingPlane* plane_ = nullptr;
  Points* points_ = nullptr;
  PolygonWriter* writer_ = nullptr;
  std::array<Corner, 8> corners_;  // of a grid cell: bit d is set on the upper plane of axis d
  static constexpr uint32_t kNone = ~0u;
  std::array<uint32_t, 8> pointOfCorner_;  // or kNone
  std::vector<uint32_t> loop_;
};

}  // namespace mandoline::operators
