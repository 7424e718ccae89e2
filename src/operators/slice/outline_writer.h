// Fills in Outlines.
#pragma once

#include "operators/slice/loop_tracer.h"
#include "operators/slice/nesting.h"
#include "operators/slice/region_arcs.h"

namespace mandoline::operators {

/// One plane at a time; the buffers are kept from plane to plane.
class OutlineWriter {
 public:
  explicit OutlineWriter(const ScaledSpace& space) : space_(space) {}

  /// Chains the arcs, which come by region.
  void run(const std::vector<RegionArc>& arcs, const Points& points, Outlines& outlines);

 private:
  static constexpr uint32_t kNone = ~0u;

  /// What the arcs of slits do in a point.
  struct Joint {
    uint32_t next = kNone, previous = kNone;  // of those that start and end there, the last
    uint32_t starting = 0, ending = 0;

    bool goesOn() const { return starting == 1 && ending == 1; }
  };

  void addPolygons(std::span<const RegionArc> arcs);
  void findCorners(std::span<const RegionArc> arcs);
  void addSlits(std::span<const RegionArc> arcs);
  void addSlit(std::span<const RegionArc> arcs, uint32_t first);
  uint32_t outputPoint(uint32_t point);

  const ScaledSpace& space_;
  const Points* points_ = nullptr;
  Outlines* outlines_ = nullptr;
  LoopTracer tracer_;
  Nesting nesting_;
  detail::Csr<uint32_t> corners_;      // per loop: the points that stay
  std::vector<uint32_t> outputPoint_;  // per point: its place in the outlines, or kNone
  std::vector<Joint> joints_;          // per point
  std::vector<uint8_t> used_;          // per arc: whether its slit is there
};

}  // namespace mandoline::operators
