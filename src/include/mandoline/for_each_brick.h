// Cutting a grid brick by brick: for cuts that are larger than memory.
#pragma once

#include <functional>
#include <memory>

#include "mandoline/prepare.h"

namespace MANDOLINE_API mandoline {

/// What a cut has in one brick, a box of grid cells: the same cells as in the cut of the whole grid, to the bit, as a cut-mesh by itself.
/// `cutMesh` was made from `mesh`, so all that takes both takes these. (Of validate(), the check of winding numbers is for the whole: here
/// they are those of the whole mesh, which the triangles near a brick do not tell.)
/// Cells on two sides of a seam between bricks have the same faces there, each in its own cut-mesh.
struct CutPiece {
  /// The brick's lowest grid cell. Grid cells, planes and runs of `cutMesh` count from there; its grid has the planes of the brick.
  std::array<int64_t, 3> first{};
  CutMesh cutMesh;  ///< its regions are those of the brick: one of the whole cut may be several here
  /// The triangles near the brick, and those that these meet; welded. Coordinates are those of the whole mesh.
  Mesh mesh;
  std::vector<uint32_t> triangles;    ///< per triangle of `mesh` that of the whole mesh, ascending
  std::vector<uint32_t> triVertices;  ///< per tri-vertex of `mesh` that of the whole mesh (the lowest at its position), ascending
};

struct ForEachBrickOptions : RunOptions {
  int64_t cells = 128;     ///< grid cells along each side of a brick, fewer where the grid ends: a power of two up to 2^24
  bool untouched = false;  ///< whether bricks come, too, in which the surface touches no grid cell
};

/// Cuts bricks in any order, also several at a time on threads of the caller's, or some here and others elsewhere: each needs nothing of
/// another. Copies share what they hold, which never changes.
class BrickCutter {
 public:
  /// Finds the triangles near each brick. Throws CallError as cut() has errors.
  BrickCutter(PreparedMesh mesh, Grid grid, const ForEachBrickOptions& options = {});

  /// The bricks that the surface comes near to, or with `untouched` all, by z, then y, then x.
  uint64_t count() const;
  /// The lowest grid cell of a brick. Throws CallError if there is no such brick (element).
  std::array<int64_t, 3> first(uint64_t brick) const;
  /// The piece may have no cut-cells. Throws CallError if there is no such brick, and as forEachBrick() does.
  CutPiece cut(uint64_t brick, const RunOptions& options = {}) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// Calls f(piece) for the bricks of the grid, by z, then y, then x, one after the other, on the caller's thread; not for those without
/// cut-cells, unless `untouched`. Needs memory for the prepared mesh and one piece, and time for the triangles near each brick. Errors are
/// those of cut(), thrown as CallError; only where Intersections::assumeNone leads to a contradiction, other triangles may be named, or
/// none. What f and options.progress throw passes through.
void forEachBrick(const PreparedMesh& mesh, const Grid& grid, const std::function<void(CutPiece)>& f,
                  const ForEachBrickOptions& options = {});

}  // namespace mandoline
