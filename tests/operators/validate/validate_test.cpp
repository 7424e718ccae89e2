// validate(): cut-meshes laid down by hand pass, and each single broken invariant is found by the check named for it, at the element.
#include "mandoline/validate.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <random>

#include "catch.h"
#include "mandoline/intersections.h"
#include "mandoline/mandoline.h"
#include "mandoline/measure.h"
#include "shapes.h"

using namespace mandoline;

namespace {

using Point = std::array<double, 3>;
using Loop = std::vector<Point>;

std::vector<uint32_t> joined(std::vector<uint32_t> a, const std::vector<uint32_t>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A cut-mesh on unit cells from (0, 0, 0), written down by coordinates. Vertices get their cells and masks from these.
class Sketch {
 public:
  Mesh mesh;
  CutMesh cut;

  Sketch(int64_t nx, int64_t ny, int64_t nz) {
    cut.grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {nx, ny, nz});
    cut.loopOffsets = cut.faceLoopOffsets = cut.faceParentOffsets = cut.cellHalfFaceOffsets = {0};
  }

  /// Adds an input triangle; corners become vertices.
  uint32_t triangle(const Point& a, const Point& b, const Point& c) {
    for (const Point& p : {a, b, c}) {
      const uint32_t v = vertex(p);
      if (cut.vertexTriVertex[v] < 0) {
        cut.vertexTriVertex[v] = cut.vertexParents[2 * v] = cut.vertexParents[2 * v + 1] = int32_t(mesh.vertexCount());
        mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
      }
      mesh.triangles.push_back(uint32_t(cut.vertexTriVertex[v]));
    }
    return cut.triangleCount++;
  }
  /// Declares the vertex a crossing of the tri-edge between two others.
  void onEdge(const Point& p, const Point& a, const Point& b) {
    const uint32_t v = vertex(p), va = vertex(a), vb = vertex(b);
    cut.vertexParents[2 * v] = cut.vertexTriVertex[va];
    cut.vertexParents[2 * v + 1] = cut.vertexTriVertex[vb];
  }
  uint32_t vertex(const Point& p) {
    for (uint32_t v = 0; v < cut.vertexCount(); ++v) {
      if (std::equal(p.begin(), p.end(), &cut.positions[3 * v])) return v;
    }
    uint8_t mask = 0;
    for (int d = 0; d < 3; ++d) {
      cut.positions.push_back(p[d]);
      cut.vertexCell.push_back(int32_t(std::floor(p[d])));
      if (p[d] == std::floor(p[d])) mask |= uint8_t(1 << d);
    }
    cut.vertexMask.push_back(mask);
    cut.vertexTriVertex.push_back(-1);
    cut.vertexParents.insert(cut.vertexParents.end(), {-1, -1});
    return uint32_t(cut.vertexCount() - 1);
  }
  uint32_t face(int32_t triangle, int axis, int plane, const std::vector<Loop>& loops) {
    for (const Loop& loop : loops) {
      for (const Point& p : loop) cut.loopVertices.push_back(vertex(p));
      cut.loopOffsets.push_back(uint32_t(cut.loopVertices.size()));
    }
    cut.faceLoopOffsets.push_back(uint32_t(cut.loopOffsets.size() - 1));
    cut.faceTriangle.push_back(triangle);
    cut.faceAxis.push_back(int8_t(axis));
    cut.facePlane.push_back(plane);
    cut.faceParentOffsets.push_back(uint32_t(cut.faceParents.size()));
    if (triangle >= 0) addParent(cut.faceCount() - 1, uint32_t(triangle), 1);
    return uint32_t(cut.faceCount() - 1);
  }
  /// Declares a face a part of one more triangle, of higher id than those before.
  void addParent(size_t face, uint32_t triangle, int8_t sign) {
    const uint32_t place = cut.faceParentOffsets[face + 1];
    cut.faceParents.insert(cut.faceParents.begin() + place, triangle);
    cut.faceParentSigns.insert(cut.faceParentSigns.begin() + place, sign);
    for (size_t f = face + 1; f < cut.faceParentOffsets.size(); ++f) ++cut.faceParentOffsets[f];
  }
  /// A piece of a grid-face: ccw seen against its axis.
  uint32_t piece(int axis, int plane, const Loop& loop) { return face(-1, axis, plane, {loop}); }
  uint32_t wholeTriangle(uint32_t t) {
    Loop loop;
    for (int i = 0; i < 3; ++i) {
      const double* p = &mesh.positions[3 * mesh.triangles[3 * t + i]];
      loop.push_back({p[0], p[1], p[2]});
    }
    return face(int32_t(t), -1, 0, {loop});
  }
  /// The six sides of the grid cell (i, 0, 0), as half-faces of it: whole grid-faces, but for the lowest along x where one is given.
  std::vector<uint32_t> box(double i, int64_t lowest = -1) {
    const double j = i + 1;
    if (lowest < 0) lowest = piece(0, int(i), {{i, 0, 0}, {i, 1, 0}, {i, 1, 1}, {i, 0, 1}});
    const uint32_t highest = piece(0, int(j), {{j, 0, 0}, {j, 1, 0}, {j, 1, 1}, {j, 0, 1}});
    const uint32_t front = piece(1, 0, {{i, 0, 0}, {i, 0, 1}, {j, 0, 1}, {j, 0, 0}}),
                   back = piece(1, 1, {{i, 1, 0}, {i, 1, 1}, {j, 1, 1}, {j, 1, 0}});
    const uint32_t bottom = piece(2, 0, {{i, 0, 0}, {j, 0, 0}, {j, 1, 0}, {i, 1, 0}}),
                   top = piece(2, 1, {{i, 0, 1}, {j, 0, 1}, {j, 1, 1}, {i, 1, 1}});
    return {2 * uint32_t(lowest) + 1, 2 * highest, 2 * front + 1, 2 * back, 2 * bottom + 1, 2 * top};
  }
  uint32_t cell(const std::array<int32_t, 3>& gridCell, uint32_t region, const std::vector<uint32_t>& halfFaces) {
    cut.cellHalfFaces.insert(cut.cellHalfFaces.end(), halfFaces.begin(), halfFaces.end());
    cut.cellHalfFaceOffsets.push_back(uint32_t(cut.cellHalfFaces.size()));
    cut.cellGridCell.insert(cut.cellGridCell.end(), gridCell.begin(), gridCell.end());
    cut.cellRegion.push_back(region);
    cut.regionCount = std::max(cut.regionCount, region + 1);
    return uint32_t(cut.cellCount() - 1);
  }
  /// Untouched grid cells of the only row.
  void run(int32_t begin, int32_t end, uint32_t region) {
    cut.runBegin.push_back(begin);
    cut.runEnd.push_back(end);
    cut.runRegion.push_back(region);
  }
  void finishRow() { cut.rowRunOffsets = {0, uint32_t(cut.runBegin.size())}; }

  Validation validated() const { return validate(mesh, cut); }
};

/// A rectangle at z = 1/2 cuts two grid cells into four cut-cells; its diagonal runs from grid cell to grid cell.
struct Halves : Sketch {
  uint32_t triFaces[4], below[2], above[2], middleBelow,
      middleAbove;  // triFaces: of triangle 0 and 1 in the left grid cell, then in the right one

  Halves() : Sketch(2, 1, 1) {
    const double h = 0.5;
    const uint32_t s = triangle({0, 0, h}, {2, 0, h}, {2, 1, h}), t = triangle({0, 0, h}, {2, 1, h}, {0, 1, h});
    triFaces[0] = face(int32_t(s), -1, 0, {{{0, 0, h}, {1, 0, h}, {1, h, h}}});
    triFaces[1] = face(int32_t(t), -1, 0, {{{0, 0, h}, {1, h, h}, {1, 1, h}, {0, 1, h}}});
    triFaces[2] = face(int32_t(s), -1, 0, {{{1, 0, h}, {2, 0, h}, {2, 1, h}, {1, h, h}}});
    triFaces[3] = face(int32_t(t), -1, 0, {{{1, h, h}, {2, 1, h}, {1, 1, h}}});
    onEdge({1, 0, h}, {0, 0, h}, {2, 0, h});
    onEdge({1, h, h}, {0, 0, h}, {2, 1, h});
    onEdge({1, 1, h}, {2, 1, h}, {0, 1, h});
    middleBelow = piece(0, 1, {{1, 0, 0}, {1, 1, 0}, {1, 1, h}, {1, h, h}, {1, 0, h}});
    middleAbove = piece(0, 1, {{1, 0, h}, {1, h, h}, {1, 1, h}, {1, 1, 1}, {1, 0, 1}});
    for (int32_t i = 0; i < 2; ++i) {
      const double x = i, x1 = i + 1, end = 2 * i;  // the far end of the grid in this grid cell
      const uint32_t endBelow = piece(0, 2 * i, {{end, 0, 0}, {end, 1, 0}, {end, 1, h}, {end, 0, h}});
      const uint32_t endAbove = piece(0, 2 * i, {{end, 0, h}, {end, 1, h}, {end, 1, 1}, {end, 0, 1}});
      const uint32_t side = i == 0 ? 1 : 0;  // of the end; the middle has the other
      const auto halfFaces = [&](double low, double high, uint32_t endFace, uint32_t middle, uint32_t capSide) {
        const double z = capSide == 0 ? low : high;  // the whole grid-face at the bottom or top
        const uint32_t front = piece(1, 0, {{x, 0, low}, {x, 0, high}, {x1, 0, high}, {x1, 0, low}});
        const uint32_t back = piece(1, 1, {{x, 1, low}, {x, 1, high}, {x1, 1, high}, {x1, 1, low}});
        const uint32_t whole = piece(2, int(z), {{x, 0, z}, {x1, 0, z}, {x1, 1, z}, {x, 1, z}});
        return std::vector<uint32_t>{2 * triFaces[2 * i] + capSide,
                                     2 * triFaces[2 * i + 1] + capSide,
                                     2 * endFace + side,
                                     2 * middle + 1 - side,
                                     2 * front + 1,
                                     2 * back,
                                     2 * whole + 1 - capSide};
      };
      below[i] = cell({i, 0, 0}, 0, halfFaces(0, h, endBelow, middleBelow, 0));
      above[i] = cell({i, 0, 0}, 1, halfFaces(h, 1, endAbove, middleAbove, 1));
    }
    finishRow();
  }
};

/// Tetrahedra, oriented outward, in the first of two grid cells; the other one is untouched.
struct Bubbles : Sketch {
  std::vector<uint32_t> boxSides, inward, outward;  // half-faces; of the tetrahedra seen from outside and from inside

  Bubbles() : Sketch(2, 1, 1), boxSides(box(0)) {
    run(1, 2, 0);
    finishRow();
  }
  void tetrahedron(double x, double y, double z, double size) {
    const Point o{x, y, z}, a{x + size, y, z}, b{x, y + size, z}, c{x, y, z + size};
    const uint32_t first = triangle(o, b, a);
    triangle(o, a, c), triangle(o, c, b), triangle(a, b, c);
    for (uint32_t t = first; t < first + 4; ++t) {
      outward.push_back(2 * wholeTriangle(t));
      inward.push_back(outward.back() + 1);
    }
  }
  void setWinding(const std::vector<int32_t>& winding) {
    cut.hasWinding = true;
    cut.regionWinding = winding;
  }
};

Bubbles bubble() {
  Bubbles b;
  b.tetrahedron(0.25, 0.25, 0.25, 0.5);
  b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
  b.cell({0, 0, 0}, 1, b.outward);
  b.setWinding({0, 1});
  return b;
}

/// A rectangle that hangs from the side x = 0 into a grid cell; the slit that it makes there is left out, or run through forth and back.
struct Shelf : Sketch {
  explicit Shelf(bool slit) : Sketch(1, 1, 1) {
    const double l = 0.25, m = 0.5, r = 0.75;
    const uint32_t s = triangle({0, l, m}, {m, l, m}, {m, r, m}), t = triangle({0, l, m}, {m, r, m}, {0, r, m});
    std::vector<Loop> wall{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
    if (slit) wall.push_back({{0, l, m}, {0, r, m}});
    const uint32_t lowest = face(-1, 0, 0, wall), a = wholeTriangle(s), b = wholeTriangle(t);
    cell({0, 0, 0}, 0, joined(box(0, lowest), {2 * a, 2 * a + 1, 2 * b, 2 * b + 1}));
    finishRow();
  }
};

void requirePass(const Validation& validation) {
  for (const Check& check : validation.checks) {
    INFO(check.name << ": " << check.message);
    CHECK(check.pass);
    CHECK_FALSE(std::isnan(check.worst));
  }
  CHECK(validation.pass);
}

Check checkNamed(const Validation& validation, const std::string& name) {
  const auto found = std::find_if(validation.checks.begin(), validation.checks.end(), [&](const Check& c) { return c.name == name; });
  REQUIRE(found != validation.checks.end());
  return *found;
}

/// The named check fails and points at the element.
void requireFailure(const Validation& validation, const std::string& name, const std::string& kind, int64_t element) {
  INFO(name);
  CHECK_FALSE(validation.pass);
  const Check check = checkNamed(validation, name);
  INFO(check.message);
  CHECK_FALSE(check.pass);
  CHECK(check.elementKind == kind);
  CHECK(check.element == element);
  CHECK_FALSE(check.message.empty());
}

/// Exactly these checks fail.
void requireOnly(const Validation& validation, const std::vector<std::string>& expected) {
  std::vector<std::string> names;
  for (const Check& check : validation.checks) {
    if (!check.pass) names.push_back(check.name);
  }
  CHECK(names == expected);
}

}  // namespace

TEST_CASE("validate: right cut-meshes pass", "[validate]") {
  requirePass(Halves().validated());
  requirePass(bubble().validated());
  requirePass(Shelf(false).validated());
  requirePass(Shelf(true).validated());
}

TEST_CASE("validate: checks that do not apply say why", "[validate]") {
  const Validation open = Halves().validated();
  for (const char* name : {"windingNumber", "inputVolume"}) {
    CHECK(checkNamed(open, name).skipped);
    CHECK_FALSE(checkNamed(open, name).message.empty());
  }
  const Validation closed = bubble().validated();
  for (const char* name : {"windingNumber", "inputVolume"}) CHECK_FALSE(checkNamed(closed, name).skipped);
}

void makeVertex(CutMesh& cut, uint32_t v, MadeVertex kind, const std::array<int32_t, 4>& parents) {
  cut.madeVertices.push_back(v);
  cut.madeVertexKinds.push_back(uint8_t(kind));
  cut.madeVertexParents.insert(cut.madeVertexParents.end(), parents.begin(), parents.end());
}

TEST_CASE("validate: garbage arrays are named, not followed", "[validate]") {
  using Break = std::function<void(CutMesh&)>;
  const std::vector<Break> breaks{
      [](CutMesh& c) { c.positions.pop_back(); },
      [](CutMesh& c) { c.positions[4] = std::numeric_limits<double>::quiet_NaN(); },
      [](CutMesh& c) { c.vertexCell[0] = 7; },
      [](CutMesh& c) { c.vertexMask[0] = 9; },
      [](CutMesh& c) { c.vertexTriVertex[0] = 99; },
      [](CutMesh& c) { c.vertexParents[0] = 99; },
      [](CutMesh& c) { c.loopOffsets[1] = 1000; },
      [](CutMesh& c) { c.loopOffsets.clear(); },
      [](CutMesh& c) { c.loopVertices[3] = 1000; },
      [](CutMesh& c) { c.loopVertices[1] = c.loopVertices[0]; },
      [](CutMesh& c) { std::swap(c.faceLoopOffsets[1], c.faceLoopOffsets[2]); },
      [](CutMesh& c) { c.faceTriangle[0] = 1000; },
      [](CutMesh& c) { c.faceTriangle[6] = 1; },
      [](CutMesh& c) { c.faceTriangle[6] = -1; },
      [](CutMesh& c) { c.faceParentOffsets.pop_back(); },
      [](CutMesh& c) { c.faceParentOffsets[7] = 1000; },
      [](CutMesh& c) { c.faceParents[0] = 1000; },
      [](CutMesh& c) { c.faceParents.push_back(0); },
      [](CutMesh& c) { c.faceParentSigns[0] = -1; },
      [](CutMesh& c) { c.faceParentSigns[0] = 2; },
      [](CutMesh& c) { c.faceParentSigns.pop_back(); },
      [](CutMesh& c) {  // twice the same
        std::fill(c.faceParentOffsets.begin() + 7, c.faceParentOffsets.end(), 4u);
        c.faceParents = {0, 0, 1, 2};
      },
      [](CutMesh& c) { c.madeVertices = {0}; },
      [](CutMesh& c) {
        makeVertex(c, 1000, MadeVertex::triangles, {0, 1, 2, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 8, MadeVertex::triangles, {0, 1, 2, -1});
      },  // a tri-vertex
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex(4), {0, 1, 2, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::triangles, {0, 1, 4, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::triangles, {0, 1, 2, 3});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::trianglesPlane, {0, -1, -1, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::edgeTriangle, {0, 4, 0, -1});
      },
      [](CutMesh& c) {
        makeVertex(c, 0, MadeVertex::edgeEdge, {0, 1, 2, 4});
      },
      [](CutMesh& c) { c.faceAxis[0] = 3; },
      [](CutMesh& c) { c.facePlane[0] = 1000; },
      [](CutMesh& c) { c.cellHalfFaces[0] = 1000; },
      [](CutMesh& c) { c.cellHalfFaceOffsets.back()--; },
      [](CutMesh& c) { c.cellGridCell[0] = -1; },
      [](CutMesh& c) { c.cellRegion[0] = 9; },
      [](CutMesh& c) { c.rowRunOffsets.pop_back(); },
      [](CutMesh& c) { c.runEnd[0] = 3; },
      [](CutMesh& c) { c.runRegion[0] = 9; },
      [](CutMesh& c) { c.regionWinding.pop_back(); },
      [](CutMesh& c) { c.triangleCount = 3; },
      [](CutMesh& c) { c.droppedTriangles = {77}; },
      [](CutMesh& c) {
        c.grid.planes[0] = {0, 2, 1};
      },
      [](CutMesh& c) { c.grid.planes[1].clear(); },
      [](CutMesh& c) {
        c.grid.planes[2] = {0, 1e-320, 1};
      },
      [](CutMesh& c) { c = CutMesh(); },
  };
  for (size_t i = 0; i < breaks.size(); ++i) {
    INFO("break " << i);
    Bubbles b = bubble();
    breaks[i](b.cut);
    const Validation validation = b.validated();
    CHECK_FALSE(validation.pass);
    REQUIRE(validation.checks.size() == 1);
    CHECK(validation.checks[0].name == "arrays");
    CHECK_FALSE(validation.checks[0].message.empty());
  }
}

TEST_CASE("validate: vertices", "[validate]") {
  SECTION("a mask without one of its planes") {
    Halves h;
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexMask[v] &= ~1;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("not the lowest of a welded group") {
    Halves h;
    h.mesh.positions.insert(h.mesh.positions.end(), {0, 0, 0.5});  // tri-vertex 0 once more
    h.mesh.triangles[3] = 4;
    requirePass(h.validated());
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexTriVertex[v] = h.cut.vertexParents[2 * v] = h.cut.vertexParents[2 * v + 1] = 4;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("a tri-vertex that no triangle has") {
    Halves h;
    h.mesh.positions.insert(h.mesh.positions.end(), {0, 0, 0.5});  // tri-vertex 0 once more
    const uint32_t v = h.vertex({0, 0, 0.5});
    h.cut.vertexTriVertex[v] = h.cut.vertexParents[2 * v] = h.cut.vertexParents[2 * v + 1] = 4;
    requireFailure(h.validated(), "vertices", "vertex", v);
  }
  SECTION("an input vertex that is missing") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {0.5, 0.5, 0.75});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {0, 1, 4});
    b.cut.triangleCount++;
    requireFailure(b.validated(), "vertices", "tri-vertex", 4);
  }
  SECTION("a tri-vertex moved") {
    Bubbles b = bubble();
    const uint32_t v = b.vertex({0.75, 0.25, 0.25});
    b.cut.positions[3 * v] = std::nextafter(0.75, 1);
    requireFailure(b.validated(), "vertices", "vertex", v);
  }
  SECTION("a made vertex off its plane") {
    Halves h;
    const uint32_t v = h.vertex({1, 0.5, 0.5});
    h.cut.positions[3 * v] += 1e-12;
    requireFailure(h.validated(), "positions", "vertex", v);
  }
  SECTION("a made vertex off its tri-edge") {
    Halves h;
    const uint32_t v = h.vertex({1, 0.5, 0.5});
    h.cut.positions[3 * v + 1] += 1e-12;
    requireFailure(h.validated(), "positions", "vertex", v);
    h.cut.positions[3 * v + 1] = std::nextafter(0.5, 1);  // one rounding is fine
    requirePass(h.validated());
  }
}

TEST_CASE("validate: faces", "[validate]") {
  SECTION("in another plane than it names") {
    Halves h;
    h.cut.facePlane[h.middleBelow] = 2;
    requireFailure(h.validated(), "faces", "face", h.middleBelow);
  }
  SECTION("of a dropped triangle") {
    Bubbles b = bubble();
    b.cut.droppedTriangles = {0};
    requireFailure(b.validated(), "faces", "face", b.outward[0] / 2);
  }
  SECTION("off its triangle's plane") {
    Halves h;
    const uint32_t v = h.vertex({1, 0, 0.5});
    h.cut.positions[3 * v + 2] += 1e-12;
    requireFailure(h.validated(), "planarity", "face", h.triFaces[0]);
  }
  SECTION("outer loop the wrong way round") {
    Bubbles b = bubble();
    std::swap(b.cut.loopVertices[b.cut.loopOffsets[6]], b.cut.loopVertices[b.cut.loopOffsets[6] + 1]);
    requireFailure(b.validated(), "orientation", "face", 6);
  }
  SECTION("in two grid cells") {
    Halves h;
    std::swap(h.cut.loopVertices[0], h.cut.loopVertices[h.cut.loopOffsets[2] + 1]);  // (0, 0) of the left, (2, 0) of the right
    requireFailure(h.validated(), "gridCellIsolation", "face", h.triFaces[2]);
  }
}

TEST_CASE("validate: half-faces", "[validate]") {
  SECTION("cut-cell in another grid cell than its faces") {
    Halves h;
    h.cut.cellGridCell[3 * h.below[0]] = 1;
    requireFailure(h.validated(), "gridCellIsolation", "cell", h.below[0]);
  }
  SECTION("tri-face with one side only") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, std::vector<uint32_t>(b.inward.begin() + 1, b.inward.end())));
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", b.inward[0] / 2);
    requireFailure(b.validated(), "closedCells", "cell", 0);
  }
  SECTION("listed twice") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
    b.cell({0, 0, 0}, 1, joined(b.outward, {b.outward[2]}));
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", b.outward[2] / 2);
  }
  SECTION("owner on the other side of the plane") {
    Halves h;
    uint32_t& inMiddle = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.below[0]] + 3];
    REQUIRE(inMiddle == 2 * h.middleBelow);
    ++inMiddle;
    requireFailure(h.validated(), "halfFaces", "face", h.middleBelow);
  }
  SECTION("part of a grid-face towards an untouched grid cell") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    std::vector<uint32_t> sides = b.boxSides;
    const uint32_t whole = sides[1] / 2, l = b.cut.faceLoopOffsets[whole];
    const uint32_t rest = b.piece(0, 1, {{1, 0, 0}, {1, 1, 1}, {1, 0, 1}});
    b.cut.loopVertices[b.cut.loopOffsets[l] + 3] = b.vertex({1, 1, 1});
    // The loop of the first piece becomes a triangle: its last vertex goes.
    b.cut.loopVertices.erase(b.cut.loopVertices.begin() + b.cut.loopOffsets[l] + 3);
    for (size_t i = l + 1; i < b.cut.loopOffsets.size(); ++i) --b.cut.loopOffsets[i];
    b.cell({0, 0, 0}, 0, joined(joined(sides, {2 * rest}), b.inward));
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "halfFaces", "face", whole);
    requireOnly(b.validated(), {"halfFaces"});
  }
  SECTION("slit towards an untouched grid cell") {
    Bubbles b = bubble();
    const uint32_t whole = b.boxSides[1] / 2, l = b.cut.faceLoopOffsets[whole];
    const uint32_t corner = b.cut.loopVertices[b.cut.loopOffsets[l]], tip = b.vertex({1, 0.5, 0});
    b.cut.loopVertices.insert(b.cut.loopVertices.begin() + b.cut.loopOffsets[l] + 1, {tip, corner});
    for (size_t i = l + 1; i < b.cut.loopOffsets.size(); ++i) b.cut.loopOffsets[i] += 2;
    requireFailure(b.validated(), "halfFaces", "face", whole);
  }
}

TEST_CASE("validate: cells that do not fit around an edge", "[validate]") {
  Halves h;
  // The two lower cut-cells trade their pieces of the plane between them for the upper ones' tri-faces.
  uint32_t& lower = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.below[0]]];
  uint32_t& upper = h.cut.cellHalfFaces[h.cut.cellHalfFaceOffsets[h.above[0]]];
  REQUIRE((lower ^ upper) == 1);
  std::swap(lower, upper);
  const Validation validation = h.validated();
  CHECK_FALSE(checkNamed(validation, "facingFaces").pass);
  CHECK(checkNamed(validation, "facingFaces").elementKind == "face");
  CHECK_FALSE(checkNamed(validation, "closedCells").pass);
}

TEST_CASE("validate: a vertex inside of an edge", "[validate]") {
  Halves h;
  // The upper piece of the plane between the grid cells goes straight past the middle vertex, whose position is exact.
  const uint32_t l = h.cut.faceLoopOffsets[h.middleAbove], v = h.vertex({1, 0.5, 0.5});
  const auto begin = h.cut.loopVertices.begin();
  h.cut.loopVertices.erase(std::find(begin + h.cut.loopOffsets[l], begin + h.cut.loopOffsets[l + 1], v));
  for (size_t i = l + 1; i < h.cut.loopOffsets.size(); ++i) --h.cut.loopOffsets[i];
  requireFailure(h.validated(), "conforming", "vertex", v);
  requireFailure(h.validated(), "closedCells", "cell", h.above[0]);
}

TEST_CASE("validate: shells", "[validate]") {
  SECTION("two cells in one") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, joined(joined(b.boxSides, b.inward), b.outward));
    b.cut.hasWinding = true;
    b.cut.regionWinding = {0};
    requireFailure(b.validated(), "connected", "cell", 0);
  }
  SECTION("the bubble twice, and the rest of the grid cell lost (paper, section 6)") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cell({0, 0, 0}, 0, b.inward);
    b.cell({0, 0, 0}, 1, b.outward);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "distinctCells", "cell", 1);
    requireFailure(b.validated(), "connected", "cell", 0);
    requireFailure(b.validated(), "cellVolume", "cell", 0);
    requireFailure(b.validated(), "gridCellVolume", "cell", 0);
    requireFailure(b.validated(), "gridFaceArea", "cell", 0);
    requireFailure(b.validated(), "partition", "cell", 0);
  }
  SECTION("a piece of a grid-face that covers too much") {
    Halves h;
    const uint32_t v = h.vertex({1, 0, 0.5});
    h.cut.positions[3 * v + 2] = 0.5 + 1e-9;
    const Check check = checkNamed(h.validated(), "gridFaceArea");
    CHECK(check.pass);  // both pieces moved alike
    Shelf s(false);
    s.cut.positions[3 * s.vertex({0, 1, 0}) + 1] = 1 - 1e-9;
    requireFailure(s.validated(), "gridFaceArea", "face", 0);
  }
}

TEST_CASE("validate: bubbles that intersect inside of a grid cell", "[validate]") {
  Bubbles b;
  b.tetrahedron(0.125, 0.125, 0.125, 0.5);
  const std::vector<uint32_t> first = b.outward;
  b.tetrahedron(0.15625, 0.15625, 0.15625, 0.5);
  b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
  b.cell({0, 0, 0}, 1, first);
  b.cell({0, 0, 0}, 2, std::vector<uint32_t>(b.outward.begin() + 4, b.outward.end()));
  b.setWinding({0, 1, 1});
  const Validation validation = b.validated();
  CHECK_FALSE(checkNamed(validation, "crossings").pass);
  CHECK_FALSE(checkNamed(validation, "partition").pass);
  CHECK(checkNamed(validation, "closedCells").pass);
  CHECK(checkNamed(validation, "gridCellVolume").pass);
  CHECK(checkNamed(validation, "inputVolume").pass);
}

/// Sheets, each a square of two triangles.
Mesh squares(const std::vector<std::array<Point, 4>>& corners) {
  Mesh mesh;
  for (const std::array<Point, 4>& c : corners) {
    const uint32_t v = uint32_t(mesh.vertexCount());
    for (const Point& p : c) mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 2, v, v + 2, v + 3});
  }
  return mesh;
}

Validation validatedCut(const Mesh& mesh, const Grid& grid, Intersections intersections, size_t cells) {
  CutOptions options;
  options.intersections = intersections;
  const CutResult result = cut(mesh, grid, options);
  INFO(result.error.message);
  REQUIRE(result);
  CHECK(result.mesh.cellCount() == cells);
  return validate(mesh, result.mesh);
}

TEST_CASE("validate: sheets that meet inside a grid cell, unresolved and resolved", "[validate]") {
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const auto requireFound = [&](const Mesh& mesh, size_t cells, size_t resolvedCells) {
    for (int axis = 0; axis < 3; ++axis) {
      Mesh turned = mesh;
      for (size_t i = 0; i < mesh.positions.size(); ++i) turned.positions[i] = mesh.positions[i / 3 * 3 + (i + size_t(axis)) % 3];
      INFO("axis " << axis);
      CHECK_FALSE(checkNamed(validatedCut(turned, grid, Intersections::assumeNone, cells), "crossings").pass);
      requirePass(validatedCut(turned, grid, Intersections::resolve, resolvedCells));
    }
  };
  const double l = -0.5, m = 0.5, h = 1.5;
  SECTION("three squares through its middle, reaching beyond it") {
    requireFound(squares({{{{m, l, l}, {m, h, l}, {m, h, h}, {m, l, h}}},
                          {{{l, m, l}, {l, m, h}, {h, m, h}, {h, m, l}}},
                          {{{l, l, m}, {h, l, m}, {h, h, m}, {l, h, m}}}}),
                 1, 8);
  }
  SECTION("two squares in one plane that overlap by a quarter") {
    requireFound(squares({{{{0.25, 0.25, m}, {0.5, 0.25, m}, {0.5, 0.5, m}, {0.25, 0.5, m}}},
                          {{{0.375, 0.375, m}, {0.625, 0.375, m}, {0.625, 0.625, m}, {0.375, 0.625, m}}}}),
                 1, 1);
  }
  SECTION("the edge of a sheet on another one") {
    requireFound(squares({{{{0.25, 0.25, m}, {0.75, 0.25, m}, {0.75, 0.75, m}, {0.25, 0.75, m}}},
                          {{{0.4375, 0.375, m}, {0.4375, 0.625, m}, {0.4375, 0.625, 0.75}, {0.4375, 0.375, 0.75}}}}),
                 1, 1);
  }
}

TEST_CASE("validate: sheets that meet in a grid plane, each from its own side", "[validate]") {
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const Mesh mesh{{0, 0, 2, 0, 1, 1, 1, 1, 2, 2, 1, 1, 1, 2, 1, 0, 1, 2}, {0, 1, 2, 3, 4, 5}};  // whose edges cross at y = 1
  const Validation unresolved = validatedCut(mesh, grid, Intersections::assumeNone, 6);
  CHECK_FALSE(checkNamed(unresolved, "crossings").pass);
  CHECK_FALSE(checkNamed(unresolved, "gridFaces").pass);
  requirePass(validatedCut(mesh, grid, Intersections::resolve, 7));
}

TEST_CASE("validate: sheets a rounding apart, or crossing by as little", "[validate]") {
  std::mt19937 random(11);
  const Grid grid = Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  size_t apart = 0, crossing = 0;
  for (int pair = 0; pair < 300; ++pair) {
    Mesh mesh;
    for (uint32_t i = 0; i < 6; ++i) {
      const double x = double(random() % 5 + 1) / 8, y = 0.5 + double(random() % 4) * 0x1p-53, z = double(random() % 5 + 1) / 8;
      mesh.positions.insert(mesh.positions.end(), {x, y, z});
      mesh.triangles.push_back(i);
    }
    const PairCounts pairs = findIntersections(mesh).counts;
    CutOptions options;
    options.intersections = Intersections::assumeNone;
    const CutResult result = cut(mesh, grid, options);
    if (!result || pairs.touching > 0) continue;
    INFO("pair " << pair);
    const Validation validation = validate(mesh, result.mesh);
    if (pairs.total() == 0) {
      ++apart;
      requirePass(validation);
    } else {
      ++crossing;
      CHECK_FALSE(checkNamed(validation, "crossings").pass);
    }
  }
  CHECK(apart > 30);
  CHECK(crossing > 30);
}

TEST_CASE("validate: grid-faces that a sheet divides, but that are left whole", "[validate]") {
  Sketch s(1, 1, 1);
  const std::vector<uint32_t> sides = s.box(0);
  const double m = 0.5;
  const uint32_t f = s.wholeTriangle(s.triangle({0, 0, m}, {1, 0, m}, {1, 1, m}));
  const uint32_t g = s.wholeTriangle(s.triangle({0, 0, m}, {1, 1, m}, {0, 1, m}));
  for (size_t i = 0; i < 6; ++i) {  // the corners of the sheet lie on upright edges of the cell
    if (i / 2 == 2) continue;
    const uint32_t side = sides[i] / 2, loop = s.cut.faceLoopOffsets[side];
    std::vector<uint32_t> corners(s.cut.loop(loop).begin(), s.cut.loop(loop).end());
    for (size_t k = 0; k < corners.size(); ++k) {
      const double* p = &s.cut.positions[3 * corners[k]];
      const double* q = &s.cut.positions[3 * corners[(k + 1) % corners.size()]];
      if (p[2] != q[2]) corners.insert(corners.begin() + std::ptrdiff_t(k++) + 1, s.vertex({p[0], p[1], m}));
    }
    const auto first = s.cut.loopVertices.begin() + s.cut.loopOffsets[loop];
    s.cut.loopVertices.erase(first, first + 4);
    s.cut.loopVertices.insert(s.cut.loopVertices.begin() + s.cut.loopOffsets[loop], corners.begin(), corners.end());
    for (size_t l = loop + 1; l < s.cut.loopOffsets.size(); ++l) s.cut.loopOffsets[l] += 2;
  }
  s.cell({0, 0, 0}, 0, joined(sides, {2 * f, 2 * f + 1, 2 * g, 2 * g + 1}));
  s.finishRow();
  requireOnly(s.validated(), {"gridFaces"});
}

/// Cut-cells by grid cell and volume.
std::vector<std::array<double, 4>> cellsOf(const Mesh& mesh, const CutMesh& cutMesh) {
  const Measures measures = measure(mesh, cutMesh);
  std::vector<std::array<double, 4>> cells;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const int32_t* g = &cutMesh.cellGridCell[3 * c];
    cells.push_back({double(g[0]), double(g[1]), double(g[2]), std::round(measures.cellVolume[c] * 1e9)});
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST_CASE("validate: cuts that assume no intersections pass only if they have the cells of the resolved ones", "[validate]") {
  std::mt19937 random(3);
  size_t passed = 0, failed = 0;
  for (int soup = 0; soup < 600; ++soup) {
    Mesh mesh;
    for (uint32_t i = 0; i < 6; ++i) {
      for (int d = 0; d < 3; ++d) mesh.positions.push_back(double(random() % 3));
      mesh.triangles.push_back(i);
    }
    const int64_t n = soup % 2 + 2;
    const Grid grid = Grid::box({0, 0, 0}, {2, 2, 2}, {n, n, n});
    CutOptions options;
    options.intersections = Intersections::assumeNone;
    const CutResult unresolved = cut(mesh, grid, options), resolved = cut(mesh, grid);
    if (!unresolved) continue;
    REQUIRE(resolved);
    INFO("soup " << soup);
    const bool pass = validate(mesh, unresolved.mesh).pass;
    if (pass) CHECK(cellsOf(mesh, unresolved.mesh) == cellsOf(mesh, resolved.mesh));
    ++(pass ? passed : failed);
  }
  CHECK(passed > 200);
  CHECK(failed > 50);
}

TEST_CASE("validate: faces of floating triangles that cross or lie on each other where no edge shows it", "[validate]") {
  Sketch s(1, 1, 1);
  const std::vector<uint32_t> sides = s.box(0);
  uint32_t f = 0, g = 0;
  SECTION("each has a corner inside the other") {
    f = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
    g = s.wholeTriangle(s.triangle({0.25, 0.5, 0.5}, {0.875, 0.25, 0.5}, {0.875, 0.75, 0.5}));
  }
  SECTION("one triangle twice") {
    f = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
    g = s.wholeTriangle(s.triangle({0.625, 0.5, 0.5}, {0.125, 0.5, 0.25}, {0.125, 0.5, 0.75}));
  }
  s.cell({0, 0, 0}, 0, joined(sides, {2 * f, 2 * f + 1, 2 * g, 2 * g + 1}));
  s.finishRow();
  requireFailure(s.validated(), "crossings", "face", g);
}

TEST_CASE("validate: soups of triangles with corners on a coarse lattice pass once resolved", "[validate]") {
  std::mt19937 random(7);
  for (int soup = 0; soup < 10; ++soup) {
    Mesh mesh;
    for (uint32_t i = 0; i < 30; ++i) {
      for (int d = 0; d < 3; ++d) mesh.positions.push_back(double(random() % 3) / 2);
      mesh.triangles.push_back(i);
    }
    for (const int64_t n : {1, 2, 3}) {
      const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1.0 / double(n), 1.0 / double(n), 1.0 / double(n)}, {n, n, n}));
      INFO("soup " << soup << ", n = " << n << " " << result.error.message);
      REQUIRE(result);
      requirePass(validate(mesh, result.mesh));
    }
  }
}

TEST_CASE("validate: made vertices", "[validate]") {
  const Mesh mesh = squares({{{{0.25, 0.25, 0.25}, {0.875, 0.25, 0.75}, {0.875, 0.875, 0.75}, {0.25, 0.875, 0.375}}},
                             {{{0.125, 0.5, 0.125}, {0.75, 0.5, 0.125}, {0.75, 0.625, 0.875}, {0.125, 0.625, 0.875}}}});
  const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  REQUIRE(result);
  REQUIRE(result.mesh.madeVertices.size() >= 2);
  requirePass(validate(mesh, result.mesh));
  CutMesh damaged = result.mesh;
  const uint32_t first = damaged.madeVertices[0];
  SECTION("of other parents") {
    REQUIRE(damaged.madeVertexKinds[0] == damaged.madeVertexKinds[1]);
    std::copy_n(damaged.madeVertexParents.begin() + 4, 4, damaged.madeVertexParents.begin());
    requireFailure(validate(mesh, damaged), "vertices", "vertex", damaged.madeVertices[1]);
    requireFailure(validate(mesh, damaged), "positions", "vertex", first);
  }
  SECTION("somewhere else on its triangle") {
    damaged.positions[3 * first] += 1e-9;
    CHECK_FALSE(checkNamed(validate(mesh, damaged), "positions").pass);
  }
  SECTION("not listed as made") {
    damaged.madeVertices.erase(damaged.madeVertices.begin());
    damaged.madeVertexKinds.erase(damaged.madeVertexKinds.begin());
    damaged.madeVertexParents.erase(damaged.madeVertexParents.begin(), damaged.madeVertexParents.begin() + 4);
    requireFailure(validate(mesh, damaged), "vertices", "vertex", first);
  }
}

TEST_CASE("validate: nested bubbles", "[validate]") {
  Bubbles b;
  b.tetrahedron(0.125, 0.125, 0.125, 0.75);
  const std::vector<uint32_t> outerInward = b.inward, outerOutward = b.outward;
  b.tetrahedron(0.25, 0.25, 0.25, 0.125);
  const std::vector<uint32_t> innerInward(b.inward.begin() + 4, b.inward.end()), innerOutward(b.outward.begin() + 4, b.outward.end());
  SECTION("right") {
    b.cell({0, 0, 0}, 0, joined(b.boxSides, outerInward));
    b.cell({0, 0, 0}, 1, joined(outerOutward, innerInward));
    b.cell({0, 0, 0}, 2, innerOutward);
    b.setWinding({0, 1, 2});
    requirePass(b.validated());
  }
  SECTION("the inner one in the wrong cell") {
    b.cell({0, 0, 0}, 0, joined(joined(b.boxSides, outerInward), innerInward));
    b.cell({0, 0, 0}, 1, outerOutward);
    b.cell({0, 0, 0}, 2, innerOutward);
    b.setWinding({0, 1, 1});
    const Validation validation = b.validated();
    requireOnly(validation, {"partition"});
    CHECK(checkNamed(validation, "partition").elementKind == "cell");
  }
}

TEST_CASE("validate: surface", "[validate]") {
  SECTION("a face that names another triangle") {
    Halves h;
    h.cut.faceTriangle[h.triFaces[3]] = 0;
    h.cut.faceParents[h.cut.faceParentOffsets[h.triFaces[3]]] = 0;
    const Check check = checkNamed(h.validated(), "surfaceArea");
    CHECK_FALSE(check.pass);
    CHECK(check.elementKind == "triangle");
    CHECK(check.element <= 1);
    CHECK_FALSE(checkNamed(h.validated(), "planarity").pass);
  }
  SECTION("a triangle that occurs again, turned over") {
    Halves h;
    h.mesh.triangles.insert(h.mesh.triangles.end(), {0, 2, 1});
    h.cut.triangleCount = 3;
    requireFailure(h.validated(), "surfaceArea", "triangle", 2);
    requireFailure(h.validated(), "droppedTriangles", "triangle", 2);
    h.cut.droppedTriangles = {2};
    requireFailure(h.validated(), "droppedTriangles", "triangle", 2);
    h.cut.droppedTriangles.clear();
    h.addParent(h.triFaces[0], 2, -1);
    requireFailure(h.validated(), "surfaceArea", "triangle", 2);
    h.addParent(h.triFaces[2], 2, -1);
    requirePass(h.validated());
    h.cut.faceParentSigns[h.cut.faceParentOffsets[h.triFaces[0]] + 1] = 1;
    requireFailure(h.validated(), "faces", "face", h.triFaces[0]);
  }
  SECTION("a parent in another plane") {
    Bubbles b = bubble();
    const uint32_t face = b.outward[0] / 2;
    b.addParent(face, 3, 1);
    requireFailure(b.validated(), "faces", "face", face);
    requireFailure(b.validated(), "planarity", "face", face);
  }
  SECTION("dropped for a reason") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {5, 5, 5, 6, 5, 5, 5, 6, 5});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {4, 5, 6, 6, 5, 4, 0, 0, 1});  // outside, outside again, no area
    b.cut.triangleCount += 3;
    b.cut.droppedTriangles = {4, 5, 6};
    requirePass(b.validated());
    b.cut.droppedTriangles = {0, 4, 5, 6};
    requireFailure(b.validated(), "droppedTriangles", "triangle", 0);
  }
}

TEST_CASE("validate: stencil and regions", "[validate]") {
  SECTION("a grid cell that is nowhere") {
    Bubbles b = bubble();
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    requireFailure(b.validated(), "stencil", "grid", 0);
  }
  SECTION("a grid cell both cut and untouched") {
    Bubbles b = bubble();
    b.cut.runBegin[0] = 0;
    requireFailure(b.validated(), "stencil", "cell", 0);
  }
  SECTION("a grid cell cut for nothing") {
    Bubbles b;
    b.tetrahedron(0.25, 0.25, 0.25, 0.5);
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    std::vector<uint32_t> other = b.box(1, b.boxSides[1] / 2);
    b.cell({0, 0, 0}, 0, joined(b.boxSides, b.inward));
    b.cell({0, 0, 0}, 1, b.outward);
    const uint32_t second = b.cell({1, 0, 0}, 0, other);
    b.setWinding({0, 1});
    requireFailure(b.validated(), "stencil", "cell", second);
    requireOnly(b.validated(), {"stencil"});
  }
  SECTION("a region in two parts") {
    Halves h;
    h.cut.cellRegion = {0, 0, 0, 0};
    h.cut.regionCount = 1;
    requireFailure(h.validated(), "regions", "cell", h.above[0]);
  }
  SECTION("a part in two regions") {
    Bubbles b = bubble();
    b.cut.runRegion[0] = 1;
    requireFailure(b.validated(), "regions", "run", 0);
  }
  SECTION("an empty region") {
    Bubbles b = bubble();
    b.cut.regionCount = 3;
    b.cut.regionWinding.push_back(0);
    requireFailure(b.validated(), "regions", "region", 2);
  }
}

TEST_CASE("validate: winding numbers", "[validate]") {
  SECTION("a step that is wrong") {
    Bubbles b = bubble();
    b.cut.regionWinding = {0, 2};
    requireFailure(b.validated(), "windingNumber", "face", b.outward[0] / 2);
    requireFailure(b.validated(), "inputVolume", "mesh", 0);
  }
  SECTION("right steps from a wrong start") {
    Bubbles b = bubble();
    b.cut.regionWinding = {1, 2};
    requireFailure(b.validated(), "inputVolume", "mesh", 0);
    CHECK_FALSE(checkNamed(b.validated(), "windingNumber").pass);
  }
  SECTION("missing") {
    Bubbles b = bubble();
    b.cut.hasWinding = false;
    b.cut.regionWinding.clear();
    requireFailure(b.validated(), "windingNumber", "mesh", 0);
  }
  SECTION("of an open input") {
    Halves h;
    h.cut.hasWinding = true;
    h.cut.regionWinding = {0, -1};
    requireFailure(h.validated(), "windingNumber", "mesh", 0);
  }
  SECTION("a triangle without area makes the input neither surely open nor surely closed") {
    Bubbles b = bubble();
    b.mesh.positions.insert(b.mesh.positions.end(), {5, 5, 5, 6, 6, 6, 7, 7, 7});
    b.mesh.triangles.insert(b.mesh.triangles.end(), {4, 5, 6});
    b.cut.triangleCount++;
    b.cut.droppedTriangles = {4};
    requirePass(b.validated());
    b.cut.hasWinding = false;
    b.cut.regionWinding.clear();
    requirePass(b.validated());
  }
  SECTION("all copies count") {
    for (const bool turned : {false, true}) {
      Bubbles b = bubble();
      for (uint32_t t = 0; t < 4; ++t) {
        const uint32_t *v = &b.mesh.triangles[3 * t], first = v[0], second = v[turned ? 2 : 1], third = v[turned ? 1 : 2];
        b.mesh.triangles.insert(b.mesh.triangles.end(), {first, second, third});
        b.addParent(b.outward[t] / 2, t + 4, turned ? -1 : 1);
      }
      b.cut.triangleCount = 8;
      b.cut.regionWinding = {0, turned ? 0 : 2};
      requirePass(b.validated());
      b.cut.regionWinding = {0, 1};
      requireFailure(b.validated(), "windingNumber", "face", b.outward[0] / 2);
      requireFailure(b.validated(), "inputVolume", "mesh", 0);
    }
  }
}

TEST_CASE("validate: messages are sentences without counts of roundings", "[validate]") {
  SECTION("of a measure") {
    Halves h;
    h.mesh.triangles.insert(h.mesh.triangles.end(), {0, 2, 1});
    h.cut.triangleCount = 3;
    h.mesh.positions.insert(h.mesh.positions.end(), {1, 0.5, 0.75});
    h.mesh.triangles.back() = 4;
    const Check check = checkNamed(h.validated(), "surfaceArea");
    CHECK(check.worst > 1e10);
    CHECK(check.tolerance == 64);
    CHECK(check.message == "Triangle 2 is covered by faces whose area differs from its own by 100%.");
  }
  SECTION("of a small deviation") {
    Halves h;
    h.cut.positions[3 * h.vertex({1, 0, 0.5}) + 2] += 1e-12;
    CHECK(checkNamed(h.validated(), "planarity").message ==
          "Face 0 has a vertex that is off its triangle by less than 0.01% of the largest coordinate, more than rounding explains.");
  }
  SECTION("of violations") {
    Bubbles b = bubble();
    b.cut.droppedTriangles = {0};
    CHECK(checkNamed(b.validated(), "faces").message == "Face 6 names a dropped triangle.");
    b.cut.droppedTriangles = {0, 1};
    CHECK(checkNamed(b.validated(), "faces").message == "Face 6 names a dropped triangle. There are 2 violations in all.");
  }
  SECTION("of the grid") {
    Bubbles b = bubble();
    b.cut.runBegin.clear(), b.cut.runEnd.clear(), b.cut.runRegion.clear();
    b.finishRow();
    CHECK(checkNamed(b.validated(), "stencil").message == "The grid has cells that are neither cut nor untouched, or both.");
  }
  SECTION("of arrays") {
    Bubbles b = bubble();
    b.cut.positions.pop_back();
    CHECK(checkNamed(b.validated(), "arrays").message == "An array of the vertices has a wrong length. All other checks are left out.");
  }
}

TEST_CASE("validate: the same bits for any number of threads", "[validate]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.1, 5);
  const CutResult result = cut(mesh, Grid::around(mesh, 24));
  REQUIRE(result);
  REQUIRE(result.mesh.faceCount() > 3 * 2048);
  CutMesh damaged = result.mesh;
  for (size_t i = 0; i < damaged.faceParents.size(); i += 1000) damaged.faceParents[i] = 0;
  for (size_t f = 0; f < damaged.faceCount(); ++f) {
    if (damaged.faceTriangle[f] >= 0) damaged.faceTriangle[f] = int32_t(damaged.faceParents[damaged.faceParentOffsets[f]]);
  }
  damaged.positions[3 * damaged.loopVertices[0]] += 0.001;
  for (const CutMesh* cutMesh : {&result.mesh, static_cast<const CutMesh*>(&damaged)}) {
    RunOptions options;
    options.threads = 1;
    const Validation one = validate(mesh, *cutMesh, options);
    for (const unsigned threads : {0u, 2u, 7u}) {
      options.threads = threads;
      const Validation many = validate(mesh, *cutMesh, options);
      REQUIRE(many.checks.size() == one.checks.size());
      for (size_t i = 0; i < one.checks.size(); ++i) {
        const Check &a = one.checks[i], &b = many.checks[i];
        INFO(a.name);
        CHECK(a.worst == b.worst);
        CHECK((a.element == b.element && a.elementKind == b.elementKind && a.message == b.message && a.pass == b.pass));
      }
    }
  }
}

TEST_CASE("validate: progress ascends, and cancels", "[validate]") {
  const Mesh mesh = shapes::noisySphere({0, 0, 0}, 1, 0.1, 4);
  const CutResult result = cut(mesh, Grid::around(mesh, 12));
  REQUIRE(result);
  int calls = 0, stage = -1;
  RunOptions options;
  options.progress = [&](const Progress& progress) {
    ++calls;
    CHECK(progress.stageIndex >= stage);
    CHECK(progress.stageIndex < progress.stageCount);
    CHECK(progress.done <= progress.total);
    stage = progress.stageIndex;
    return true;
  };
  requirePass(validate(mesh, result.mesh, options));
  CHECK(calls > 10);
  for (int last = 0; last < calls; last += 3) {
    int left = last;
    options.progress = [&](const Progress&) { return left-- > 0; };
    try {
      validate(mesh, result.mesh, options);
      FAIL("not cancelled");
    } catch (const CallError& error) {
      CHECK(error.error.status == Status::cancelled);
      CHECK(left == -1);
    }
  }
  struct OfTheCaller {};
  options.progress = [](const Progress&) -> bool { throw OfTheCaller(); };
  CHECK_THROWS_AS(validate(mesh, result.mesh, options), OfTheCaller);
}

TEST_CASE("validate: small triangles crowded in a grid cell take as long as large ones that fill it", "[validate]") {
  const Mesh spheres = shapes::merged({shapes::icosphere({0.3, 0.3, 0.3}, 0.25, 4), shapes::icosphere({0.3, 0.3, 0.3}, 0.125, 4),
                                       shapes::icosphere({0.7, 0.7, 0.7}, 0.25, 4)});
  const auto processorTime = [](const Mesh& mesh) {
    const CutResult result = cut(mesh, Grid::regular({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
    REQUIRE(result);
    REQUIRE(result.mesh.cellCount() == 4);
    RunOptions options;
    options.threads = 1;
    std::clock_t least = 0;
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      requirePass(validate(mesh, result.mesh, options));
      const std::clock_t time = std::clock() - start;
      least = run == 0 ? time : std::min(least, time);
    }
    return least;
  };
  constexpr double kSmall = 0x1p-12;
  CHECK(processorTime(shapes::translated(shapes::scaled(spheres, {kSmall, kSmall, kSmall}), {0.5, 0.5, 0.5})) < 5 * processorTime(spheres));
}

TEST_CASE("validate: a mesh that is not the input fails by name", "[validate]") {
  const Bubbles b = bubble();
  const auto failing = [&](const Mesh& mesh) {
    const Validation validation = validate(mesh, b.cut);
    CHECK_FALSE(validation.pass);
    const auto found = std::find_if(validation.checks.begin(), validation.checks.end(), [](const Check& c) { return !c.pass; });
    return found == validation.checks.end() ? "" : found->name;
  };
  CHECK(failing(Mesh{}) == "arrays");
  CHECK(failing(shapes::cube(0, 1)) == "arrays");
  Mesh mesh = b.mesh;
  mesh.positions.resize(9);
  CHECK(failing(mesh) == "arrays");
  mesh = b.mesh;
  mesh.positions[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(failing(mesh) == "arrays");
  mesh.positions[0] = 1e300;
  CHECK(failing(mesh) == "arrays");
  mesh.positions[0] = 0.125;
  CHECK(failing(mesh) == "vertices");
}

TEST_CASE("validate: a snap tolerance that cut() would not take is none of a cut-mesh", "[validate]") {
  Bubbles b = bubble();
  for (const double tolerance : {-0.1, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    b.cut.snapTolerance = tolerance;
    CHECK(b.validated().checks.size() == 1);
    CHECK_FALSE(b.validated().pass);
  }
}

TEST_CASE("validate: right results on inputs that strain rounding", "[validate]") {
  const auto requireCut = [](const Mesh& mesh, const Grid& grid, double snapTolerance = 0) {
    CutOptions options;
    options.snapTolerance = snapTolerance;
    const CutResult result = cut(mesh, grid, options);
    INFO(result.error.message);
    REQUIRE(result);
    CHECK(result.mesh.snapTolerance == snapTolerance);
    requirePass(validate(mesh, result.mesh));
  };
  const double ulp = 0x1p-52;
  const Mesh octahedron{{0.9, 0, 0, -0.9, 0, 0, 0, 0.9, 0, 0, -0.9, 0, 0, 0, 0.9, 0, 0, -0.9},
                        {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
  const auto moved = [&](double by, double scale) {
    Mesh mesh = octahedron;
    for (double& x : mesh.positions) x = x * scale + by;
    return mesh;
  };
  SECTION("far from the origin") {
    requireCut(moved(1e6, 1), Grid::box({1e6 - 1, 1e6 - 1, 1e6 - 1}, {1e6 + 1, 1e6 + 1, 1e6 + 1}, {7, 8, 9}));
  }
  SECTION("huge and tiny") {
    requireCut(moved(0, 1e150), Grid::box({-1e150, -1e150, -1e150}, {1e150, 1e150, 1e150}, {3, 4, 5}));
    requireCut(moved(0, 1e-150), Grid::box({-1e-150, -1e-150, -1e-150}, {1e-150, 1e-150, 1e-150}, {3, 4, 5}));
  }
  SECTION("slabs of one ulp") {
    requireCut(octahedron,
               Grid::rectilinear({{{-1, -0.5, 0.5, 0.5 + ulp, 0.5 + 2 * ulp, 1}, {-1, 0, ulp, 1}, {-1, 0.25, 0.25 + ulp, 0.5, 1}}}));
  }
  SECTION("boxes of different sides") {
    requireCut(Mesh{{0, 0, 1e-9, 900, 0, 1e-9, 0, 0.01, 2e-9}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1000, 0.02, 3e-9}, {9, 8, 7}));
  }
  SECTION("needles and a triangle that is almost flat") {
    requireCut(Mesh{{0.1, 0.1, 0.1, 0.9, 0.8, 0.7, 0.5, 0.45, 0.4 + 1e-13}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {13, 13, 13}));
    requireCut(Mesh{{0, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5 + ulp}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}));
  }
  SECTION("two sheets one ulp apart") {
    const double z = 0.3, up = std::nextafter(z, 1);
    requireCut(Mesh{{0.1, 0.1, z, 0.9, 0.1, z, 0.1, 0.9, z, 0.1, 0.1, up, 0.9, 0.1, up, 0.1, 0.9, up}, {0, 1, 2, 3, 4, 5}},
               Grid::box({0, 0, 0}, {1, 1, 1}, {5, 5, 5}));
    requireCut(Mesh{{0.1, 0.1, z, 0.9, 0.1, z, 0.1, 0.9, z, 0.1, 0.1, up, 0.9, 0.1, up, 0.1, 0.9, up}, {0, 1, 2, 3, 4, 5}},
               Grid::box({0, 0, 0}, {1, 1, 1}, {10, 10, 10}));
  }
  SECTION("corners far outside") {
    requireCut(Mesh{{-1e5, -1e5, 0.3, 1e5, -1e5, 0.7, 0, 2e5, 0.5}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {6, 6, 6}));
  }
  SECTION("vertices snapped onto planes") {
    requireCut(moved(0.001, 1), Grid::box({-1, -1, -1}, {1, 1, 1}, {20, 20, 20}), 0.05);
    requireCut(moved(0.001, 1.11), Grid::rectilinear({{{-1, -0.5, 0, 1}, {-2, -1, 0.1, 1, 2}, {-1, -0.95, 0, 0.9, 1}}}), 0.2);
  }
  SECTION("nothing but a triangle without area") {
    requireCut(Mesh{{0, 0, 0, 1, 1, 0, 3, 3, 0}, {0, 1, 2}}, Grid::box({0, 0, -1}, {3, 3, 2}, {3, 3, 3}));
  }
  SECTION("a surface that touches the box from outside") {
    requireCut(Mesh{{1, 0.2, 0.5, 1, 0.7, 0.5, 2, 0.5, 0.5}, {0, 1, 2}}, Grid::box({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  }
  SECTION("a dropped triangle without area in a crack") {
    requireCut(Mesh{{0, 0, 0.5, 1, 0, 0.5, 0.5, 0, 0.5, 0.5, 0.9, 0.3, 0.5, -0.9, 0.3}, {0, 1, 3, 2, 0, 4, 1, 2, 4, 0, 2, 1}},
               Grid::box({-1, -1, -1}, {2, 2, 2}, {7, 7, 7}));
  }
}
