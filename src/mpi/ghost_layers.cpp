#include "mpi/ghost_layers.h"

#include <algorithm>

#include "mpi/communicator.h"
#include "mpi/pack.h"
#include "mpi/rank_piece.h"
#include "operators/join/join_cells.h"
#include "operators/measure/measure_part.h"

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
  MeshPart surface;

  static void fields(auto& self, const auto& f) {
    f("cutMesh", self.piece.cutMesh);
    f("vertexIds", self.piece.vertexIds);
    f("faceIds", self.piece.faceIds);
    f("cellIds", self.piece.cellIds);
    f("surface", self.surface);
  }
};

Layer layerToSend(const PieceToMeasure& from, int64_t layer) {
  Layer sent{layerOf(from.piece, layer), {}};
  sent.surface = measuring::partMeasuredBy(sent.piece.cutMesh, from.surface);
  return sent;
}

IdRange allCells(const RankPiece& piece) { return {0, piece.cutMesh.cellCount()}; }

}  // namespace

RankLayers layersOfAll(Communicator& comm, const std::array<int64_t, 2>& here) {
  const std::vector<uint64_t> first = comm.gatherAll(uint64_t(here[0])), past = comm.gatherAll(uint64_t(here[1]));
  RankLayers layers;
  comm.together("cut", [&] {
    for (size_t rank = 0; rank < first.size(); ++rank) layers.push_back({int64_t(first[rank]), int64_t(past[rank])});
  });
  return layers;
}

int neighbourOf(const RankLayers& layers, int rank, int direction) {
  const auto isEmpty = [&](int r) { return layers[size_t(r)][0] == layers[size_t(r)][1]; };
  if (isEmpty(rank)) return -1;
  int at = rank + direction;
  while (at >= 0 && size_t(at) < layers.size() && isEmpty(at)) at += direction;
  return size_t(at) < layers.size() ? at : -1;
}

PieceToMeasure withGhostLayers(Communicator& comm, const RankLayers& layers, const CutMesh& common, PieceToMeasure grown, int count) {
  const int below = neighbourOf(layers, comm.rank(), -1), above = neighbourOf(layers, comm.rank(), 1);
  const std::array<int64_t, 2> own = grown.piece.layers;
  /// Sends the layer to one neighbour and gets one of the other.
  const auto exchange = [&](int64_t sent, int to, int from) {
    Communicator::Bytes bytes;
    comm.together("cut", [&] {
      if (to >= 0) bytes = packed(layerToSend(grown, sent));
    });
    bytes = comm.exchange(bytes, to, from);
    Layer layer;
    comm.together("cut", [&] {
      if (from >= 0) layer = unpacked<Layer>(bytes);
    });
    return layer;
  };
  for (int added = 0; added < count; ++added) {
    const Layer lower = exchange(own[1] - 1 - added, above, below);
    const Layer upper = exchange(own[0] + added, below, above);
    comm.together("cut", [&] {
      RankPiece& piece = grown.piece;
      const bool hasLower = below >= 0 && piece.layers[0] > 0, hasUpper = above >= 0 && piece.layers[1] < common.grid.cells(2);
      std::vector<operators::PieceCells> parts;
      if (hasLower) parts.push_back({lower.piece, allCells(lower.piece)});
      parts.push_back({piece, allCells(piece)});
      if (hasUpper) parts.push_back({upper.piece, allCells(upper.piece)});
      RankPiece joined = operators::joinCells(parts);
      joined.layers = {piece.layers[0] - hasLower, piece.layers[1] + hasUpper};
      takeCommon(common, joined);
      piece = std::move(joined);
      grown.surface = united(std::array{std::move(grown.surface), lower.surface, upper.surface});
    });
  }
  return grown;
}

}  // namespace mandoline::detail
