// Triangulates polygons with holes in the plane (paper, 4.7) by ear clipping, for convex tri-faces and for grid-faces with holes alike. No
// vertices are added.
//
// A polygon's loops are joined into one cyclic chain of corners: loops that share a vertex are spliced there, the others are joined by
// bridges (edges traversed in both directions). Then ears are clipped off: a chain of n corners gives n - 2 triangles. So for any
// coordinates, the triangles use the directed edges of the loops once and every other edge once in each direction: geometry only
// chooses. It chooses by exact signs of the rounded positions: a face whose rounded loops don't cross gets triangles of positive area.
// Where rounding has made a face overlap itself or vanish, the least bad ear is clipped; where that would be a triangle with a vertex
// twice, its two other edges, which are opposite, cancel instead.
#pragma once

#include <cstdint>
#include <vector>

#include "base/shared.h"
#include "operators/triangulate/ear_clipper.h"
#include "operators/triangulate/loop_joiner.h"

namespace mandoline::operators {

/// Takes one polygon at a time, corner by corner: its outer loop counter-clockwise, then its holes clockwise. Corners of one vertex are at
/// the same place. The buffers are kept from polygon to polygon.
class MANDOLINE_SHARED PolygonTriangulator {
 public:
  void startLoop();
  void addCorner(uint32_t vertex, const PlanePoint& at);
  /// Appends the triangles of the polygon, 3 vertices each, counter-clockwise, and forgets it.
  void run(std::vector<uint32_t>& triangles);

 private:
  void closeLoop();

  Chains chains_;
  LoopJoiner joiner_;
  EarClipper clipper_;
};

}  // namespace mandoline::operators
