// The outline of a plane's cut through a cut-cell, as loops with the cell to their left.
#pragma once

#include "core/csr.h"
#include "operators/slice_segments.h"

namespace mandoline::operators {

/// One cell at a time; the buffers are kept from cell to cell.
///
/// A cell's triangles form a closed surface, so as many segments end in a point as start there. Where there are several, the way goes on
/// along the other side of the wedge of the cell: which segments bound a wedge is told by the exact order of their triangles around the edge.
class SliceLoops {
 public:
  SliceLoops(const CutMesh& cutMesh, const ScaledSpace& space, const SliceSegments& segments)
      : cutMesh_(cutMesh), space_(space), segments_(segments), firstRay_(segments.pointEdges.size(), kNone) {}

  /// The loops of a cut-cell, as points. The result holds until the next call.
  const detail::Csr<uint32_t>& run(size_t cell);

 private:
  static constexpr uint32_t kNone = ~0u;

  struct Arc {
    uint32_t segment, side;
    uint32_t next = kNone;
  };
  /// The start or end of an arc, as it leaves a point.
  struct Ray {
    uint32_t arc;
    bool starts;         // else the arc ends here
    uint32_t next;       // ray of the same point
    ScaledPoint tip{};   // scratch of sorting: of its triangle, off the edge
    int quarter = 0;     // and where that lies
  };

  uint32_t end(const Arc& arc, bool start) const { return segments_.segments[arc.segment].points[start ? arc.side : 1 - arc.side]; }
  ScaledPoint tipOf(const Ray& ray) const;
  void gather(size_t cell);
  void addRay(uint32_t arc, bool starts);
  void join(uint32_t point);
  void sortClockwise(uint32_t point);
  int sideOf(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& tip, int axis);

  const CutMesh& cutMesh_;
  const ScaledSpace& space_;
  const SliceSegments& segments_;
  Predicates predicates_;
  std::vector<Arc> arcs_;
  std::vector<Ray> rays_;
  std::vector<uint32_t> firstRay_;  // per point
  std::vector<Ray> around_;         // rays of one point
  std::vector<uint32_t> ended_, starting_;
  detail::Csr<uint32_t> loops_;
};

}  // namespace mandoline::operators
