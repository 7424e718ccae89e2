// Joins the loops of a polygon into one chain: loops that share a vertex are spliced there, the others are joined by bridges.
#pragma once

#include <cstdint>
#include <vector>

#include "operators/triangulate/chains.h"

namespace mandoline::operators {

/// One polygon at a time; the buffers are kept from polygon to polygon.
class LoopJoiner {
 public:
  /// The chains of the polygon's loops become one.
  void run(Chains& chains);

 private:
  static constexpr uint32_t kNone = Chains::kNone;

  uint32_t chainOf(uint32_t loop);
  uint32_t loopOf(uint32_t corner) const;
  void spliceSharedVertices();
  void splice(size_t begin, size_t end, bool open);
  void bridgeHoles();
  void bridge(uint32_t a, uint32_t b);
  uint32_t visibleFrom(uint32_t hole) const;
  uint32_t edgeLeftOf(const PlanePoint& m) const;
  bool liesRightOf(uint32_t e, uint32_t f) const;
  uint32_t nearestTo(const PlanePoint& m) const;

  Chains* chains_ = nullptr;
  std::vector<uint32_t> chain_;  // per loop: a lower loop of its chain, or itself
  std::vector<uint32_t> shared_, holes_;
};

}  // namespace mandoline::operators
