// The same input in another form has the same cells, up to a known relabelling, and the same bits where nothing is rounded anew.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// How cells, faces and triangles of one cut are named in another one's terms.
struct Relabelling {
  std::array<int, 3> axes = {0, 1, 2};  ///< axis d of the result is axis axes[d] before relabelling
  std::array<bool, 3> negate = {};      ///< whether axis d of the result is negated
  std::array<int32_t, 3> shift = {};    ///< cells added along axis d of the result
  std::vector<uint32_t> triangle;       ///< new id of each triangle; empty: the same
  bool flipped = false;                 ///< whether the triangles were turned around

  bool mirrors() const {
    const int swaps = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
    return (swaps + negate[0] + negate[1] + negate[2]) % 2 != 0;
  }
};

using Words = std::vector<int64_t>;

/// What does not depend on ids: each cell as its grid cell, its region's winding number and its faces, each of them as the triangle or
/// plane that it lies in, its side and its loops' lengths. In ascending order.
std::vector<Words> signature(const CutMesh& mesh, const Relabelling& relabelling) {
  const auto triangleId = [&](int32_t t) { return relabelling.triangle.empty() ? t : int32_t(relabelling.triangle[t]); };
  std::vector<Words> cells;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    std::vector<Words> faces;
    for (uint32_t halfFace : mesh.halfFaces(c)) {
      const uint32_t f = halfFace / 2;
      int64_t side = halfFace % 2, axis = -1, plane = 0;
      if (mesh.faceAxis[f] >= 0) {
        axis = std::find(relabelling.axes.begin(), relabelling.axes.end(), mesh.faceAxis[f]) - relabelling.axes.begin();
        const bool negated = relabelling.negate[axis];
        plane = (negated ? mesh.grid.cells(mesh.faceAxis[f]) - mesh.facePlane[f] : mesh.facePlane[f]) + relabelling.shift[axis];
        if (mesh.faceTriangle[f] < 0 && negated) side = 1 - side;
      }
      // A mirrored triangle's normal is that of the mirrored vertices: opposite to the mirrored normal.
      if (mesh.faceTriangle[f] >= 0 && relabelling.mirrors() != relabelling.flipped) side = 1 - side;
      Words face = {mesh.faceTriangle[f] < 0 ? -1 : triangleId(mesh.faceTriangle[f]), axis, plane, side};
      Words loops;
      for (uint32_t l = mesh.faceLoopOffsets[f]; l < mesh.faceLoopOffsets[f + 1]; ++l) loops.push_back(int64_t(mesh.loop(l).size()));
      std::sort(loops.begin(), loops.end());
      face.insert(face.end(), loops.begin(), loops.end());
      faces.push_back(face);
    }
    std::sort(faces.begin(), faces.end());
    Words cell;
    for (int d = 0; d < 3; ++d) {
      const int axis = relabelling.axes[d];
      const int64_t at = mesh.cellGridCell[3 * c + axis];
      cell.push_back((relabelling.negate[d] ? mesh.grid.cells(axis) - 1 - at : at) + relabelling.shift[d]);
    }
    const int sign = relabelling.mirrors() != relabelling.flipped ? -1 : 1;
    cell.push_back(mesh.hasWinding ? sign * mesh.regionWinding[mesh.cellRegion[c]] : 0);
    for (const Words& face : faces) cell.insert(cell.end(), face.begin(), face.end());
    cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// The same cells as `b` up to the relabelling of `a`, the same dropped triangles and regions of the same volumes.
void checkSame(const CheckedCut& a, const CheckedCut& b, const Relabelling& relabelling, double volumeFactor = 1) {
  CHECK(a.mesh.vertexCount() == b.mesh.vertexCount());
  CHECK(a.mesh.faceCount() == b.mesh.faceCount());
  CHECK(a.mesh.hasWinding == b.mesh.hasWinding);
  CHECK(signature(a.mesh, relabelling) == signature(b.mesh, {}));
  std::vector<uint32_t> dropped = a.mesh.droppedTriangles;
  if (!relabelling.triangle.empty())
    for (uint32_t& t : dropped) t = relabelling.triangle[t];
  std::sort(dropped.begin(), dropped.end());
  CHECK(dropped == b.mesh.droppedTriangles);
  std::vector<double> volumes = a.regionVolumes();
  for (double& v : volumes) v *= volumeFactor;
  CHECK(near(volumes, b.regionVolumes(), 1e-12 * b.volume()));
}

Grid permutedGrid(const Grid& grid, const std::array<int, 3>& axes, const std::array<bool, 3>& negate) {
  std::array<std::vector<double>, 3> planes;
  for (int d = 0; d < 3; ++d) {
    planes[d] = grid.planes[axes[d]];
    if (!negate[d]) continue;
    std::reverse(planes[d].begin(), planes[d].end());
    for (double& x : planes[d]) x = -x;
  }
  return Grid::rectilinear(planes);
}

/// All arrays that no coordinate goes into.

}  // namespace

TEST_CASE("permuted and reflected axes", "[metamorphic]") {
  const std::array<int, 3> orders[] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const CheckedCut original = checkedCut(named.mesh, named.grid);
    for (const auto& axes : orders)
      for (int bits = 0; bits < 8; bits += axes == orders[0] ? 1 : 7) {
        const std::array<bool, 3> negate = {bool(bits & 1), bool(bits & 2), bool(bits & 4)};
        INFO("axes " << axes[0] << axes[1] << axes[2] << " negated " << bits);
        Relabelling relabelling;
        relabelling.axes = axes;
        relabelling.negate = negate;
        checkSame(original, checkedCut(shapes::permuted(named.mesh, axes, negate), permutedGrid(named.grid, axes, negate)), relabelling);
      }
  }
}

TEST_CASE("moved by whole cells with its grid", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const double by = 1024;
    Grid grid = named.grid;
    for (auto& planes : grid.planes)
      for (double& x : planes) x += by;
    checkSame(checkedCut(named.mesh, named.grid), checkedCut(shapes::translated(named.mesh, {by, by, by}), Grid::rectilinear(grid.planes)),
              {});
  }
}

TEST_CASE("moved by whole cells within a larger grid", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    bool inside = true;
    for (size_t k = 0; k < named.mesh.positions.size(); ++k)
      inside =
          inside && named.mesh.positions[k] > named.grid.planes[k % 3].front() && named.mesh.positions[k] < named.grid.planes[k % 3].back();
    if (!inside) continue;  // then the larger grid cuts more of it
    Relabelling relabelling;
    Grid larger = named.grid;
    for (int d = 0; d < 3; ++d)
      for (; relabelling.shift[d] <= d; ++relabelling.shift[d])
        larger.planes[d].insert(larger.planes[d].begin(), larger.planes[d].front() - 1);
    const CheckedCut original = checkedCut(named.mesh, named.grid), moved = checkedCut(named.mesh, Grid::rectilinear(larger.planes));
    CHECK(signature(original.mesh, relabelling) == signature(moved.mesh, {}));
    CHECK(original.mesh.positions == moved.mesh.positions);
  }
}

TEST_CASE("scaled by powers of two", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const CheckedCut original = checkedCut(named.mesh, named.grid);
    for (int exponent : {-30, -3, 1, 40}) {
      const double s = std::ldexp(1., exponent);
      Grid grid = named.grid;
      for (auto& planes : grid.planes)
        for (double& x : planes) x *= s;
      const CheckedCut cut = checkedCut(shapes::scaled(named.mesh, {s, s, s}), Grid::rectilinear(grid.planes));
      CHECK(differences(original.mesh, cut.mesh) == std::vector<std::string>{"positions", "grid", "madeFrom", "fingerprint"});
      std::vector<double> positions = original.mesh.positions;
      for (double& x : positions) x *= s;
      CHECK(positions == cut.mesh.positions);
      checkSame(original, cut, {}, s * s * s);
    }
    const std::array<double, 3> s = {4, 0.5, 8};  // another power along each axis
    Grid grid = named.grid;
    for (int d = 0; d < 3; ++d)
      for (double& x : grid.planes[d]) x *= s[d];
    checkSame(original, checkedCut(shapes::scaled(named.mesh, s), Grid::rectilinear(grid.planes)), {}, s[0] * s[1] * s[2]);
  }
}

TEST_CASE("shuffled ids", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const CheckedCut original = checkedCut(named.mesh, named.grid);
    for (unsigned seed : {1, 2}) {
      Relabelling relabelling;
      const Mesh mesh = shapes::shuffled(named.mesh, seed, relabelling.triangle);
      checkSame(original, checkedCut(mesh, named.grid), relabelling);
    }
  }
}

TEST_CASE("flipped triangles", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    Relabelling relabelling;
    relabelling.flipped = true;
    checkSame(checkedCut(named.mesh, named.grid), checkedCut(shapes::flipped(named.mesh), named.grid), relabelling);
  }
}

TEST_CASE("a split triangle", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const CheckedCut original = checkedCut(named.mesh, named.grid);
    for (size_t t = 0; t < named.mesh.triangleCount(); t += 1 + named.mesh.triangleCount() / 4) {
      INFO("triangle " << t);
      const CheckedCut cut = checkedCut(shapes::withSplitTriangle(named.mesh, uint32_t(t)), named.grid);
      CHECK(cut.cells() == original.cells());
      CHECK(cut.mesh.regionCount == original.mesh.regionCount);
      CHECK(cut.mesh.hasWinding == original.mesh.hasWinding);
      CHECK(near(cut.regionVolumes(), original.regionVolumes(), 1e-12));
    }
  }
}

TEST_CASE("unwelded vertices", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    checkSame(checkedCut(named.mesh, named.grid), checkedCut(shapes::unwelded(named.mesh), named.grid), {});
  }
}

TEST_CASE("one thread or many, once or again: the same bits", "[metamorphic]") {
  for (const NamedCase& named : caseList()) {
    INFO(named.name);
    const CutResult once = cut(named.mesh, named.grid);
    REQUIRE(once);
    for (unsigned threads : {1u, 2u, 3u, 8u, 0u}) {
      CutOptions options;
      options.threads = threads;
      const CutResult again = cut(named.mesh, named.grid, options);
      REQUIRE(again);
      CHECK(differences(once.mesh, again.mesh).empty());
    }
  }
  // Large enough for every stage to have work for all threads.
  const Mesh mesh = shapes::noisySphere({2, 2, 2}, 1.5, 0.02, 6);
  const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {40, 40, 40});
  const CutResult once = cut(mesh, grid);
  REQUIRE(once);
  for (unsigned threads : {2u, 5u}) {
    CutOptions options;
    options.threads = threads;
    const CutResult again = cut(mesh, grid, options);
    REQUIRE(again);
    CHECK(differences(once.mesh, again.mesh).empty());
  }
}

TEST_CASE("a prepared mesh is cut to the same bits in grids larger than it", "[metamorphic]") {
  const Mesh mesh = shapes::merged({shapes::icosphere({0.1, 0.2, 0.3}, 1, 2), shapes::icosphere({0.7, 0.5, 0.4}, 1.1, 2)});
  const PreparedMesh prepared = prepare(mesh).mesh;
  for (const double reach : {3.0, 5.0, 11.0, 1e3, 1e5}) {
    CAPTURE(reach);
    const std::vector<double> planes = {-reach, -1.03, 0.21, 0.67, 1.9, reach};
    const Grid grid = Grid::rectilinear({planes, planes, planes});
    const CutResult result = cut(mesh, grid);
    REQUIRE(result);
    REQUIRE(result.mesh.madeVertices.size() > 50);
    CHECK(differences(result.mesh, cut(prepared, grid).mesh).empty());
  }
}

TEST_CASE("a difference of one bit is seen in every array, in the grid and in the counts", "[metamorphic]") {
  const NamedCase named = caseList()[0];
  const CutResult result = cut(named.mesh, named.grid);
  REQUIRE(result);
  std::vector<std::string> names;
  forEachArray(result.mesh, [&](const ArrayInfo& info, const auto&) { names.push_back(info.name); });
  for (const std::string& name : names) {
    CutMesh changed = result.mesh;
    forEachArray(changed, [&](const ArrayInfo& info, auto& array) {
      if (info.name != name) return;
      if (array.empty()) array.emplace_back();
      *reinterpret_cast<uint8_t*>(&array.back()) ^= 1;
    });
    CHECK(differences(result.mesh, changed) == std::vector{name});
  }
  CutMesh changed = result.mesh;
  changed.positions.push_back(0.0);
  CutMesh negative = changed;
  negative.positions.back() = -0.0;
  CHECK(differences(changed, negative) == std::vector<std::string>{"positions"});
  changed = result.mesh;
  changed.grid.planes[2].back() *= 1 + 0x1p-52;
  ++changed.regionCount;
  changed.hasWinding = !changed.hasWinding;
  ++changed.triangleCount;
  CHECK(differences(result.mesh, changed) == std::vector<std::string>{"grid", "regionCount", "hasWinding", "triangleCount"});
}
