// Polygons without their slits, to be filled: a slit may touch an outline between its points, where rounding puts it on either side.
// Rounding makes more slits where a cell has almost no width.
#pragma once

#include "base/csr.h"
#include "operators/triangulate/plane_point.h"

namespace mandoline::operators {

/// One polygon at a time; the buffers are kept from polygon to polygon.
class Slits {
 public:
  /// The polygon's loops without the edges that they traverse in both directions, the outline first. The result holds until the next call.
  const detail::Csr<uint32_t>& remove(const detail::Csr<uint32_t>& loops, std::span<const uint32_t> polygon,
                                      const std::vector<PlanePoint>& at);

 private:
  struct Arc {
    uint32_t start, end, previous, next;
    bool kept = true;
  };

  bool mayHaveAny(std::span<const uint32_t> loop);
  void addLoop(std::span<const uint32_t> points);
  void removePairs();
  void remove(uint32_t a, uint32_t b);
  void trace(const std::vector<PlanePoint>& at);

  std::vector<Arc> arcs_;
  std::vector<uint32_t> order_;
  uint32_t round_ = 0;               // of mayHaveAny()
  std::vector<uint32_t> lastRound_;  // per point: in which it was met
  detail::Csr<uint32_t> loops_;
};

}  // namespace mandoline::operators
