// Triangulates polygons with holes in the plane. No vertices are added.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace mandoline::operators {

struct PlanePoint {
  double x, y;
  bool operator==(const PlanePoint& other) const { return x == other.x && y == other.y; }
};

/// Takes one polygon at a time, corner by corner: its outer loop counter-clockwise, then its holes clockwise. Corners of one vertex are at
/// the same place. The buffers are kept from polygon to polygon.
class PolygonTriangulator {
 public:
  PolygonTriangulator();
  ~PolygonTriangulator();

  void startLoop();
  void addCorner(uint32_t vertex, const PlanePoint& at);
  /// Appends the triangles of the polygon, 3 vertices each, counter-clockwise, and forgets it.
  void run(std::vector<uint32_t>& triangles);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mandoline::operators
