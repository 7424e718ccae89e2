// The outline of a plane's cut through a cut-cell, as loops with the cell to their left.
#pragma once

#include "base/csr.h"
#include "operators/slice/segments.h"

namespace mandoline::operators {

/// One cell at a time; the buffers are kept from cell to cell.
///
/// A cell's triangles form a closed surface, so as many segments end in a point as start there. Where there are several, the way goes on
/// along the other side of the wedge of the cell, so that loops that touch do not cross. What rounding has left no width is left out.
class SliceLoops {
 public:
  /// `at`: where points are, seen so that the plane's normal points up.
  SliceLoops(const CutMesh& cutMesh, const SliceSegments& segments, const std::vector<PlanePoint>& at)
      : cutMesh_(cutMesh), segments_(segments), at_(at), uses_(segments.segments.size(), 0), firstRay_(at.size(), kNone) {}

  /// The loops of a cut-cell, as points. The result holds until the next call.
  const detail::Csr<uint32_t>& run(size_t cell);

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

  void gather(size_t cell);
  void addRay(uint32_t point, uint32_t arc, bool starts);
  void join(uint32_t point);
  void sortClockwise(uint32_t point);
  void trace(uint32_t first);
  bool isSlit(const Arc& arc) const { return uses_[arc.segment] == 2; }
  const PlanePoint& target(const Ray& ray) const { return at_[ray.starts ? arcs_[ray.arc].end : arcs_[ray.arc].start]; }

  const CutMesh& cutMesh_;
  const SliceSegments& segments_;
  const std::vector<PlanePoint>& at_;
  Predicates predicates_;
  std::vector<Arc> arcs_;
  std::vector<Ray> rays_;
  std::vector<uint8_t> uses_;       // per segment: how many sides of it the cell has
  std::vector<uint32_t> firstRay_;  // per point
  std::vector<Ray> around_;         // rays of one point
  std::vector<uint32_t> ended_, starting_;
  detail::Csr<uint32_t> loops_;
};

}  // namespace mandoline::operators
