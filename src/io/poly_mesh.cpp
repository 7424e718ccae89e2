#include "io/poly_mesh.h"

#include <algorithm>
#include <array>

#include "base/sort.h"
#include "io/groups.h"

namespace mandoline::detail {
namespace {

constexpr const char* kBoxPatches[] = {"xMin", "xMax", "yMin", "yMax", "zMin", "zMax", "inner"};  // in the order of FaceTag
constexpr const char* kSurface = "surface";

/// What the faces of a tag belong to, in the order of FaceTag; inner ones if only one of their cells is written. From FaceTag::surface on
/// there is one for each group. These are one group of OpenFOAM's, so that `surface` means all of them there; not if one has that name
/// itself.
std::vector<PolyPatch> emptyPatches(const TriangleGroups* groups) {
  std::vector<PolyPatch> patches;
  for (const char* const name : kBoxPatches) patches.push_back({name, "patch", {}});
  const std::vector<std::string> walls = groups ? patchNames(groups->names, kBoxPatches) : std::vector<std::string>{kSurface};
  const bool isGroup = std::find(walls.begin(), walls.end(), kSurface) == walls.end();
  for (const std::string& name : walls) patches.push_back({name, "wall", {}, isGroup ? "    inGroups 1(surface);\n" : ""});
  return patches;
}

void numberCells(const CellComplex& cells, FunctionRef<bool(size_t cell)> isWritten, PolyMesh& mesh) {
  mesh.cellNumbers.assign(cells.cellCount(), PolySide::kLeftOut);
  std::vector<std::vector<int32_t>> ofRegion;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (!isWritten(c)) continue;
    const uint32_t region = cells.cellRegion[c];
    mesh.cellNumbers[c] = int32_t(mesh.cells++);
    if (ofRegion.size() <= region) ofRegion.resize(size_t(region) + 1);
    ofRegion[region].push_back(mesh.cellNumbers[c]);
  }
  for (uint32_t r = 0; r < ofRegion.size(); ++r) {
    if (!ofRegion[r].empty()) mesh.zones.push_back({r, std::move(ofRegion[r])});
  }
}

void addSides(const CutMesh& cutMesh, const CellComplex& cells, const TriangleGroups* groups, bool simpleCells, PolyMesh& mesh) {
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    std::array<int32_t, 2> at{};
    for (size_t side = 0; side < 2; ++side) {
      const int32_t cell = cells.faceCells[2 * f + side];
      at[side] = cell < 0 ? PolySide::kLeftOut : mesh.cellNumbers[size_t(cell)];
    }
    if (simpleCells && at[0] == at[1] && at[0] != PolySide::kLeftOut) continue;
    const bool separates = cells.faceTag[f] == FaceTag::surface;  // also two sides of one cell
    if (!separates && at[0] != PolySide::kLeftOut && at[1] != PolySide::kLeftOut) {
      const size_t owner = at[0] < at[1] ? 0 : 1;
      mesh.inner.push_back({at[owner], at[1 - owner], uint32_t(2 * f + owner)});
      continue;
    }
    const size_t patch = size_t(cells.faceTag[f]) + (separates && groups ? size_t(groups->of(triangleOf(cutMesh, cells, f))) : 0);
    for (size_t side = 0; side < 2; ++side) {
      if (at[side] != PolySide::kLeftOut) mesh.patches[patch].sides.push_back({at[side], PolySide::kLeftOut, uint32_t(2 * f + side)});
    }
  }
}

void dropInnerIfEmpty(PolyMesh& mesh) {
  std::erase_if(mesh.patches, [](const PolyPatch& p) { return p.name == kBoxPatches[size_t(FaceTag::inner)] && p.sides.empty(); });
}

}  // namespace

PolyMesh makePolyMesh(const CutMesh& cutMesh, const CellComplex& cells, const TriangleGroups* groups, bool simpleCells,
                      FunctionRef<bool(size_t cell)> isWritten) {
  PolyMesh mesh;
  numberCells(cells, isWritten, mesh);
  mesh.patches = emptyPatches(groups);
  addSides(cutMesh, cells, groups, simpleCells, mesh);
  sortItems(mesh.inner, isUpperBefore);
  dropInnerIfEmpty(mesh);
  return mesh;
}

std::vector<uint8_t> regionsAtSides(uint32_t regionCount, const CellComplex& cells) {
  std::vector<uint8_t> atSides(regionCount);
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] >= FaceTag::inner) continue;
    for (const int32_t cell : {cells.faceCells[2 * f], cells.faceCells[2 * f + 1]}) {
      if (cell >= 0) atSides[cells.cellRegion[size_t(cell)]] = 1;
    }
  }
  return atSides;
}

size_t countLeftOut(const std::vector<uint8_t>& atSides) {
  const size_t others = size_t(std::count(atSides.begin(), atSides.end(), uint8_t(0)));
  return others < atSides.size() ? others : 0;
}

void dropEmptySides(PolyMesh& mesh, const ComplexPolygons& polygons) {
  const auto drop = [&](std::vector<PolySide>& sides) {
    std::erase_if(sides, [&](const PolySide& side) { return polygons.isEmpty(side.halfFace / 2); });
  };
  drop(mesh.inner);
  for (PolyPatch& patch : mesh.patches) drop(patch.sides);
  dropInnerIfEmpty(mesh);
}

void countFaces(PolyFiles& files) {
  constexpr uint32_t kUsed = 0;
  PolyMesh& mesh = files.mesh;
  mesh.pointNumbers.assign(files.cells.vertexCount(), PolyMesh::kUnused);
  mesh.forEach([&](const PolySide& side) {
    files.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t> polygon) {
      for (const uint32_t v : polygon) mesh.pointNumbers[v] = kUsed;
      ++mesh.faces;
      mesh.innerFaces += side.neighbour != PolySide::kLeftOut;
    });
  });
  for (uint32_t& number : mesh.pointNumbers) {
    if (number == kUsed) number = uint32_t(mesh.points++);
  }
}

}  // namespace mandoline::detail
