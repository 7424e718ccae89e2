// Pieces of a cut with layers of others' cells.
#pragma once

#include "base/shared.h"
#include "mandoline/distributed.h"
#include "mesh/mesh_part.h"

namespace mandoline::detail {

class Communicator;

/// The layers of each process, by rank.
using RankLayers = std::vector<std::array<int64_t, 2>>;
/// Collective; `here`: those of this process.
MANDOLINE_SHARED RankLayers layersOfAll(Communicator& comm, const std::array<int64_t, 2>& here);
/// The next process with layers below (-1) or above (1); -1 for none, and for one without layers itself.
MANDOLINE_SHARED int neighbourOf(const RankLayers& layers, int rank, int direction);

/// A piece, and what measuring its cells takes of the mesh.
struct PieceToMeasure {
  RankPiece piece;
  MeshPart surface;
};

/// Collective. Adds so many layers of grid cells below and above, as far as the grid goes; ranks and seams are left out. `common` is that
/// of the share.
PieceToMeasure withGhostLayers(Communicator& comm, const RankLayers& layers, const CutMesh& common, PieceToMeasure grown, int count);

}  // namespace mandoline::detail
