// Clips of triangles that are where they were: those of the cut before, with new ids of vertices.
//
// In: the cut before, of triangles that are connected alike and clipped by the same planes; the SurfaceMap so far. Out: KnownClips, none
// where triangles meet in one of both, and the vertices in triangles of the SurfaceMap.
#pragma once

#include "cut/stages/surface_map.h"

namespace mandoline::detail {

class ClipsBefore final : public KnownClips {
 public:
  ClipsBefore(const Surface& surface, const ClippedTriangles& clipped, SurfaceMap& now)
      : vertices_(surface.vertices), clipped_(clipped), now_(now) {}

  TriangleId pastKnown(TriangleId first, TriangleId past) const override {
    return now_.areEdgesSame() ? now_.pastSame(first, past) : first;
  }
  void addTo(ClippedTriangles& others, CutVertices& vertices) override;

 private:
  const CutVertices& vertices_;
  const ClippedTriangles& clipped_;
  SurfaceMap& now_;
};

}  // namespace mandoline::detail
