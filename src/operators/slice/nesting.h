// Which loops of a cell's cut are outlines of polygons, and which polygon each hole is in.
#pragma once

#include <array>

#include "base/csr.h"
#include "base/exact.h"
#include "operators/triangulate/plane_point.h"

namespace mandoline::operators {

/// One cell at a time; the buffers are kept from cell to cell.
class Nesting {
 public:
  /// Groups the loops of a cell (as points, whose places are `at`) into polygons: loops, the outline first.
  const detail::Csr<uint32_t>& run(const detail::Csr<uint32_t>& loops, const std::vector<PlanePoint>& at);

 private:
  enum class Kind : uint8_t { outline, hole, unclear };
  struct Loop {
    Kind kind;
    double area;
    std::array<uint32_t, 2> longest;  // segment
    PlanePoint sample;                // its middle
    PlanePoint low, high;             // of all points
    uint32_t outline;                 // itself, or that around a hole; kNone if there is none
  };
  static constexpr uint32_t kNone = ~0u;

  Loop measure(std::span<const uint32_t> points) const;
  void decideUnclear();
  uint32_t outlineOf(uint32_t hole);
  void makePolygons();
  bool runsAlong(uint32_t loop, uint32_t from, uint32_t to) const;
  int winding(uint32_t loop, const PlanePoint& p);

  const detail::Csr<uint32_t>* points_ = nullptr;
  const std::vector<PlanePoint>* at_ = nullptr;
  detail::Predicates predicates_;
  std::vector<Loop> loops_;
  std::vector<uint32_t> order_;
  detail::Csr<uint32_t> polygons_;
};

}  // namespace mandoline::operators
