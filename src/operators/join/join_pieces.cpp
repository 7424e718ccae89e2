#include <algorithm>

#include "cut/append.h"
#include "mandoline/validate.h"
#include "mesh/run_call.h"
#include "operators/join/check_piece.h"
#include "operators/join/join_cells.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace operators {
namespace {

bool ascend(const std::vector<uint64_t>& ids) { return std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end(); }

/// By the layers that they have; those without any come first.
std::vector<uint32_t> inOrder(std::span<const RankPiece> pieces) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < pieces.size(); ++i) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return pieces[a].layers < pieces[b].layers; });
  return order;
}

std::string name(const std::array<int64_t, 2>& layers) { return std::to_string(layers[0]) + " to " + std::to_string(layers[1] - 1); }

bool haveSameGrid(const CutMesh& a, const CutMesh& b) {
  return a.grid.planes == b.grid.planes && a.grid.uniform == b.grid.uniform && a.grid.origin == b.grid.origin &&
         a.grid.spacing == b.grid.spacing;
}

/// Requires that the pieces are of one cut, and that each layer of the grid is in one of them.
void requireAll(std::span<const RankPiece> pieces, const std::vector<uint32_t>& order) {
  const RankPiece& first = pieces[order[0]];
  int64_t past = 0;
  for (const uint32_t i : order) {
    const RankPiece& piece = pieces[i];
    if (piece.whole != first.whole || !haveSameGrid(piece.cutMesh, first.cutMesh)) refuse("The piece is one of another cut.", i);
    if (piece.layers[0] == piece.layers[1]) continue;
    if (piece.layers[0] < past) refuse("Layers " + name({piece.layers[0], past}) + " of the grid are in two pieces.", i);
    if (piece.layers[0] > past) refuse("Layers " + name({past, piece.layers[0]}) + " of the grid are in no piece.", i);
    past = piece.layers[1];
  }
  const int64_t end = first.cutMesh.grid.cells(2);
  if (past < end) refuse("Layers " + name({past, end}) + " of the grid are in no piece.", order.back());
}

/// A made vertex of a piece.
struct MadeOf {
  uint32_t vertex;  ///< of the whole
  uint32_t piece, item;
};

class WholeMaker {
 public:
  WholeMaker(std::span<const RankPiece> pieces, const std::vector<uint32_t>& order) : pieces_(pieces), order_(order) {}

  CutMesh make() {
    std::vector<PieceCells> cells;
    for (const uint32_t i : order_) cells.push_back({pieces_[i], {0, pieces_[i].cutMesh.cellCount()}});
    RankPiece joined = joinCells(cells);
    for (const auto* ids : {&joined.vertexIds, &joined.faceIds, &joined.cellIds}) requireWithoutGaps(*ids);
    whole_ = std::move(joined.cutMesh);
    const RankPiece& first = pieces_[order_[0]];
    detail::copyCommon(first.cutMesh, whole_);
    whole_.fingerprint = first.whole;
    detail::listWithoutFace(whole_);
    takeMade();
    takeRuns();
    return std::move(whole_);
  }

 private:
  static void requireWithoutGaps(const std::vector<uint64_t>& ids) {
    for (uint64_t i = 0; i < ids.size(); ++i) {
      if (ids[i] != i) refuse("The pieces are damaged: their ids are not those of one cut.");
    }
  }

  void takeMade() {
    std::vector<MadeOf> made;
    for (const uint32_t i : order_) {
      const std::vector<uint32_t>& vertices = pieces_[i].cutMesh.madeVertices;
      for (uint32_t item = 0; item < vertices.size(); ++item) made.push_back({uint32_t(pieces_[i].vertexIds[vertices[item]]), i, item});
    }
    std::stable_sort(made.begin(), made.end(), [](const MadeOf& a, const MadeOf& b) { return a.vertex < b.vertex; });
    for (const MadeOf& one : made) {
      if (whole_.madeVertices.empty() || whole_.madeVertices.back() != one.vertex)
        detail::appendMade(pieces_[one.piece].cutMesh, one.item, one.vertex, whole_);
    }
  }

  void takeRuns() {
    whole_.rowRunOffsets.assign(1, 0);
    const size_t ny = size_t(whole_.grid.cells(1));
    for (const uint32_t i : order_) {
      const CutMesh& from = pieces_[i].cutMesh;
      const size_t begin = size_t(pieces_[i].layers[0]) * ny, end = size_t(pieces_[i].layers[1]) * ny;
      for (size_t row = begin; row < end; ++row) {
        for (uint32_t run = from.rowRunOffsets[row]; run < from.rowRunOffsets[row + 1]; ++run) {
          detail::append(whole_.runBegin, from.runBegin, run);
          detail::append(whole_.runEnd, from.runEnd, run);
          detail::append(whole_.runRegion, from.runRegion, run);
        }
        whole_.rowRunOffsets.push_back(uint32_t(whole_.runBegin.size()));
      }
    }
  }

  std::span<const RankPiece> pieces_;
  const std::vector<uint32_t>& order_;
  CutMesh whole_;
};

}  // namespace

const char* whatIsWrong(const RankPiece& piece) {
  const CutMesh& m = piece.cutMesh;
  if (piece.layers[0] < 0 || piece.layers[1] < piece.layers[0] || piece.layers[1] > m.grid.cells(2)) return "its layers are not the grid's";
  if (piece.vertexIds.size() != m.vertexCount() || piece.vertexRanks.size() != m.vertexCount() || piece.faceIds.size() != m.faceCount() ||
      piece.faceRanks.size() != m.faceCount() || piece.cellIds.size() != m.cellCount())
    return "its ids are not as many as its elements";
  for (const auto* ids : {&piece.vertexIds, &piece.faceIds, &piece.cellIds}) {
    if (!ascend(*ids)) return "its ids do not ascend";
  }
  for (const RankSeam& seam : piece.seams) {
    if (seam.faces.size() != seam.cells.size()) return "a seam has not a cell for each face";
    for (const uint32_t f : seam.faces) {
      if (f >= m.faceCount()) return "a seam has a face that does not exist";
    }
  }
  return nullptr;
}

}  // namespace operators

CutMesh joinPieces(std::span<const RankPiece> pieces) {
  return detail::runCall("joining", [&] {
    if (pieces.empty()) operators::refuse("There are no pieces to join.");
    for (size_t i = 0; i < pieces.size(); ++i) {
      const Check check = checkArrays(pieces[i].cutMesh);
      if (!check.pass) operators::refuse("The piece is damaged: " + check.message, int64_t(i));
      if (const char* wrong = operators::whatIsWrong(pieces[i]))
        operators::refuse(std::string("The piece is damaged: ") + wrong + ".", int64_t(i));
    }
    const std::vector<uint32_t> order = operators::inOrder(pieces);
    operators::requireAll(pieces, order);
    CutMesh whole = operators::WholeMaker(pieces, order).make();
    const Check check = checkArrays(whole);
    if (!check.pass) operators::refuse("The pieces do not fit together: " + check.message);
    return whole;
  });
}

}  // namespace mandoline
