// What one process has of a cut that several processes made together: see mandoline/distributed.h; and the whole of all pieces.
#pragma once

#include "mandoline/cut_mesh.h"

namespace MANDOLINE_API mandoline {

/// The faces that a piece shares with the cut-cells of another process.
struct RankSeam {
  int rank;                     ///< the other process
  std::vector<uint32_t> faces;  ///< of the piece, ascending. The other process has them in the same order
  std::vector<uint64_t> cells;  ///< per face: global id of the cut-cell at its other side
};

/// What one process has of a cut.
struct RankPiece {
  /// The cut-cells in layers of grid cells along z, with all faces and vertices that they have, and the untouched grid cells there, as a
  /// cut-mesh by itself, made from the whole mesh. Its grid and regions are those of the whole, as are triangles and tri-vertices; rows of
  /// other layers have no runs. droppedTriangles are those without a face in the piece.
  CutMesh cutMesh;
  std::array<int64_t, 2> layers{};  ///< from the first up to, not including, the second; it may be none

  // Ids in the cut-mesh of the whole; all ascend.
  std::vector<uint64_t> vertexIds;  ///< per vertex
  std::vector<uint64_t> faceIds;    ///< per face
  std::vector<uint64_t> cellIds;    ///< per cut-cell

  // Each vertex and face belongs to one process; the others have it as a ghost.
  std::vector<int32_t> vertexRanks;  ///< per vertex: the process that it belongs to
  std::vector<int32_t> faceRanks;    ///< per face

  std::vector<RankSeam> seams;  ///< by rank

  Fingerprint whole;  ///< of the cut-mesh of the whole
};

/// The cut-mesh of the whole, to the bit, from the pieces of all processes, in any order. Throws CallError (badArgument, element: the piece
/// that is concerned) for pieces that are damaged, or of different cuts, and where some are missing or there twice.
CutMesh joinPieces(std::span<const RankPiece> pieces);

}  // namespace mandoline
