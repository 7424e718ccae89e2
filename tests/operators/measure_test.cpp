// Measures against exact values, with cut-cells a tenth of a billionth of a grid cell wide, and against what they have to add up to.
#include "mandoline/measure.h"

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;

namespace {

struct Measured {
  Mesh input;
  CutMesh mesh;
  Measures measures;

  std::vector<uint32_t> cellsIn(int i, int j, int k) const {
    std::vector<uint32_t> cells;
    for (uint32_t c = 0; c < mesh.cellCount(); ++c) {
      const int32_t* at = &mesh.cellGridCell[3 * c];
      if (at[0] == i && at[1] == j && at[2] == k) cells.push_back(c);
    }
    std::sort(cells.begin(), cells.end(), [&](uint32_t a, uint32_t b) { return measures.cellVolume[a] < measures.cellVolume[b]; });
    return cells;
  }
};

Measured measured(const Mesh& input, const Grid& grid, double snapTolerance = 0) {
  CutOptions options;
  options.snapTolerance = snapTolerance;
  const CutResult result = cut(input, grid, options);
  REQUIRE(result.error.message == "");
  return {input, result.mesh, measure(input, result.mesh)};
}

double relativeError(double value, double exact) { return std::fabs(value / exact - 1); }

/// The cut-cells of a grid cell make up its volume and its first moments, and the faces of a triangle make up its area.
void requireSums(const Measured& m) {
  const Grid& grid = m.mesh.grid;
  double worstVolume = 0, worstMoment = 0, worstArea = 0;
  for (int k = 0; k < grid.cells(2); ++k) {
    for (int j = 0; j < grid.cells(1); ++j) {
      for (int i = 0; i < grid.cells(0); ++i) {
        const std::vector<uint32_t> cells = m.cellsIn(i, j, k);
        if (cells.empty()) continue;
        const int at[3] = {i, j, k};
        double whole = 1, volume = 0;
        for (int d = 0; d < 3; ++d) whole *= grid.planes[d][at[d] + 1] - grid.planes[d][at[d]];
        for (const uint32_t c : cells) volume += m.measures.cellVolume[c];
        worstVolume = std::max(worstVolume, relativeError(volume, whole));
        for (int d = 0; d < 3; ++d) {
          double moment = 0;
          const double lo = grid.planes[d][at[d]], hi = grid.planes[d][at[d] + 1];
          for (const uint32_t c : cells) moment += m.measures.cellVolume[c] * ((m.measures.cellCentroid[3 * c + d] - lo) / (hi - lo) - 0.5);
          worstMoment = std::max(worstMoment, std::fabs(moment / whole));
        }
      }
    }
  }
  CHECK(worstVolume < 1e-14);
  CHECK(worstMoment < 1e-13);
  std::vector<double> areas(m.input.triangleCount(), 0);
  for (size_t f = 0; f < m.mesh.faceCount(); ++f) {
    if (m.mesh.faceTriangle[f] >= 0) areas[m.mesh.faceTriangle[f]] += m.measures.faceArea[f];
  }
  for (size_t t = 0; t < areas.size(); ++t) {
    const auto corner = [&](int i) {
      const double* p = &m.input.positions[3 * m.input.triangles[3 * t + i]];
      return shapes::Point{p[0], p[1], p[2]};
    };
    const double area = shapes::area(shapes::triangle(corner(0), corner(1), corner(2)));
    worstArea = std::max(worstArea, relativeError(areas[t], area));
  }
  CHECK(worstArea < 1e-11);
}

/// The faces of a cut-cell close it: their vector areas cancel.
void requireClosed(const Measured& m) {
  double worst = 0;
  for (size_t c = 0; c < m.mesh.cellCount(); ++c) {
    double sum[3] = {0, 0, 0}, whole = 0;
    for (const uint32_t h : m.mesh.halfFaces(c)) {
      const double area = m.measures.faceArea[h / 2];
      for (int d = 0; d < 3; ++d) sum[d] += (h % 2 == 0 ? area : -area) * m.measures.faceNormal[3 * (h / 2) + d];
      whole += area;
    }
    for (const double s : sum) worst = std::max(worst, std::fabs(s) / whole);
  }
  CHECK(worst < 1e-13);
}

}  // namespace

TEST_CASE("measure: a corner tetrahedron of a tenth of a billionth of a cell", "[measure]") {
  // A triangle in the plane 3 u + 5 v + 7 w = 1 about the grid vertex (1, 1, 1), in units of s; its crossings are no doubles.
  const double s = std::ldexp(1.0, GENERATE(-31, -34, -40));
  const auto at = [s](double u, double v, double w) { return shapes::Point{1 + s * u, 1 + s * v, 1 + s * w}; };
  Mesh mesh = shapes::triangle(at(102, -61, 0), at(-48, 169, -100), at(-48, -111, 100));
  if (GENERATE(false, true)) mesh = shapes::flipped(mesh);
  const Measured m = measured(mesh, unitGrid(3));
  requireSums(m);
  const std::vector<uint32_t> cells = m.cellsIn(1, 1, 1);
  REQUIRE(cells.size() == 2);
  CHECK(relativeError(m.measures.cellVolume[cells[0]], s * s * s / 630) < 1e-14);
  CHECK(m.measures.cellVolume[cells[1]] == 1);
  const auto halfFaces = m.mesh.halfFaces(cells[0]);
  REQUIRE(halfFaces.size() == 4);
  const double exactArea[3] = {s * s / 70, s * s / 42, s * s / 30};
  for (const uint32_t h : halfFaces) {
    const size_t f = h / 2;
    const int axis = m.mesh.faceAxis[f];
    CHECK(relativeError(m.measures.faceArea[f], axis < 0 ? s * s * std::sqrt(83.0) / 210 : exactArea[axis]) < 1e-14);
    if (axis >= 0) continue;
    const double sign = h % 2 == 0 ? 1 : -1, exactNormal[3] = {3, 5, 7};
    for (int d = 0; d < 3; ++d) CHECK(relativeError(sign * m.measures.faceNormal[3 * f + d], exactNormal[d] / std::sqrt(83.0)) < 1e-15);
  }
  const CutEdges edges = cutEdges(mesh, m.mesh);
  std::vector<double> lengths = edges.edgeLength;
  for (const double exact :
       {s / 3, s / 5, s / 7, s * std::hypot(1 / 3.0, 1 / 5.0), s * std::hypot(1 / 5.0, 1 / 7.0), s * std::hypot(1 / 3.0, 1 / 7.0)}) {
    CHECK(std::any_of(lengths.begin(), lengths.end(), [&](double l) { return relativeError(l, exact) < 1e-14; }));
  }
}

TEST_CASE("measure: a slab of a tenth of a billionth of a cell", "[measure]") {
  const double s = 0x1p-35;
  // The plane z = 1 + s (x + 3) through the whole grid.
  const auto at = [s](double x, double y) { return shapes::Point{x, y, 1 + s * (x + 3)}; };
  const Measured m = measured(shapes::quad(at(-2, -2), at(5, -2), at(5, 7), at(-2, 7)), unitGrid(3));
  for (int i = 0; i < 3; ++i) {
    const std::vector<uint32_t> cells = m.cellsIn(i, 1, 1);
    REQUIRE(cells.size() == 2);
    CHECK(relativeError(m.measures.cellVolume[cells[0]], s * (i + 3.5)) < 1e-14);
    CHECK(m.measures.cellCentroid[3 * cells[0] + 1] == Approx(1.5).epsilon(1e-15));
  }
  requireClosed(m);
}

TEST_CASE("measure: a diagonal slab of a tenth of a billionth of a cell", "[measure]") {
  const double s = 0x1p-34;
  // Between the planes x + y = 3 and x + y = 3 + s, where all products nearly cancel.
  const auto sheet = [](double sum) { return shapes::quad({-2, sum + 2, -1}, {5, sum - 5, -1}, {5, sum - 5, 4}, {-2, sum + 2, 4}); };
  const Measured m = measured(shapes::merged({sheet(3), sheet(3 + s)}), unitGrid(3));
  const std::vector<uint32_t> cells = m.cellsIn(1, 1, 1);
  REQUIRE(cells.size() == 3);
  CHECK(relativeError(m.measures.cellVolume[cells[0]], s - s * s / 2) < 1e-14);
  CHECK(m.measures.cellCentroid[3 * cells[0]] == Approx(1.5).epsilon(1e-9));
  CHECK(m.measures.cellCentroid[3 * cells[0] + 2] == Approx(1.5).epsilon(1e-14));
  requireClosed(m);
}

TEST_CASE("measure: what the parts add up to", "[measure]") {
  SECTION("a sphere") {
    const Measured m = measured(shapes::noisySphere({1.5, 1.5, 1.5}, 1.2, 0.1, 3), unitGrid(3));
    requireSums(m);
    requireClosed(m);
  }
  SECTION("a torus through many grid-faces with holes") {
    const Measured m = measured(shapes::torus({0.5, 0.5, 0.5}, 0.3, 0.1, 31, 17), Grid::regular({0, 0, 0}, {0.5, 1, 0.25}, {2, 1, 4}));
    requireSums(m);
    requireClosed(m);
  }
  SECTION("bubbles") {
    requireSums(
        measured(shapes::merged({shapes::icosphere({0.5, 0.5, 0.5}, 0.4, 2), shapes::icosphere({0.5, 0.5, 0.5}, 0.2, 2)}), unitGrid(1)));
  }
  SECTION("sheets") { requireSums(measured(shapes::moebius({1.5, 1.5, 1.5}, 1, 0.6, 24), unitGrid(3))); }
  SECTION("coplanar triangles") { requireSums(measured(shapes::cube(1, 3), unitGrid(4))); }
  SECTION("unwelded") { requireSums(measured(shapes::unwelded(shapes::icosphere({1.5, 1.5, 1.5}, 1.3, 2)), unitGrid(3))); }
}

TEST_CASE("measure: snapped tri-vertices", "[measure]") {
  SECTION("all of them") {
    const Measured m = measured(shapes::cube(1.01, 2.99), unitGrid(4), 0.05);
    const std::vector<double> volumes = regionVolumes(m.mesh, m.measures);
    REQUIRE(volumes.size() == 2);
    CHECK(std::min(volumes[0], volumes[1]) == 8);
    for (size_t f = 0; f < m.mesh.faceCount(); ++f) CHECK(std::fabs(m.measures.faceNormal[3 * f + m.mesh.faceAxis[f]]) == 1);
  }
  SECTION("some, welded by the move, and some outside of the grid, measure as if moved before") {
    // The first two corners both move to (1, 1, 1), so two triangles vanish; the last moves to x = 2 outside of the grid.
    const Mesh bubble = shapes::tetrahedron({0.2, 0.3, 0.4}, {0.6, 0.3, 0.4}, {0.3, 0.7, 0.3}, {0.3, 0.3, 0.8});
    const Mesh before = shapes::merged({shapes::tetrahedron({1, 1, 1}, {1.01, 1, 1}, {1, 4.5, 1.25}, {2.01, 1.5, 4.5}), bubble});
    const Mesh after = shapes::merged({shapes::tetrahedron({1, 1, 1}, {1, 1, 1}, {1, 4.5, 1.25}, {2, 1.5, 4.5}), bubble});
    const Measured snapped = measured(before, unitGrid(3), 0.05), expected = measured(after, unitGrid(3));
    REQUIRE(snapped.mesh.loopVertices == expected.mesh.loopVertices);
    const auto worst = [](const std::vector<double>& a, const std::vector<double>& b) {
      double result = 0;
      for (size_t i = 0; i < a.size(); ++i) result = std::max(result, std::fabs(a[i] - b[i]));
      return result;
    };
    CHECK(worst(snapped.measures.cellVolume, expected.measures.cellVolume) < 1e-15);
    CHECK(worst(snapped.measures.cellCentroid, expected.measures.cellCentroid) < 1e-14);
    CHECK(worst(snapped.measures.faceArea, expected.measures.faceArea) < 1e-15);
    CHECK(worst(snapped.measures.faceNormal, expected.measures.faceNormal) < 1e-14);
  }
  SECTION("of a triangle that cuts a tiny corner off") {
    // Once its first corner has moved to x = 2, its plane is 3 u + 5 v + 7 w = 1, as above.
    const double s = 0x1p-34;
    const Mesh mesh =
        shapes::triangle({2 + 0x1p-13, 2.5 + 3 * s, -0.5 - 2 * s}, {-0.5, 2.25 + 3 * s, 0.75 - 2 * s}, {1.5, -1.75 + 3 * s, 2.75 - 2 * s});
    const Measured m = measured(mesh, Grid::regular({-4, -4, -4}, {1, 1, 1}, {8, 8, 8}), 0x1p-12);
    const std::vector<uint32_t> cells = m.cellsIn(5, 5, 5);
    REQUIRE(cells.size() == 2);
    CHECK(relativeError(m.measures.cellVolume[cells[0]], s * s * s / 630) < 1e-14);
  }
}

TEST_CASE("measure: scaling by a power of two scales to the bit", "[measure]") {
  const double scale = GENERATE(0x1p-40, 0x1p60);
  const Mesh mesh = shapes::noisySphere({1.5, 1.5, 1.5}, 1.2, 0.1, 2);
  const Measured m = measured(mesh, unitGrid(3)),
                 scaled = measured(shapes::scaled(mesh, {scale, scale, scale}), Grid::regular({0, 0, 0}, {scale, scale, scale}, {3, 3, 3}));
  REQUIRE(scaled.measures.cellVolume.size() == m.measures.cellVolume.size());
  bool same = true;
  for (size_t c = 0; c < m.mesh.cellCount(); ++c) same &= scaled.measures.cellVolume[c] == scale * scale * scale * m.measures.cellVolume[c];
  for (size_t f = 0; f < m.mesh.faceCount(); ++f) same &= scaled.measures.faceArea[f] == scale * scale * m.measures.faceArea[f];
  for (size_t i = 0; i < m.measures.cellCentroid.size(); ++i) same &= scaled.measures.cellCentroid[i] == scale * m.measures.cellCentroid[i];
  CHECK(same);
  CHECK(scaled.measures.faceNormal == m.measures.faceNormal);
}

TEST_CASE("measure: a face without measurable area has no invalid numbers", "[measure]") {
  // An edge that misses the grid line y = z = L by 66, which is beyond double-doubles beside L.
  const double l = 0x1p120;
  const Mesh mesh = shapes::triangle({l / 2, 3 * l, 3 * l}, {l / 2, 0, 100}, {l / 2, 3 * l, 0});
  const Measured m = measured(mesh, Grid::regular({0, 0, 0}, {l, l, l}, {3, 3, 3}));
  const Measures& measures = m.measures;
  CHECK(std::count(measures.faceArea.begin(), measures.faceArea.end(), 0) > 0);
  for (const auto* values :
       {&measures.faceArea, &measures.faceNormal, &measures.faceCentroid, &measures.cellVolume, &measures.cellCentroid}) {
    CHECK(std::all_of(values->begin(), values->end(), [](double x) { return std::isfinite(x); }));
  }
}

TEST_CASE("measure: a face that rounding leaves without area has the normal of its triangle", "[measure]") {
  // The second triangle cuts off a corner of the first by less than a rounding: both new vertices of the corner are rounded to one place.
  const double more = 1 + 0x1p-52;
  const Mesh mesh = shapes::merged(
      {shapes::triangle({1, 1, 1}, {3, 2, 1.5}, {3, 2.125, 0.5}), shapes::triangle({1, 13, 1}, {more, -3, -15}, {more, -3, 17})});
  const Measured m = measured(mesh, Grid::box({-20, -20, -20}, {20, 20, 20}, {1, 1, 1}));
  const double expected[3] = {-1.0625, 2, 0.25}, length = std::sqrt(1.0625 * 1.0625 + 4.0625);
  size_t without = 0, wrong = 0;
  for (size_t f = 0; f < m.mesh.faceCount(); ++f) {
    if (m.mesh.faceTriangle[f] != 0) continue;
    without += m.measures.faceArea[f] == 0;
    for (size_t d = 0; d < 3; ++d) wrong += !(std::fabs(m.measures.faceNormal[3 * f + d] - expected[d] / length) < 1e-12);
  }
  CHECK(without == 1);
  CHECK(wrong == 0);
}

TEST_CASE("measure: centroids lie in their cells, also where rounding leaves no volume", "[measure]") {
  Mesh mesh;  // a Klein bottle, whose crossings miss vertices by less than a rounding
  constexpr int kAround = 24, kAcross = 12;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      const double u = 2 * M_PI * i / kAround, v = 2 * M_PI * j / kAcross, a = std::cos(u / 2), b = std::sin(u / 2);
      const double r = 2 + a * std::sin(v) - b * std::sin(2 * v);
      mesh.positions.insert(mesh.positions.end(), {r * std::cos(u), r * std::sin(u), b * std::sin(v) + a * std::sin(2 * v)});
    }
  }
  const auto id = [](int i, int j) { return uint32_t(i < kAround ? i * kAcross + j % kAcross : (kAcross - j) % kAcross); };
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      const uint32_t p = id(i, j), q = id(i + 1, j), r = id(i + 1, j + 1), s = id(i, j + 1);
      mesh.triangles.insert(mesh.triangles.end(), {p, q, r, p, r, s});
    }
  }
  const Measured m = measured(mesh, Grid::around(mesh, 7));
  size_t outside = 0;
  for (size_t c = 0; c < m.mesh.cellCount(); ++c) {
    for (size_t d = 0; d < 3; ++d) {
      const double* planes = &m.mesh.grid.planes[d][size_t(m.mesh.cellGridCell[3 * c + d])];
      const double x = m.measures.cellCentroid[3 * c + d];
      outside += !(x >= planes[0] && x <= planes[1]);
    }
  }
  CHECK(outside == 0);
}

TEST_CASE("measure: cut-edges are unique, ascending and those of the loops", "[measure]") {
  const Measured m = measured(shapes::noisySphere({1.5, 1.5, 1.5}, 1.2, 0.1, 2), unitGrid(3));
  const CutEdges edges = cutEdges(m.input, m.mesh);
  std::vector<std::array<uint32_t, 2>> expected, given;
  for (size_t l = 0; l < m.mesh.loopCount(); ++l) {
    const auto loop = m.mesh.loop(l);
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      expected.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  for (size_t e = 0; e < edges.edgeLength.size(); ++e) given.push_back({edges.edgeVertices[2 * e], edges.edgeVertices[2 * e + 1]});
  CHECK(given == expected);
  double worst = 0;
  for (size_t e = 0; e < given.size(); ++e) {
    const double *a = &m.mesh.positions[3 * given[e][0]], *b = &m.mesh.positions[3 * given[e][1]];
    worst = std::max(worst, std::fabs(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) - edges.edgeLength[e]));
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("measure: volumes of regions count untouched cells", "[measure]") {
  const Measured m = measured(shapes::cube(2, 5), Grid::regular({0, 0, 0}, {0.5, 1, 2}, {20, 10, 5}));
  std::vector<double> volumes = regionVolumes(m.mesh, m.measures);
  std::sort(volumes.begin(), volumes.end());
  CHECK(volumes == std::vector<double>{27, 973});
  const Grid graded = Grid::rectilinear({{{0, 0.25, 1, 4}, {-1, 0.5, 3}, {0, 2, 3, 8}}});
  const Measured g = measured(shapes::cube(0.75, 2.5), graded);
  volumes = regionVolumes(g.mesh, g.measures);
  std::sort(volumes.begin(), volumes.end());
  REQUIRE(volumes.size() == 2);
  CHECK(relativeError(volumes[0], 1.75 * 1.75 * 1.75) < 1e-15);
  CHECK(relativeError(volumes[1], 128 - 1.75 * 1.75 * 1.75) < 1e-15);
}

TEST_CASE("measure: the same bits for any number of threads", "[measure]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.1, 4);
  const CutResult result = cut(mesh, Grid::around(mesh, 32));
  REQUIRE(result);
  REQUIRE(result.mesh.cellCount() > 2048);
  const auto withThreads = [](unsigned threads) {
    RunOptions options;
    options.threads = threads;
    return options;
  };
  const Measures one = measure(mesh, result.mesh, withThreads(1));
  const CutEdges edges = cutEdges(mesh, result.mesh, withThreads(1));
  for (const unsigned threads : {0u, 2u, 7u}) {
    const Measures many = measure(mesh, result.mesh, withThreads(threads));
    CHECK(many.faceArea == one.faceArea);
    CHECK(many.faceNormal == one.faceNormal);
    CHECK(many.faceCentroid == one.faceCentroid);
    CHECK(many.cellVolume == one.cellVolume);
    CHECK(many.cellCentroid == one.cellCentroid);
    CHECK(cutEdges(mesh, result.mesh, withThreads(threads)).edgeLength == edges.edgeLength);
  }
}

TEST_CASE("measure: progress, cancelling, and what a callback throws", "[measure]") {
  const Measured m = measured(shapes::noisySphere({1.5, 1.5, 1.5}, 1.2, 0.1, 4), unitGrid(3));
  int stages = 0;
  RunOptions options;
  options.progress = [&](const Progress& progress) {
    stages = std::max(stages, progress.stageIndex + 1);
    CHECK(progress.stageCount == 3);
    return true;
  };
  CHECK(measure(m.input, m.mesh, options).cellVolume == m.measures.cellVolume);
  CHECK(stages == 3);
  options.progress = [](const Progress& progress) { return progress.stageIndex < 2; };
  try {
    measure(m.input, m.mesh, options);
    FAIL("not cancelled");
  } catch (const CallError& error) {
    CHECK(error.error.status == Status::cancelled);
    CHECK(error.error.message == "The measuring was cancelled.");
  }
  struct OfTheCaller {};
  options.progress = [](const Progress&) -> bool { throw OfTheCaller(); };
  CHECK_THROWS_AS(measure(m.input, m.mesh, options), OfTheCaller);
  CHECK_THROWS_AS(cutEdges(m.input, m.mesh, options), OfTheCaller);
}

TEST_CASE("measure: a mesh that is not the cut-mesh's is refused", "[measure]") {
  const Measured m = measured(shapes::icosphere({1.5, 1.5, 1.5}, 1.2, 1), unitGrid(3));
  const auto refused = [&](const Mesh& mesh) {
    try {
      measure(mesh, m.mesh);
      return std::string();
    } catch (const CallError& error) {
      CHECK(error.error.status == Status::badArgument);
      return error.error.message;
    }
  };
  CHECK(refused(shapes::cube(1, 2)) == "The mesh is not the one that the cut-mesh was made from: it has 12 triangles, that one had 80.");
  Mesh other = m.input;
  other.positions.resize(9);
  CHECK(refused(other) == "Triangle 0 of the mesh names a tri-vertex that does not exist.");
  for (uint32_t& v : other.triangles) v %= 3;
  CHECK(refused(other) == "The mesh is not the one that the cut-mesh was made from: it lacks a tri-vertex of vertex 3.");
  other = m.input;
  other.positions.push_back(0);
  CHECK(refused(other) == "The length of an array of the mesh is not a multiple of 3.");
  other = m.input;
  other.positions[3 * 7 + 1] += 1e-9;
  CHECK(refused(other) == "The mesh is not the one that the cut-mesh was made from: its positions or triangles are others.");
  other.positions[3 * 7 + 1] = std::nan("");
  CHECK(refused(other) == "Tri-vertex 7 of the mesh is not finite.");
  CHECK_THROWS_AS(regionVolumes(m.mesh, Measures{}), CallError);
}

TEST_CASE("measure: tri-vertices that were snapped or flushed are the mesh's own", "[measure]") {
  SECTION("snapped, some from outside the grid") {
    for (const double tolerance : {0.01, 0.05}) measured(shapes::noisySphere({1.5, 1.5, 1.5}, 1.7, 0.2, 2), unitGrid(3), tolerance);
    measured(shapes::cube(0.7, 3.4), unitGrid(3), 0.49);
  }
  SECTION("flushed") {
    Mesh mesh = shapes::cube(0, 1);
    for (double& x : mesh.positions) x = x == 0 ? -1e-70 : x;
    const Measured m = measured(mesh, Grid::box({-1, -1, -1}, {2, 2, 2}, {3, 3, 3}));
    CHECK(m.mesh.triangleCount == 12);
  }
}
