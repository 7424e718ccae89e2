// Cutting a surface that moves.
#pragma once

#include <memory>

#include "mandoline/cut.h"

namespace MANDOLINE_API mandoline {

/// Cuts meshes one after the other with the same grid. If a mesh differs from the one before in positions alone, only those parts of the
/// grid are cut again in which something has moved. Each result is that of cut(), to the bit; only where
/// Intersections::assumeNone leads to a contradiction, other triangles may be named.
///
///   Recutter recutter(grid);
///   for (...) {
///     const CutResult& result = recutter.recut(mesh);
///     ...
///   }
///
/// Everything is cut anew the first time, after an error, when triangles, or vertices that share a position, have changed, when the largest
/// coordinate has passed a power of two, and while triangles without area are among them. A cut-cell is found again in the next result by
/// its grid cell and its place among the cells there (see cutCellsAt()), as long as nothing moves in that grid cell. What the last cut was
/// made of stays in memory.
class Recutter {
 public:
  /// `options` are those of all cuts.
  explicit Recutter(Grid grid, const CutOptions& options = {});
  Recutter(Recutter&&) noexcept;
  Recutter& operator=(Recutter&&) noexcept;
  ~Recutter();

  /// As cut(mesh, grid, options), of which exactFallbacks counts what was cut again. The result is written over the memory of `spare`, such
  /// as the one before, since getting new memory takes long.
  CutResult cut(const MeshView& mesh, CutMesh spare = {});

  /// The same, of which the result stays here and is valid until the next call: what has not changed is not written anew, which takes
  /// less time.
  const CutResult& recut(const MeshView& mesh);

  /// The grid is cut in bricks of a few cells along each side.
  struct Counts {
    size_t bricks = 0;  ///< that the surface touches
    size_t kept = 0;    ///< of these: not cut again
  };
  /// Of the last cut.
  Counts counts() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace mandoline
