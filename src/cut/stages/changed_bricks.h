// Bricks that have to be cut again, of a surface of which most is where it was.
//
// In: the cut before and its bricks, of triangles that meet in neither cut; the SurfaceMap, with the vertices in triangles; what has
// moved, clipped. Out: ChangedBricks. A brick has changed if a triangle has moved that it has a part of, now or before, or if there is
// anything of such a triangle on its seams.
#pragma once

#include "base/key_numbers.h"
#include "cut/stages/surface_map.h"

namespace mandoline::detail {

class ChangedBricks {
 public:
  /// `before` has all its triangles.
  ChangedBricks(const Surface& surfaceBefore, const ClippedTriangles& clippedBefore, const Bricks& before, const SurfaceMap& map);
  /// `moved`: the clips of triangles that have, whose vertices are in `now`.
  void addOf(const ClippedTriangles& moved, const Surface& now);

  bool has(uint64_t key) const { return keys_.find(key).has_value(); }
  /// Numbers of their keys; some of them may be touched by nothing.
  const KeyNumbers& keys() const { return keys_; }
  /// The triangles that have not moved and that any of them has parts of, ascending.
  std::vector<TriangleId> trianglesAtRest() const;

 private:
  void addAround(const Slab& element);
  void addEnds(const FaceEdge& edge, const CutVertices& vertices);
  void addSeamVertex(const Slab& slab);
  void addInPlane(const Surface& now);

  const Surface& surfaceBefore_;
  const Bricks& before_;
  const SurfaceMap& map_;
  KeyNumbers keys_;
};

/// Fills in Bricks::triangles of bricks that are all laid out.
void listTriangles(const ClippedTriangles& clipped, Bricks& bricks);

}  // namespace mandoline::detail
