#include "mpi/ghost_layers.h"

#include <algorithm>

#include "base/sort.h"
#include "cut/append.h"
#include "mpi/communicator.h"
#include "mpi/pack.h"
#include "mpi/rank_piece.h"

namespace mandoline::detail {
namespace {

/// Some cut-cells of a piece.
struct Cells {
  const RankPiece& piece;
  IdRange range;
};

/// A face or vertex of one of several pieces.
struct PlaceOf {
  uint64_t id;
  uint32_t piece, item;

  bool operator<(const PlaceOf& other) const { return id < other.id; }
  bool operator==(const PlaceOf& other) const { return id == other.id; }
};

uint32_t placeIn(const std::vector<uint64_t>& ids, uint64_t id) {
  return uint32_t(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

/// Cells of pieces that follow each other, with their faces and vertices, each once.
class Joiner {
 public:
  explicit Joiner(const std::vector<Cells>& cells) : cells_(cells) {}

  RankPiece run() {
    takeFaces();
    takeVertices();
    takeCells();
    return std::move(result_);
  }

 private:
  const RankPiece& piece(uint32_t i) const { return cells_[i].piece; }

  void takeFaces() {
    for (uint32_t i = 0; i < cells_.size(); ++i) {
      for (size_t c = cells_[i].range.begin; c < cells_[i].range.end; ++c) {
        for (const uint32_t h : piece(i).cutMesh.halfFaces(c)) faces_.push_back({piece(i).faceIds[h / 2], i, h / 2});
      }
    }
    sortUnique(faces_);
    beginFaces(result_.cutMesh);
    for (const PlaceOf& face : faces_) {
      appendFace(piece(face.piece).cutMesh, face.item, result_.cutMesh);
      result_.faceIds.push_back(face.id);
    }
  }

  void takeVertices() {
    std::vector<PlaceOf> corners;
    for (const PlaceOf& face : faces_) {
      const RankPiece& from = piece(face.piece);
      for (const auto loop : from.cutMesh.loops(face.item)) {
        for (const uint32_t v : loop) corners.push_back({from.vertexIds[v], face.piece, v});
      }
    }
    std::vector<PlaceOf> vertices = corners;
    sortUnique(vertices);
    for (const PlaceOf& vertex : vertices) {
      appendVertex(piece(vertex.piece).cutMesh, vertex.item, result_.cutMesh);
      result_.vertexIds.push_back(vertex.id);
    }
    for (size_t i = 0; i < corners.size(); ++i) result_.cutMesh.loopVertices[i] = placeIn(result_.vertexIds, corners[i].id);
  }

  void takeCells() {
    CutMesh& to = result_.cutMesh;
    to.cellHalfFaceOffsets.assign(1, 0);
    for (const Cells& cells : cells_) {
      const CutMesh& from = cells.piece.cutMesh;
      for (size_t c = cells.range.begin; c < cells.range.end; ++c) {
        append(to.cellGridCell, from.cellGridCell, c, 3);
        append(to.cellRegion, from.cellRegion, c);
        append(result_.cellIds, cells.piece.cellIds, c);
        for (const uint32_t h : from.halfFaces(c))
          to.cellHalfFaces.push_back(2 * placeIn(result_.faceIds, cells.piece.faceIds[h / 2]) + h % 2);
        to.cellHalfFaceOffsets.push_back(uint32_t(to.cellHalfFaces.size()));
      }
    }
  }

  const std::vector<Cells>& cells_;
  std::vector<PlaceOf> faces_;
  RankPiece result_;
};

RankPiece layerOf(const RankPiece& piece, int64_t layer) {
  const std::vector<int32_t>& at = piece.cutMesh.cellGridCell;
  IdRange range{0, 0};
  for (size_t c = 0; c < piece.cutMesh.cellCount(); ++c) {
    if (at[3 * c + 2] < layer) ++range.begin;
    if (at[3 * c + 2] <= layer) ++range.end;
  }
  return Joiner({{piece, range}}).run();
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
      std::vector<Cells> parts;
      if (hasLower) parts.push_back({lower, allCells(lower)});
      parts.push_back({grown, allCells(grown)});
      if (hasUpper) parts.push_back({upper, allCells(upper)});
      RankPiece joined = Joiner(parts).run();
      joined.layers = {grown.layers[0] - hasLower, grown.layers[1] + hasUpper};
      takeCommon(common, joined);
      grown = std::move(joined);
    });
  }
  return grown;
}

}  // namespace mandoline::detail
