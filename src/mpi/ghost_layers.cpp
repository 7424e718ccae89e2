#include "mpi/ghost_layers.h"

#include <algorithm>

#include "mpi/communicator.h"
#include "mpi/pack.h"
#include "mpi/rank_piece.h"
#include "operators/join/join_cells.h"

namespace mandoline::detail {
namespace {

RankPiece layerOf(const RankPiece& piece, int64_t layer) {
  const std::vector<int32_t>& at = piece.cutMesh.cellGridCell;
  IdRange range{0, 0};
  for (size_t c = 0; c < piece.cutMesh.cellCount(); ++c) {
    if (at[3 * c + 2] < layer) ++range.begin;
    if (at[3 * c + 2] <= layer) ++range.end;
  }
  const operators::PieceCells cells[] = {{piece, range}};
  return operators::joinCells(cells);
}

/// A layer as a message.
struct Layer {
  RankPiece piece;

  static void fields(auto& self, const auto& f) {
    f("cutMesh", self.piece.cutMesh);
    f("vertexIds", self.piece.vertexIds);
    f("faceIds", self.piece.faceIds);
    f("cellIds", self.piece.cellIds);
  }
};

IdRange allCells(const RankPiece& piece) { return {0, piece.cutMesh.cellCount()}; }

}  // namespace

RankLayers layersOfAll(Communicator& comm, const std::array<int64_t, 2>& here) {
  const std::vector<uint64_t> first = comm.gatherAll(uint64_t(here[0])), past = comm.gatherAll(uint64_t(here[1]));
  RankLayers layers;
  for (size_t rank = 0; rank < first.size(); ++rank) layers.push_back({int64_t(first[rank]), int64_t(past[rank])});
  return layers;
}

int neighbourOf(const RankLayers& layers, int rank, int direction) {
  const auto isEmpty = [&](int r) { return layers[size_t(r)][0] == layers[size_t(r)][1]; };
  if (isEmpty(rank)) return -1;
  int at = rank + direction;
  while (at >= 0 && size_t(at) < layers.size() && isEmpty(at)) at += direction;
  return size_t(at) < layers.size() ? at : -1;
}

RankPiece withGhostLayers(Communicator& comm, const RankLayers& layers, const CutMesh& common, const RankPiece& piece, int count) {
  const int below = neighbourOf(layers, comm.rank(), -1), above = neighbourOf(layers, comm.rank(), 1);
  RankPiece grown = piece;
  /// Sends the layer to one neighbour and gets one of the other.
  const auto exchange = [&](int64_t layer, int to, int from) {
    Communicator::Bytes bytes;
    comm.together("cut", [&] {
      if (to >= 0) bytes = packed(Layer{layerOf(grown, layer)});
    });
    bytes = comm.exchange(bytes, to, from);
    return from >= 0 ? unpacked<Layer>(bytes).piece : RankPiece();
  };
  for (int added = 0; added < count; ++added) {
    const RankPiece lower = exchange(piece.layers[1] - 1 - added, above, below);
    const RankPiece upper = exchange(piece.layers[0] + added, below, above);
    comm.together("cut", [&] {
      const bool hasLower = below >= 0 && grown.layers[0] > 0, hasUpper = above >= 0 && grown.layers[1] < common.grid.cells(2);
      std::vector<operators::PieceCells> parts;
      if (hasLower) parts.push_back({lower, allCells(lower)});
      parts.push_back({grown, allCells(grown)});
      if (hasUpper) parts.push_back({upper, allCells(upper)});
      RankPiece joined = operators::joinCells(parts);
      joined.layers = {grown.layers[0] - hasLower, grown.layers[1] + hasUpper};
      takeCommon(common, joined);
      grown = std::move(joined);
    });
  }
  return grown;
}

}  // namespace mandoline::detail
