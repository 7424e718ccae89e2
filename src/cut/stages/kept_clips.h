// Clips of triangles that are where they were: most are in bricks that have not changed either, and need none; the others are clipped
// again.
//
// In: the cut before, of triangles that are connected alike and clipped by the same planes; the SurfaceMap so far. Out: KnownClips, none
// where triangles meet in either of them, and the vertices in triangles of the SurfaceMap; ChangedBricks.
#pragma once

#include "cut/stages/changed_bricks.h"

namespace mandoline::detail {

class ClipsBefore final : public KnownClips {
 public:
  ClipsBefore(const Surface& surface, const ClippedTriangles& clipped, const Bricks& bricks, SurfaceMap& now)
      : surface_(surface), clipped_(clipped), bricks_(bricks), now_(now) {}

  TriangleId pastKnown(TriangleId first, TriangleId past) const override {
    return now_.areEdgesSame() ? now_.pastSame(first, past) : first;
  }
  void addTo(ClippedTriangles& others, Surface& surface, const BrickGrid& grid, Run& run) override;
  /// Afterwards; null if no clips were known.
  const ChangedBricks* changed() const { return changed_ ? &*changed_ : nullptr; }

 private:
  const Surface& surface_;
  const ClippedTriangles& clipped_;
  const Bricks& bricks_;
  SurfaceMap& now_;
  std::optional<ChangedBricks> changed_;
};

}  // namespace mandoline::detail
