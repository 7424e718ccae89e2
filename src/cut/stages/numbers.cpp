#include "cut/stages/numbers.h"

namespace mandoline::detail {
namespace {

/// Where the ranges of all rows begin: rows in order, and in each the bricks along x.
void numberRows(const IdVector<BrickId, BrickCut>& cuts, Numbers& numbers) {
  struct Part {
    BrickId brick;
    uint32_t row;
  };
  std::vector<Part> parts;
  std::vector<KeyedItem> order;
  uint32_t last = 0;
  for (const BrickId b : cuts.ids()) {
    numbers.rows.push_back({});
    numbers.rows[b].resize(cuts[b].rows.size());
    for (uint32_t r = 0; r < cuts[b].rows.size(); ++r) {
      last = std::max(last, cuts[b].rows[r].row);
      order.push_back({cuts[b].rows[r].row, uint32_t(parts.size())});
      parts.push_back({b, r});
    }
  }
  sortByKey(order, last);
  for (const KeyedItem& at : order) {
    const auto& [brick, row] = parts[at.item];
    numbers.rows[brick][row] = numbers.total;
    numbers.total.add(cuts[brick].rows[row].counts);
    constexpr uint32_t kMost = uint32_t(1) << 31;
    if (std::max(numbers.total.loopVertices, numbers.total.halfFaces) > kMost) {
      throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 loop entries or half-faces."}};
    }
  }
}

/// Numbers the vertices of the surface that loops use, in the order of their ids.
void numberSurfaceVertices(const CutSurface& surface, const IdVector<BrickId, BrickCut>& cuts, Numbers& numbers) {
  const CutVertices& vertices = surface.surface.vertices;
  numbers.vertices.assign(vertices.size(), Numbers::kUnused);
  for (const VertexId v : surface.triFaces.loops.items) numbers.vertices[v] = 0;
  for (const BrickCut& cut : cuts) {
    for (const VertexId v : cut.loops.items) numbers.vertices[v] = 0;
  }
  for (const VertexId v : Ids<VertexId>(VertexId{0}, vertices.firstOnGrid)) {
    if (numbers.vertices[v] != Numbers::kUnused) numbers.vertices[v] = numbers.vertexCount++;
  }
}

/// Numbers what belongs to the cells of a brick.
void numberOwn(const BrickCut& cut, BrickId brick, VertexId firstOnGrid, Numbers& numbers) {
  std::vector<uint32_t>& pieces = numbers.pieces[brick];
  pieces.resize(cut.gridFaces.size());
  std::vector<BrickCounts> next = numbers.rows[brick];
  forOwnPieces(cut, [&](uint32_t row, uint32_t begin, uint32_t end) {
    for (uint32_t piece = begin; piece < end; ++piece) pieces[piece] = next[row].pieces++;
  });
  uint32_t vertex = 0;
  auto seamVertex = cut.otherSeamVertices.begin();
  for (uint32_t r = 0; r < cut.rows.size(); ++r) {
    for (; vertex < cut.rows[r].pastGridVertex; ++vertex) {
      const VertexId v{firstOnGrid.number + vertex};
      if (seamVertex != cut.otherSeamVertices.end() && seamVertex->vertex == v) {
        ++seamVertex;
      } else {
        numbers.vertices[v] = numbers.vertexCount + next[r].gridVertices++;
      }
    }
  }
}

/// Looks up the numbers of what belongs to other bricks.
void numberOthers(const IdVector<BrickId, BrickCut>& cuts, BrickId brick, Numbers& numbers) {
  for (const SeamFace& seam : cuts[brick].otherSeams) {
    const uint32_t first = seamAt(cuts[seam.place.owner].ownSeams, seam.place.key).firstPiece;
    for (uint32_t i = 0; i < seam.pieces; ++i) numbers.pieces[brick][seam.firstPiece + i] = numbers.pieces[seam.place.owner][first + i];
  }
  for (const auto& [place, vertex] : cuts[brick].otherSeamVertices) {
    numbers.vertices[vertex] = numbers.vertices[seamAt(cuts[place.owner].ownSeamVertices, place.key).vertex];
  }
}

}  // namespace

Numbers makeNumbers(const CutSurface& surface, const IdVector<BrickId, BrickCut>& cuts) {
  Numbers numbers;
  numberRows(cuts, numbers);
  numberSurfaceVertices(surface, cuts, numbers);
  numbers.pieces.resize(cuts.size());
  for (const BrickId b : cuts.ids()) numberOwn(cuts[b], b, surface.bricks.firstOnGrid[b], numbers);
  for (const BrickId b : cuts.ids()) numberOthers(cuts, b, numbers);
  numbers.vertexCount += numbers.total.gridVertices;
  return numbers;
}

}  // namespace mandoline::detail
