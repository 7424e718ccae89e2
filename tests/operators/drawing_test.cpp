// Buffers to draw cut-cells with: smooth normals with creases, closed cells, edges by kind.
#include "mandoline/drawing.h"

#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "refusal.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace vectors;
using shapes::Point;

namespace {

const Point origin = {0.125, -0.25, 0.375};
constexpr double kRing = 1, kTube = 0.4;

Mesh smoothTorus() { return shapes::torus({0, 0, 0}, kRing, kTube, 96, 48); }

/// The same triangles, each with vertices of its own.
Mesh unshared(const Mesh& mesh) {
  Mesh result;
  for (const uint32_t v : mesh.triangles) {
    result.triangles.push_back(uint32_t(result.triangles.size()));
    for (size_t d = 0; d < 3; ++d) result.positions.push_back(mesh.positions[3 * v + d]);
  }
  return result;
}

/// The same triangles, every other one turned over.
Mesh turned(Mesh mesh) {
  for (size_t t = 0; t < mesh.triangleCount(); t += 2) std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
  return mesh;
}

/// Of the torus of these radii about z, at a point of it.
Point torusNormal(const Point& p) {
  const double around = std::hypot(p[0], p[1]);
  const Point normal = {p[0] - kRing * p[0] / around, p[1] - kRing * p[1] / around, p[2]};
  return 1 / length(normal) * normal;
}

struct Drawn {
  Mesh mesh;
  CutMesh cutMesh;
  CellDrawing drawing;

  Drawn(const Mesh& mesh_, const Grid& grid, const Point& at = origin)
      : mesh(mesh_), cutMesh(checkedCut(mesh, grid).mesh), drawing(cellDrawing(mesh, cutMesh, at)) {}

  size_t vertices() const { return drawing.vertexCell.size(); }
  Point position(uint32_t vertex) const {
    return {drawing.positions[3 * size_t(vertex)], drawing.positions[3 * size_t(vertex) + 1], drawing.positions[3 * size_t(vertex) + 2]};
  }
  /// Less what was subtracted.
  Point place(uint32_t vertex) const { return position(vertex) + origin; }
  std::array<int, 4> normal(uint32_t vertex) const {
    const int8_t* n = &drawing.normals[4 * size_t(vertex)];
    return {n[0], n[1], n[2], n[3]};
  }
  Point direction(uint32_t vertex) const {
    const auto n = normal(vertex);
    return {double(n[0]), double(n[1]), double(n[2])};
  }
  Point facet(size_t triangle) const {
    const uint32_t* corners = &drawing.triangles[3 * triangle];
    const Point n = cross(position(corners[1]) - position(corners[0]), position(corners[2]) - position(corners[0]));
    return 1 / length(n) * n;
  }
  std::vector<bool> atSurface() const {
    std::vector<bool> at(vertices());
    for (size_t i = 0; i < 3 * size_t(drawing.surfaceTriangles); ++i) at[drawing.triangles[i]] = true;
    return at;
  }
};

}  // namespace

TEST_CASE("drawing: vertices at the surface have its normals, all others none", "[drawing]") {
  const bool isTurned = GENERATE(false, true);
  const Mesh mesh = isTurned ? turned(smoothTorus()) : GENERATE(smoothTorus(), unshared(smoothTorus()));
  const Drawn drawn(mesh, Grid::around(mesh, 10));
  const std::vector<bool> atSurface = drawn.atSurface();
  REQUIRE(drawn.drawing.surfaceTriangles > 1000);
  for (uint32_t v = 0; v < drawn.vertices(); ++v) {
    if (!atSurface[v]) {
      REQUIRE(drawn.normal(v) == std::array<int, 4>{});
      continue;
    }
    const Point n = drawn.direction(v);
    REQUIRE(length(n) == Approx(127).margin(1));
    REQUIRE(drawn.normal(v)[3] == 1);
    const double along = dot(n, torusNormal(drawn.place(v))) / length(n);
    REQUIRE((isTurned ? std::fabs(along) : along) > 0.995);
  }
}

TEST_CASE("drawing: each side of a crease has vertices of its own", "[drawing]") {
  const Drawn drawn(shapes::cube(0, 1), Grid::box({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, {2, 2, 2}));
  REQUIRE(drawn.drawing.surfaceTriangles > 0);
  for (size_t i = 0; i < 3 * size_t(drawn.drawing.surfaceTriangles); ++i) {
    REQUIRE(std::fabs(dot(drawn.facet(i / 3), drawn.direction(drawn.drawing.triangles[i]))) > 126.9);
  }
}

TEST_CASE("drawing: triangles are those of all cells, seen from outside of them", "[drawing]") {
  const Mesh mesh = shapes::merged({shapes::noisySphere({0, 0, 0}, 1, 0.2, 3), shapes::icosphere({0.3, 0.1, 0}, 0.3, 2)});
  const Drawn drawn(mesh, Grid::around(mesh, 9));
  const auto& [positions, normals, vertexCell, triangles, surfaceTriangles, edges, hybrid, grid, volume, centroid, madeFrom] =
      drawn.drawing;
  const Measures measures = measure(mesh, drawn.cutMesh);
  std::vector<double> sixfold(drawn.cutMesh.cellCount());
  for (size_t i = 0; i < triangles.size(); i += 3) {
    REQUIRE(vertexCell[triangles[i]] == vertexCell[triangles[i + 1]]);
    REQUIRE(vertexCell[triangles[i]] == vertexCell[triangles[i + 2]]);
    sixfold[vertexCell[triangles[i]]] +=
        dot(drawn.position(triangles[i]), cross(drawn.position(triangles[i + 1]), drawn.position(triangles[i + 2])));
  }
  for (size_t cell = 0; cell < sixfold.size(); ++cell) {
    REQUIRE(sixfold[cell] / 6 == Approx(measures.cellVolume[cell]).margin(1e-6));
    REQUIRE(volume[cell] == Approx(measures.cellVolume[cell]).margin(1e-14));
    for (size_t d = 0; d < 3; ++d) REQUIRE(centroid[3 * cell + d] == Approx(measures.cellCentroid[3 * cell + d] - origin[d]).margin(2e-6));
  }
  REQUIRE(madeFrom == drawn.cutMesh.fingerprint);
}

TEST_CASE("drawing: edges by kind, each once for each of its cells", "[drawing]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.2, 3);
  const Drawn drawn(mesh, Grid::around(mesh, 12));
  const CellDrawing& drawing = drawn.drawing;
  REQUIRE(drawing.hybridEdges > 0);
  REQUIRE(drawing.gridEdges > 0);
  REQUIRE(drawing.edges.size() / 2 > drawing.hybridEdges + drawing.gridEdges);
  const auto isOn = [&](double x, size_t d) {
    for (const double plane : drawn.cutMesh.grid.planes[d]) {
      if (double(float(plane - origin[d])) == x) return true;
    }
    return false;
  };
  for (size_t edge = 0; edge < drawing.edges.size() / 2; ++edge) {
    const uint32_t from = drawing.edges[2 * edge], to = drawing.edges[2 * edge + 1];
    REQUIRE(drawing.vertexCell[from] == drawing.vertexCell[to]);
    const Point p = drawn.position(from), q = drawn.position(to);
    int planes = 0;
    for (size_t d = 0; d < 3; ++d) planes += p[d] == q[d] && isOn(p[d], d);
    REQUIRE(planes == (edge < drawing.hybridEdges ? 1 : edge < drawing.hybridEdges + drawing.gridEdges ? 2 : 0));
  }
  size_t ends = 0;  // an edge has two, and is met by two half-faces of its cell
  for (const uint32_t h : drawn.cutMesh.cellHalfFaces) {
    for (const auto loop : drawn.cutMesh.loops(h / 2)) ends += loop.size();
  }
  REQUIRE(drawing.edges.size() == ends);
}

TEST_CASE("drawing: sheets are drawn from both sides", "[drawing]") {
  const Mesh sheet = shapes::quad({0.2, 0.3, 0.5}, {0.8, 0.3, 0.5}, {0.8, 0.7, 0.6}, {0.2, 0.7, 0.6});
  const Drawn drawn(sheet, unitGrid(1));
  REQUIRE(drawn.drawing.surfaceTriangles == 4);
  double along[2] = {};
  for (size_t t = 0; t < 4; ++t) {
    const double dotted = dot(drawn.facet(t), drawn.direction(drawn.drawing.triangles[3 * t]));
    along[dotted > 0] += dotted;
  }
  REQUIRE(along[1] == Approx(254).margin(1));
  REQUIRE(along[0] == Approx(-254).margin(1));
  REQUIRE(drawn.drawing.cellVolume[0] == Approx(1));
}

TEST_CASE("drawing: the thinnest cells have the mean of their corners for a centroid", "[drawing]") {
  const Mesh slab = shapes::box({-1, -1, -1}, {0.5, 2, 2}), thinner = shapes::box({0.5, -1, -1}, {0.5 + 0x1p-50, 2, 2});
  const Drawn drawn(shapes::merged({slab, thinner}), Grid::box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), {0, 0, 0});
  REQUIRE(drawn.cutMesh.cellCount() == 3);
  for (size_t cell = 0; cell < 3; ++cell) {
    REQUIRE(drawn.drawing.cellCentroid[3 * cell + 1] == 0.5f);
    REQUIRE(drawn.drawing.cellCentroid[3 * cell + 2] == 0.5f);
  }
}

TEST_CASE("drawing: scaling by a power of two changes no normal", "[drawing]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.2, 2);
  const double by = GENERATE(0x1p-900, 0x1p-60, 0x1p60, 0x1p900);
  const auto drawingOf = [](const Mesh& one) {
    const Grid grid = Grid::around(one, 6);
    const CutResult result = cut(one, grid);
    REQUIRE(result);
    return cellDrawing(one, result.mesh);
  };
  const CellDrawing usual = drawingOf(mesh), scaled = drawingOf(shapes::scaled(mesh, {by, by, by}));
  REQUIRE(scaled.normals == usual.normals);
  REQUIRE(scaled.triangles == usual.triangles);
  REQUIRE(scaled.edges == usual.edges);
}

TEST_CASE("drawing: a mesh that is not the input, and no cut-mesh", "[drawing]") {
  const Mesh mesh = shapes::cube(0.2, 0.8), other = shapes::cube(0.2, 0.7);
  const CutMesh cutMesh = checkedCut(mesh, unitGrid(1)).mesh;
  REQUIRE(refusal([&] { cellDrawing(other, cutMesh); }).first == Status::badArgument);
  REQUIRE(refusal([&] { cellDrawing(mesh, CutMesh{}); }).first == Status::badArgument);
}
