// Cut-meshes laid down by hand, and what the validator must say of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "catch.h"
#include "mandoline/validate.h"

namespace sketches {

using namespace mandoline;

using Point = std::array<double, 3>;
using Loop = std::vector<Point>;

inline std::vector<uint32_t> joined(std::vector<uint32_t> a, const std::vector<uint32_t>& b) {
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

inline Bubbles bubble() {
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

inline void requirePass(const Validation& validation) {
  for (const Check& check : validation.checks) {
    INFO(check.name << ": " << check.message);
    CHECK(check.pass);
    CHECK_FALSE(std::isnan(check.worst));
  }
  CHECK(validation.pass);
}

inline Check checkNamed(const Validation& validation, const std::string& name) {
  const auto found = std::find_if(validation.checks.begin(), validation.checks.end(), [&](const Check& c) { return c.name == name; });
  REQUIRE(found != validation.checks.end());
  return *found;
}

/// The named check fails and points at the element.
inline void requireFailure(const Validation& validation, const std::string& name, const std::string& kind, int64_t element) {
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
inline void requireOnly(const Validation& validation, const std::vector<std::string>& expected) {
  std::vector<std::string> names;
  for (const Check& check : validation.checks) {
    if (!check.pass) names.push_back(check.name);
  }
  CHECK(names == expected);
}

}  // namespace sketches
