// VTU files, read back: their cells match face by face.
#include <algorithm>
#include <sstream>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/io.h"
#include "mandoline/measure.h"
#include "shapes.h"
#include "vtu_files.h"

using mandoline::CutMesh;
using mandoline::Grid;
using mandoline::Mesh;
using mandoline::WriteOptions;
using vtu_files::Vtu;

namespace {

std::string vtuOf(const Mesh& mesh, const CutMesh& cutMesh, const WriteOptions& options = {}) {
  std::ostringstream out;
  mandoline::writeVtu(out, mesh, cutMesh, options);
  return out.str();
}

/// See requireMatching(); with so many polyhedra.
void requireConforming(const Mesh& mesh, const Grid& grid, size_t polyhedra) {
  const CutMesh cutMesh = checkedCut(mesh, grid).mesh;
  const Vtu vtu(vtuOf(mesh, cutMesh));
  const auto types = vtu.array<uint8_t>("types");
  REQUIRE(types.size() == cutMesh.cellCount() + mandoline::UntouchedCells(cutMesh).count());
  REQUIRE(size_t(std::count(types.begin(), types.end(), 42)) == polyhedra);
  REQUIRE(vtu.array<int32_t>("region").size() == types.size());
  REQUIRE(vtu.array<int32_t>("grid_cell").size() == 3 * types.size());
  REQUIRE(vtu.has("winding") == cutMesh.hasWinding);
  vtu_files::requireMatching(vtu, grid);
}

}  // namespace

TEST_CASE("VTU cells match face by face", "[io]") {
  SECTION("aligned cube") { requireConforming(shapes::cube(1, 3), unitGrid(4), 32); }
  SECTION("sphere") {
    const Mesh sphere = shapes::icosphere({2, 2, 2}, 1.4, 2);
    requireConforming(sphere, unitGrid(4), checkedCut(sphere, unitGrid(4)).mesh.cellCount());
  }
  SECTION("tube through grid-faces, which get holes") {
    requireConforming(shapes::tube({1.5, 1.5, 0.5}, 0.3, 2, 8, true), unitGrid(3), 6);
    requireConforming(shapes::tube({1.5, 1.5, 0.5}, 0.3, 2, 8, false), unitGrid(3), 4);
  }
  SECTION("quad floating in a cell") {
    requireConforming(shapes::quad({1.2, 1.2, 1.5}, {1.8, 1.2, 1.5}, {1.8, 1.8, 1.5}, {1.2, 1.8, 1.5}), unitGrid(3), 1);
  }
  SECTION("bubble with a cavity") { requireConforming(shapes::icosphere({1.5, 1.5, 1.5}, 0.3, 1), unitGrid(3), 2); }
  SECTION("tip on a grid-edge, which three untouched cells share") {
    requireConforming(shapes::tetrahedron({1.5, 1, 1}, {1.75, 1.25, 1.25}, {1.25, 1.25, 1.25}, {1.5, 1.25, 1.5}), unitGrid(3), 5);
  }
  SECTION("two tips on the same grid-edge") {
    const Mesh tips = shapes::merged({shapes::tetrahedron({1.25, 1, 1}, {1.375, 1.25, 1.25}, {1.125, 1.25, 1.25}, {1.25, 1.25, 1.5}),
                                      shapes::tetrahedron({1.75, 1, 1}, {1.875, 1.25, 1.25}, {1.625, 1.25, 1.25}, {1.75, 1.25, 1.5})});
    requireConforming(tips, unitGrid(3), 6);
  }
  SECTION("nothing but untouched cells") { requireConforming(shapes::cube(7, 8), unitGrid(4), 0); }
}

TEST_CASE("VTU of some cells has those, their points and nothing else", "[io]") {
  // A bubble around a grid vertex, a tip on a grid-edge of untouched cells, and a sheet.
  const Mesh mesh = shapes::merged({shapes::icosphere({2, 2, 2}, 1.4, 1), shapes::cube(1.75, 2.25),
                                    shapes::tetrahedron({4.5, 4, 4}, {4.75, 4.25, 4.25}, {4.25, 4.25, 4.25}, {4.5, 4.25, 4.5})});
  const CutMesh cutMesh = checkedCut(mesh, unitGrid(6)).mesh;
  const Vtu whole(vtuOf(mesh, cutMesh));
  const auto wholeRegions = whole.array<int32_t>("region");
  const auto wholeCells = vtu_files::cellFaces(whole);
  const auto wholePositions = whole.array<double>("Points");
  for (const bool untouched : {false, true}) {
    for (uint32_t kept = 0; kept <= cutMesh.regionCount; ++kept) {
      WriteOptions options;
      options.untouched = untouched;
      if (kept < cutMesh.regionCount) {
        options.regions.assign(cutMesh.regionCount, 0);
        options.regions[kept] = 1;
      }
      CAPTURE(untouched, kept);
      const Vtu some(vtuOf(mesh, cutMesh, options));
      const auto cells = vtu_files::cellFaces(some);
      const auto positions = some.array<double>("Points");
      std::vector<uint8_t> used(positions.size() / 3, 0);
      size_t next = 0;
      for (size_t c = 0; c < wholeCells.size(); ++c) {
        if (c >= cutMesh.cellCount() && !untouched) break;
        if (kept < cutMesh.regionCount && wholeRegions[c] != int32_t(kept)) continue;
        REQUIRE(next < cells.size());
        REQUIRE(cells[next].size() == wholeCells[c].size());
        for (size_t f = 0; f < wholeCells[c].size(); ++f) {
          const vtu_files::Polygon &a = wholeCells[c][f], &b = cells[next][f];
          REQUIRE(a.size() == b.size());
          for (size_t i = 0; i < a.size(); ++i) {
            REQUIRE(std::equal(&wholePositions[size_t(3 * a[i])], &wholePositions[size_t(3 * a[i])] + 3, &positions[size_t(3 * b[i])]));
            used[size_t(b[i])] = 1;
          }
        }
        ++next;
      }
      REQUIRE(next == cells.size());
      REQUIRE(some.array<double>("volume").size() == cells.size());
      REQUIRE(std::count(used.begin(), used.end(), 0) == 0);
    }
  }
}
