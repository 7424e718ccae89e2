// Chains arcs into loops that have the inside to their left.
#pragma once

#include "base/csr.h"
#include "base/exact.h"
#include "operators/triangulate/plane_point.h"

namespace mandoline::operators {

/// One set of arcs at a time: add() them, then run(). The buffers are kept from set to set.
///
/// The arcs go around the cut of something closed, so as many end in a point as start there. Where there are several, a loop continues
/// along the other side of its wedge of the inside, so that loops that touch do not cross. What rounding has left no width is left out.
class LoopTracer {
 public:
  /// From now on points are at `at`, seen so that the plane's normal points up.
  void start(const std::vector<PlanePoint>& at);
  /// An arc of a segment, whose id is below the number of all segments. A segment is a slit if it is added in both directions.
  void add(uint32_t segment, uint32_t start, uint32_t end);
  /// The loops, as points.
  const detail::Csr<uint32_t>& run();
  /// The loops as segments: each starts in its point.
  const detail::Csr<uint32_t>& segments() const { return segments_; }

 private:
  static constexpr uint32_t kNone = ~0u;

  struct Arc {
    uint32_t segment, start, end;
    uint32_t next = kNone;
  };
  /// The start or end of an arc, as it leaves a point.
  struct Ray {
    uint32_t arc;
    bool starts;    // else the arc ends here
    uint32_t next;  // ray of the same point
    int half = 0;   // scratch of sorting: of the directions
  };

  void addRay(uint32_t point, uint32_t arc, bool starts);
  void join(uint32_t point);
  void sortClockwise(uint32_t point);
  void trace(uint32_t first);
  void clear();
  bool isSlit(const Arc& arc) const { return uses_[arc.segment] == 2; }
  const PlanePoint& target(const Ray& ray) const { return (*at_)[ray.starts ? arcs_[ray.arc].end : arcs_[ray.arc].start]; }

  const std::vector<PlanePoint>* at_ = nullptr;
  detail::Predicates predicates_;
  std::vector<Arc> arcs_;
  std::vector<Ray> rays_;
  std::vector<uint8_t> uses_;       // per segment: how many arcs it has
  std::vector<uint32_t> firstRay_;  // per point
  std::vector<Ray> around_;         // rays of one point
  std::vector<uint32_t> ended_, starting_;
  detail::Csr<uint32_t> loops_, segments_;
};

}  // namespace mandoline::operators
