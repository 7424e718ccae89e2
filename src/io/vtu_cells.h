// The cells of a VTU file, one after the other. None is kept, so that there is no limit to their number.
//
// Cut-cells are polyhedra. Untouched grid cells are hexahedra, except that one with a cut-vertex inside one of its grid-edges is a
// polyhedron too: its faces then have that vertex, as those of its neighbours do, so that all cells match face by face.
#pragma once

#include "io/grid_vertices.h"
#include "io/polygons.h"

namespace mandoline::detail {

/// A polyhedron or the first of a row of hexahedra.
struct VtuCell {
  GridVertices::Index gridCell;
  uint32_t region;
  int64_t cutCell;  ///< or -1
};

/// Faces of a polyhedron, counter-clockwise as seen from outside.
struct Polyhedron {
  std::vector<size_t> faceSizes;
  std::vector<int64_t> faceVertices;
  std::vector<int64_t> vertices;  ///< those of all faces, once

  void clear();
  template <class Vertex>
  void addFace(std::span<const Vertex> polygon, bool reversed) {
    faceSizes.push_back(polygon.size());
    if (reversed) {
      faceVertices.insert(faceVertices.end(), polygon.rbegin(), polygon.rend());
    } else {
      faceVertices.insert(faceVertices.end(), polygon.begin(), polygon.end());
    }
  }
  void gatherVertices();
};

class VtuCells {
 public:
  VtuCells(const CutMesh& cutMesh, const Selection& selection);

  /// Calls onPolyhedron(cell) or onHexahedra(firstCell, count), for a row of cells along x, in the order of the file.
  template <class OnPolyhedron, class OnHexahedra>
  void forEach(const OnPolyhedron& onPolyhedron, const OnHexahedra& onHexahedra) const;

  /// The polyhedron, until the next call.
  const Polyhedron& polyhedron(const VtuCell& cell);
  /// Calls visit(vertex) 8 times for each of a row of hexahedra, in VTK's order.
  template <class Visit>
  void forEachCorner(const VtuCell& first, int32_t count, const Visit& visit) const;

  const GridVertices& vertices() const { return vertices_; }

 private:
  void addFaces(std::span<const uint32_t> halfFaces);
  void addGridFaces(const GridVertices::Index& cell);

  const CutMesh& cutMesh_;
  const Selection& selection_;
  GridVertices vertices_;
  Polygons polygons_;
  Polyhedron polyhedron_;
};

template <class OnPolyhedron, class OnHexahedra>
void VtuCells::forEach(const OnPolyhedron& onPolyhedron, const OnHexahedra& onHexahedra) const {
  for (size_t c = 0; c < cutMesh_.cellCount(); ++c) {
    const int32_t* gridCell = cutMesh_.cellGridCell.data() + 3 * c;
    if (selection_.hasCutCell(c)) onPolyhedron(VtuCell{{gridCell[0], gridCell[1], gridCell[2]}, cutMesh_.cellRegion[c], int64_t(c)});
  }
  const int64_t nx = cutMesh_.grid.cells(0), ny = cutMesh_.grid.cells(1), rows = ny * cutMesh_.grid.cells(2);
  auto divided = vertices_.cellsWithDividedEdges().begin();
  for (int64_t row = 0; row < rows; ++row) {
    selection_.forEachRun(size_t(row), [&](int32_t begin, int32_t end, uint32_t region) {
      VtuCell cell{{begin, int32_t(row % ny), int32_t(row / ny)}, region, -1};
      int32_t& i = cell.gridCell[0];
      while (i < end) {
        const bool more = divided != vertices_.cellsWithDividedEdges().end();
        const int32_t next = int32_t(more ? std::min(*divided - nx * row, int64_t(end)) : end);
        if (i < next) onHexahedra(cell, next - i);
        i = next;
        if (i == end) break;
        onPolyhedron(cell);
        ++divided;
        ++i;
      }
    });
  }
}

template <class Visit>
void VtuCells::forEachCorner(const VtuCell& first, int32_t count, const Visit& visit) const {
  const auto walk = [&](int y, int z) { return vertices_.walkFrom({first.gridCell[0], first.gridCell[1] + y, first.gridCell[2] + z}); };
  std::array<GridVertices::Walk, 4> walks = {walk(0, 0), walk(1, 0), walk(0, 1), walk(1, 1)};
  std::array<int64_t, 4> left, right;
  for (size_t w = 0; w < 4; ++w) left[w] = walks[w].next();
  for (; count > 0; --count, left = right) {
    for (size_t w = 0; w < 4; ++w) right[w] = walks[w].next();
    for (const int64_t v : {left[0], right[0], right[1], left[1], left[2], right[2], right[3], left[3]}) visit(v);
  }
}

}  // namespace mandoline::detail
