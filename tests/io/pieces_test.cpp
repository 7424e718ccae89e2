// Pieces of a cut: saved, loaded and joined to the whole, to the bit, or refused.
#include <numeric>
#include <random>

#include "case_list.h"
#include "catch.h"
#include "mandoline/io.h"
#include "mcm_file.h"
#include "operators/join/join_cells.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

std::vector<uint64_t> numbers(size_t count) {
  std::vector<uint64_t> ids(count);
  std::iota(ids.begin(), ids.end(), uint64_t(0));
  return ids;
}

/// The made vertices that the piece has, and the runs of its layers.
void takeRest(const CutMesh& whole, RankPiece& piece) {
  CutMesh& m = piece.cutMesh;
  for (size_t i = 0; i < whole.madeVertices.size(); ++i) {
    const auto found = std::lower_bound(piece.vertexIds.begin(), piece.vertexIds.end(), whole.madeVertices[i]);
    if (found == piece.vertexIds.end() || *found != whole.madeVertices[i]) continue;
    m.madeVertices.push_back(uint32_t(found - piece.vertexIds.begin()));
    m.madeVertexKinds.push_back(whole.madeVertexKinds[i]);
    for (size_t j = 4 * i; j < 4 * i + 4; ++j) m.madeVertexParents.push_back(whole.madeVertexParents[j]);
  }
  m.rowRunOffsets.assign(1, 0);
  UntouchedCells(whole).forEach([&](const UntouchedCells::Run& run) {
    if (run.k < piece.layers[0] || run.k >= piece.layers[1]) return;
    const size_t row = size_t(run.k) * size_t(whole.grid.cells(1)) + size_t(run.j);
    m.rowRunOffsets.resize(row + 1, uint32_t(m.runBegin.size()));
    m.runBegin.push_back(run.begin);
    m.runEnd.push_back(run.end);
    m.runRegion.push_back(run.region);
  });
  m.rowRunOffsets.resize(whole.rowRunOffsets.size(), uint32_t(m.runBegin.size()));
}

/// The cells of some layers. The process below each plane has the faces there.
RankPiece pieceOf(const RankPiece& whole, int rank, std::array<int64_t, 2> layers) {
  IdRange range{0, 0};
  for (size_t c = 0; c < whole.cutMesh.cellCount(); ++c) {
    const int64_t layer = whole.cutMesh.cellGridCell[3 * c + 2];
    range.begin += layer < layers[0];
    range.end += layer < layers[1];
  }
  const operators::PieceCells cells[] = {{whole, range}};
  RankPiece piece = operators::joinCells(cells);
  const CutMesh& from = whole.cutMesh;
  CutMesh& m = piece.cutMesh;
  m.grid = from.grid;
  m.regionCount = from.regionCount;
  m.hasWinding = from.hasWinding;
  m.regionWinding = from.regionWinding;
  m.regionPartWinding = from.regionPartWinding;
  m.regionParity = from.regionParity;
  m.parityTriangles = from.parityTriangles;
  m.openTriangles = from.openTriangles;
  m.triangleCount = from.triangleCount;
  m.madeFrom = from.madeFrom;
  piece.layers = layers;
  piece.whole = whole.whole;
  piece.vertexRanks.assign(m.vertexCount(), rank);
  piece.faceRanks.assign(m.faceCount(), rank);
  if (m.faceCount() > 0) piece.seams.push_back({rank + 1, {0, uint32_t(m.faceCount() - 1)}, {7, 3}});
  takeRest(from, piece);
  return piece;
}

/// In pieces of so many layers, and one without any.
std::vector<RankPiece> piecesOf(const CutMesh& cutMesh, int64_t layers) {
  RankPiece whole;
  whole.cutMesh = cutMesh;
  whole.vertexIds = numbers(cutMesh.vertexCount());
  whole.faceIds = numbers(cutMesh.faceCount());
  whole.cellIds = numbers(cutMesh.cellCount());
  whole.whole = cutMesh.fingerprint;
  std::vector<RankPiece> pieces = {pieceOf(whole, 0, {1, 1})};
  const int64_t all = cutMesh.grid.cells(2);
  for (int64_t first = 0; first < all; first += layers)
    pieces.push_back(pieceOf(whole, int(pieces.size()), {first, std::min(first + layers, all)}));
  return pieces;
}

CutMesh cutOf(const Mesh& mesh, int64_t n) {
  const CutResult result = cut(mesh, Grid::around(mesh, n));
  REQUIRE(result);
  return result.mesh;
}

/// Two shells that cross, in five layers.
CutMesh crossing() { return cutOf(shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0.5, 1.5)}), 5); }

std::string mcmOf(const RankPiece& piece) {
  std::string bytes;
  writeMcm([&](std::string_view more) { bytes += more; }, piece);
  return bytes;
}

/// The error of joining; ok if they are joined.
Error errorOf(const std::vector<RankPiece>& pieces) {
  try {
    joinPieces(pieces);
  } catch (const CallError& error) {
    return error.error;
  }
  return {};
}

bool areSame(const RankPiece& a, const RankPiece& b) {
  const auto areSeams = [](const RankSeam& s, const RankSeam& t) { return s.rank == t.rank && s.faces == t.faces && s.cells == t.cells; };
  return differences(a.cutMesh, b.cutMesh).empty() && a.layers == b.layers && a.vertexIds == b.vertexIds && a.faceIds == b.faceIds &&
         a.cellIds == b.cellIds && a.vertexRanks == b.vertexRanks && a.faceRanks == b.faceRanks && a.whole == b.whole &&
         std::equal(a.seams.begin(), a.seams.end(), b.seams.begin(), b.seams.end(), areSeams);
}

}  // namespace

TEST_CASE("pieces of any layers, in any order, are joined to the whole, to the bit") {
  std::mt19937 random(1);
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name);
    const CutResult whole = cut(one.mesh, one.grid);
    REQUIRE(whole);
    for (const int64_t layers : {1, 3, 100}) {
      std::vector<RankPiece> pieces = piecesOf(whole.mesh, layers);
      std::shuffle(pieces.begin(), pieces.end(), random);
      REQUIRE(differences(joinPieces(pieces), whole.mesh).empty());
    }
  }
}

TEST_CASE("pieces are saved and loaded to the bit, and their cut-meshes alone, too") {
  const CutMesh whole = crossing();
  for (const RankPiece& piece : piecesOf(whole, 2)) {
    const std::string bytes = mcmOf(piece);
    CHECK(areSame(readRankPiece(bytes, "a.mcm"), piece));
    CHECK(differences(readCutMesh(bytes, "a.mcm"), piece.cutMesh).empty());
  }
}

TEST_CASE("pieces that do not make a whole are refused by their number") {
  const CutMesh whole = crossing();
  std::vector<RankPiece> pieces = piecesOf(whole, 1);  // of 5 layers, after one of none
  const auto refused = [](const std::vector<RankPiece>& some, int64_t element, const std::string& message) {
    const Error error = errorOf(some);
    CHECK(error.status == Status::badArgument);
    CHECK(error.element == element);
    CHECK(error.message == message);
  };
  refused({}, -1, "There are no pieces to join.");
  std::vector<RankPiece> some = pieces;
  some.erase(some.begin() + 2, some.begin() + 4);
  refused(some, 2, "Layers 1 to 2 of the grid are in no piece.");
  some = pieces;
  some.pop_back();
  refused(some, 4, "Layers 4 to 4 of the grid are in no piece.");
  some = pieces;
  some.push_back(some[2]);
  refused(some, 6, "Layers 1 to 1 of the grid are in two pieces.");
  some = pieces;
  some[3].whole = {5};
  refused(some, 3, "The piece is one of another cut.");
  some = pieces;
  some[3].layers = {2, 6};
  refused(some, 3, "The piece is damaged: its layers are not the grid's.");
  some = pieces;
  std::swap(some[3].faceIds[0], some[3].faceIds[1]);
  refused(some, 3, "The piece is damaged: its ids do not ascend.");
  some = pieces;
  some[3].vertexRanks.pop_back();
  refused(some, 3, "The piece is damaged: its ids are not as many as its elements.");
  some = pieces;
  some[3].seams[0].faces[1] += 1;
  refused(some, 3, "The piece is damaged: a seam has a face that does not exist.");
  some = pieces;
  some[3].cutMesh.vertexMask[0] = 8;
  refused(some, 3, "The piece is damaged: Vertex 0 has a mask of more than three bits.");
  some = pieces;
  for (uint64_t& id : some[3].cellIds) ++id;
  refused(some, -1, "The pieces are damaged: their ids are not those of one cut.");
}

TEST_CASE("a saved piece that is cut short or altered is refused, or sound") {
  const std::vector<RankPiece> pieces = piecesOf(crossing(), 2);
  const std::string bytes = mcmOf(pieces[2]);
  const auto isRead = [](const std::string& some) {
    try {
      std::vector<RankPiece> one = {readRankPiece(some, "a.mcm")};
      one[0].layers = {0, one[0].cutMesh.grid.cells(2)};
      errorOf(one);  // does not crash
      return true;
    } catch (const FileError& error) {
      REQUIRE(std::string(error.what()).find("a.mcm: ") == 0);
      return false;
    }
  };
  const size_t whole = mcmOf(RankPiece(pieces[2]).cutMesh).size();
  REQUIRE(whole < bytes.size());
  for (size_t length = 0; length < bytes.size(); ++length) REQUIRE_FALSE(isRead(bytes.substr(0, length)));
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string altered = bytes;
    altered[whole + random() % (bytes.size() - whole)] ^= char(1 << random() % 8);
    CAPTURE(round);
    REQUIRE_FALSE(isRead(altered));
    repairChecksums(altered);
    refused += !isRead(altered);
  }
  CHECK(refused > 100);
}
