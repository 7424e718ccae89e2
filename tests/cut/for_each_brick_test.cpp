#include "mandoline/for_each_brick.h"

#include <optional>
#include <thread>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "described_cells.h"
#include "refusal.h"
#include "same_bits.h"
#include "seam_meshes.h"
#include "shapes.h"

using namespace mandoline;

namespace {

PreparedMesh preparedOf(const Mesh& mesh, Intersections intersections = Intersections::resolve) {
  PrepareOptions options;
  options.intersections = intersections;
  PrepareResult result = prepare(mesh, options);
  REQUIRE(result);
  return result.mesh;
}

ForEachBrickOptions bricksOf(int64_t cells, bool untouched = false, unsigned threads = 1) {
  ForEachBrickOptions options;
  options.cells = cells;
  options.untouched = untouched;
  options.threads = threads;
  return options;
}

void checkPieces(const Mesh& mesh, const Grid& grid, int64_t cells, unsigned threads = 1) {
  CAPTURE(cells, threads);
  const PreparedMesh prepared = preparedOf(mesh);
  const CutResult whole = cut(prepared, grid);
  REQUIRE(whole);
  const bool areSame = describedCells(prepared, grid, bricksOf(cells, true, threads)) == describedCells(whole.mesh);
  CHECK(areSame);
}

}  // namespace

TEST_CASE("Pieces have the cells of the whole cut, to the bit, for all sizes of bricks", "[pieces][seams]") {
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    for (const int shift : {0, 1, 2}) checkPieces(one.mesh, one.grid, int64_t(1) << shift, 1 + unsigned(shift));  // 1: all are seams
  }
}

TEST_CASE("Pieces are the same where seams pass through what is hard", "[pieces][seams]") {
  for (const Mesh& mesh : seamMeshes()) {
    CAPTURE(mesh.triangleCount());
    for (const int64_t cells : {1, 2, 4, 8, 16}) checkPieces(mesh, seamGrid(), cells, 1 + unsigned(cells) % 3);
  }
}

TEST_CASE("Pieces of a mesh that is assumed not to meet itself are those of the whole cut", "[pieces]") {
  const PreparedMesh prepared = preparedOf(shapes::noisySphere({4, 4, 4}, 3, 0.2, 3), Intersections::assumeNone);
  const bool areSame = describedCells(prepared, unitGrid(8), bricksOf(2, true)) == describedCells(cut(prepared, unitGrid(8)).mesh);
  CHECK(areSame);
}

TEST_CASE("Pieces are valid cut-meshes of their triangles, but for winding numbers, which are the whole mesh's", "[pieces]") {
  for (const NamedCase& one : caseList()) {
    CAPTURE(one.name);
    const auto check = [](const CutPiece& piece) {
      for (const Check& found : validate(piece.mesh, piece.cutMesh).checks) {
        CAPTURE(piece.first, found.name, found.message);
        CHECK((found.pass || found.name == "windingNumber"));
      }
    };
    forEachBrick(preparedOf(one.mesh), one.grid, check, bricksOf(2, true));
  }
}

TEST_CASE("Bricks come by z, then y, then x, with the planes of the grid", "[pieces]") {
  const Grid grid = Grid::rectilinear({{{0, 1, 2.5, 3, 4, 7}, {0, 1, 2}, {0, 0.5, 1, 4}}});
  std::vector<std::array<int64_t, 3>> firsts;
  const auto note = [&](const CutPiece& piece) {
    firsts.push_back(piece.first);
    for (size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = piece.cutMesh.grid.planes[d];
      CHECK(std::equal(planes.begin(), planes.end(), grid.planes[d].begin() + piece.first[d]));
    }
  };
  forEachBrick(preparedOf(shapes::cube(0.25, 1.75)), grid, note, bricksOf(2, true));
  CHECK(firsts == std::vector<std::array<int64_t, 3>>{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 0, 2}, {2, 0, 2}, {4, 0, 2}});
  firsts.clear();
  forEachBrick(preparedOf(shapes::cube(0.25, 1.75)), grid, note, bricksOf(2));
  CHECK(firsts == std::vector<std::array<int64_t, 3>>{{0, 0, 0}, {0, 0, 2}});  // only these are touched
}

TEST_CASE("A piece has the triangles near its brick alone", "[pieces]") {
  const Mesh mesh = shapes::icosphere({32, 32, 32}, 30, 5);
  size_t pieces = 0, triangles = 0, most = 0;
  const auto count = [&](const CutPiece& piece) {
    ++pieces;
    triangles += piece.triangles.size();
    most = std::max(most, piece.triangles.size());
    CHECK(piece.mesh.triangleCount() == piece.triangles.size());
    CHECK(piece.mesh.vertexCount() == piece.triVertices.size());
    for (size_t v = 0; v < piece.triVertices.size(); ++v)
      CHECK(std::equal(&piece.mesh.positions[3 * v], &piece.mesh.positions[3 * v] + 3, &mesh.positions[3 * piece.triVertices[v]]));
  };
  forEachBrick(preparedOf(mesh), unitGrid(64), count, bricksOf(16));
  CHECK(pieces > 30);
  CHECK(most < mesh.triangleCount() / 20);
  CHECK(triangles < 2 * mesh.triangleCount());
}

TEST_CASE("Pieces can be measured, and have the whole's volumes", "[pieces]") {
  const Mesh mesh = shapes::torus({4.1, 4.2, 4.3}, 2.25, 0.9, 24, 12);
  const Grid grid = unitGrid(8);
  double inside = 0;
  forEachBrick(
      preparedOf(mesh), grid,
      [&](const CutPiece& piece) {
        const std::vector<double> volumes = regionVolumes(piece.cutMesh, measure(piece.mesh, piece.cutMesh));
        for (size_t r = 0; r < volumes.size(); ++r) inside += volumes[r] * piece.cutMesh.regionWinding[r];
      },
      bricksOf(2, true));
  CHECK(inside == Approx(shapes::signedVolume(mesh)).epsilon(1e-12));
}

TEST_CASE("Bricks of a grid that is far larger than the mesh", "[pieces]") {
  Grid grid = Grid::box({-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}, {4, 4, 4});
  const Mesh mesh = shapes::cube(-1, 1);
  checkPieces(mesh, grid, 2);
}

TEST_CASE("What is wrong with a grid, a mesh or the options is said as by cut()", "[pieces]") {
  const PreparedMesh prepared = preparedOf(shapes::cube(0.5, 1.5));
  const auto ignore = [](const CutPiece&) {};
  const auto refused = [&](const PreparedMesh& mesh, const Grid& grid, int64_t cells = 2) {
    return refusal([&] { forEachBrick(mesh, grid, ignore, bricksOf(cells)); });
  };
  CHECK(refused(prepared, Grid::rectilinear({{{0, 1, 2}, {0, 2, 1}, {0, 1, 2}}})) == std::pair(Status::badGrid, int64_t(1)));
  CHECK(refused(PreparedMesh(), unitGrid(2)) == std::pair(Status::emptyMesh, int64_t(-1)));
  for (const int64_t cells : {-1, 0, 3, 1 << 25}) CHECK(refused(prepared, unitGrid(2), cells) == std::pair(Status::badOption, int64_t(-1)));
  CHECK(refused(prepared, unitGrid(2), 1 << 24) == std::pair(Status::ok, int64_t(-1)));
}

TEST_CASE("A contradiction in a piece names triangles of the whole mesh", "[pieces]") {
  // Far from the first brick, and not its first triangles.
  Mesh mesh = shapes::merged({shapes::cube(0.5, 1.5), shapes::box({5.25, 5.25, 5.25}, {6.5, 6.5, 6.5}), shapes::cube(5.75, 7)});
  const PreparedMesh prepared = preparedOf(mesh, Intersections::assumeNone);
  const CutResult whole = cut(prepared, unitGrid(8));
  REQUIRE(whole.error.status == Status::selfIntersection);
  try {
    forEachBrick(
        prepared, unitGrid(8), [](const CutPiece&) {}, bricksOf(4));
    FAIL("no contradiction");
  } catch (const CallError& error) {
    CHECK(error.error.status == Status::selfIntersection);
    CHECK(error.error.element == whole.error.element);
    CHECK(error.error.element2 == whole.error.element2);
    CHECK(error.error.message == whole.error.message);
  }
}

TEST_CASE("Progress counts bricks, and can cancel", "[pieces]") {
  const PreparedMesh prepared = preparedOf(shapes::icosphere({4, 4, 4}, 3.1, 2));
  for (const unsigned threads : {1u, 3u}) {
    ForEachBrickOptions options = bricksOf(4, true, threads);
    std::vector<size_t> done;
    options.progress = [&](const Progress& progress) {
      if (progress.stage != std::string("bricks") || progress.total == 1) return true;  // 1: the stage begins
      CHECK(progress.total == 8);
      done.push_back(progress.done);
      return progress.done < 3;
    };
    size_t pieces = 0;
    const auto count = [&](const CutPiece&) { ++pieces; };
    CHECK(refusal([&] { forEachBrick(prepared, unitGrid(8), count, options); }) == std::pair(Status::cancelled, int64_t(-1)));
    CHECK(pieces == 3);
    CHECK(std::is_sorted(done.begin(), done.end()));
  }
}

TEST_CASE("What the callbacks throw passes through", "[pieces]") {
  const PreparedMesh prepared = preparedOf(shapes::cube(0.5, 3.5));
  const auto throwing = [](const CutPiece&) { throw std::string("enough"); };
  CHECK_THROWS_AS(forEachBrick(prepared, unitGrid(4), throwing, bricksOf(2)), std::string);
  ForEachBrickOptions options = bricksOf(2, false, 2);
  options.progress = [](const Progress& progress) -> bool {
    if (progress.done > 0) throw 7;
    return true;
  };
  CHECK_THROWS_AS(forEachBrick(
                      prepared, unitGrid(4), [](const CutPiece&) {}, options),
                  int);
}

TEST_CASE("Bricks are cut in any order, and by several threads at a time", "[pieces]") {
  const Mesh mesh = shapes::merged({shapes::torus({4.1, 3.9, 4}, 2.5, 0.8, 16, 10), shapes::icosphere({5, 4, 4}, 1.5, 2)});
  const Grid grid = unitGrid(8);
  std::optional<BrickCutter> kept;
  {
    const PreparedMesh prepared = preparedOf(mesh);
    kept.emplace(prepared, grid, bricksOf(4));
  }  // it keeps what it needs
  const BrickCutter cutter = *kept;
  kept.reset();
  REQUIRE(cutter.count() == 8);
  std::vector<CutPiece> inOrder;
  forEachBrick(
      preparedOf(mesh), grid, [&](CutPiece piece) { inOrder.push_back(std::move(piece)); }, bricksOf(4));
  REQUIRE(inOrder.size() == 8);
  std::vector<CutPiece> pieces(8);
  const auto cutFrom = [&](uint64_t first) {
    for (uint64_t b = first; b < 8; b += 2) pieces[7 - b] = cutter.cut(7 - b, bricksOf(4));
  };
#ifdef __EMSCRIPTEN__
  cutFrom(0);
  cutFrom(1);
#else
  std::thread other([&] { cutFrom(1); });
  cutFrom(0);
  other.join();
#endif
  for (size_t b = 0; b < 8; ++b) {
    CHECK(cutter.first(b) == inOrder[b].first);
    CHECK(pieces[b].first == inOrder[b].first);
    CHECK((partsOf(pieces[b].cutMesh) == partsOf(inOrder[b].cutMesh)));
  }
}

TEST_CASE("Bricks that are not there, that the surface is far from, and that it comes near to but does not touch", "[pieces]") {
  const Mesh small = shapes::octahedron({1.5, 1.5, 1.5}, 0.75), larger = shapes::octahedron({2.5, 2.5, 2.5}, 0.75);
  const BrickCutter near(preparedOf(small), unitGrid(8), bricksOf(4)), all(preparedOf(small), unitGrid(8), bricksOf(4, true)),
      nearer(preparedOf(larger), unitGrid(8), bricksOf(4));
  REQUIRE(near.count() == 1);
  REQUIRE(all.count() == 8);
  REQUIRE(nearer.count() == 8);
  CHECK(near.cut(0).cutMesh.cellCount() > 0);
  CHECK(all.cut(7).cutMesh.cellCount() == 0);
  CHECK(nearer.cut(7).cutMesh.cellCount() == 0);
  CHECK(all.first(7) == std::array<int64_t, 3>{4, 4, 4});
  CHECK(refusal([&] { all.cut(8); }) == std::pair{Status::badArgument, int64_t(8)});
  CHECK(refusal([&] { near.first(1); }) == std::pair{Status::badArgument, int64_t(1)});
  CHECK(refusal([&] { BrickCutter(preparedOf(small), unitGrid(8), bricksOf(3)); }).first == Status::badOption);
}
