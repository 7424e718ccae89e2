#include "io/vtu_cells.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::detail {

void Polyhedron::clear() {
  faceSizes.clear();
  faceVertices.clear();
  vertices.clear();
}

void Polyhedron::gatherVertices() {
  vertices = faceVertices;
  sortUnique(vertices);
}

VtuCells::VtuCells(const CutMesh& cutMesh, const Selection& selection)
    : cutMesh_(cutMesh), selection_(selection), vertices_(cutMesh, selection), polygons_(cutMesh) {}

const Polyhedron& VtuCells::polyhedron(const VtuCell& cell) {
  polyhedron_.clear();
  if (cell.cutCell < 0) {
    addGridFaces(cell.gridCell);
  } else {
    addFaces(cutMesh_.halfFaces(size_t(cell.cutCell)));
  }
  polyhedron_.gatherVertices();
  return polyhedron_;
}

void VtuCells::addFaces(std::span<const uint32_t> halfFaces) {
  std::vector<uint32_t> sorted;  // to find a half-face's other side
  if (selection_.simpleCells()) {
    sorted.assign(halfFaces.begin(), halfFaces.end());
    std::sort(sorted.begin(), sorted.end());
  }
  for (const uint32_t h : halfFaces) {
    if (std::binary_search(sorted.begin(), sorted.end(), h ^ 1)) continue;
    polygons_.forEach(h / 2, [&](std::span<const uint32_t> polygon) { polyhedron_.addFace(polygon, h % 2 != 0); });
  }
}

void VtuCells::addGridFaces(const GridVertices::Index& cell) {
  const auto moved = [](GridVertices::Index corner, int axis) {
    ++corner[size_t(axis)];
    return corner;
  };
  std::vector<int64_t> loop;  // counter-clockwise about +axis
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      const GridVertices::Index lowest = side == 0 ? cell : moved(cell, axis);
      loop.clear();
      vertices_.appendEdge(lowest, u, true, loop);
      vertices_.appendEdge(moved(lowest, u), v, true, loop);
      vertices_.appendEdge(moved(lowest, v), u, false, loop);
      vertices_.appendEdge(lowest, v, false, loop);
      polyhedron_.addFace(std::span<const int64_t>(loop), side == 0);
    }
  }
}

}  // namespace mandoline::detail
