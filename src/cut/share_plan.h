// What the processes of a distributed cut would have, counted by one process that cuts all bricks and makes no result: so that one can
// choose how many processes there are to be.
#pragma once

#include "base/shared.h"
#include "mandoline/prepare.h"

namespace mandoline::detail {

/// What one process has of a cut, what it sends to others on the way to the volumes of regions, and its memory.
struct ShareLoad {
  uint64_t work = 0;  ///< by which layers are given to processes: see share_layers.h
  uint64_t cutCells = 0;
  uint64_t faces = 0;        ///< that belong to it
  uint64_t seamFaces = 0;    ///< that it shares with others
  uint64_t bytesSent = 0;    ///< to each of the others, but for the mesh and a few numbers
  uint64_t sliceBytes = 0;   ///< what it sends beside that of its slice of the mesh, if processes do not read what they need themselves
  uint64_t memoryBytes = 0;  ///< beside the program
};

class MANDOLINE_SHARED SharePlanner {
 public:
  /// Throws CallError as cut() has errors.
  SharePlanner(PreparedMesh mesh, Grid grid, const RunOptions& options);

  /// Those of a cut by so many processes, by rank: the grid is cut once more, in their bricks, `windowWork` at a time, as ShareLoad counts
  /// it. Throws CallError as the constructor; of triangles that meet and are not to be resolved only where one such window shows it.
  std::vector<ShareLoad> loads(uint32_t ranks, const RunOptions& options, uint64_t windowWork = kWindowWork);

 private:
  static constexpr uint64_t kWindowWork = uint64_t(1) << 25;  // as measured, about half a GB of bricks

  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace mandoline::detail
