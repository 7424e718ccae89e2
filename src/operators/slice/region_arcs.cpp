// The arcs of a region are closed because those of its cells are, and because what cells share cancels: pieces of grid-faces between two
// cells. They are left out from the start. Along the sides of the grid's box, cut-cells and untouched grid cells have to meet in the same
// points, so an edge of the grid there has one point, however the surface has divided it. With estimates regions also end at grid-faces
// inside, and all this holds there, too.
#include "operators/slice/region_arcs.h"

#include <algorithm>

#include "base/csr.h"

namespace mandoline::operators {

RegionArcs::RegionArcs(const CutMesh& cutMesh, const PlanarCuts& cuts)
    : cutMesh_(cutMesh), cuts_(cuts), faceCutter_(cutMesh, cuts), edgePoints_(cutMesh, cuts.space), boxes_(cutMesh, cuts.grid) {}

const std::vector<RegionArc>& RegionArcs::run(uint32_t p, Points& points) {
  arcs_.clear();
  const CutFaces& cut = faceCutter_.run(p);
  const CuttingPlane& plane = cuts_.planes[p];
  GridPoints gridPoints(cuts_.grid, plane, points);
  edgePoints_.start(plane, points);
  pointOfEdge_.clear();
  for (const auto& edge : cut.pointEdges) {
    GridEdge gridEdge;
    pointOfEdge_.push_back(liesOnSide(edge, gridEdge) ? gridPoints.pointOn(gridEdge) : edgePoints_.pointOn(edge));
  }
  addFaces(cut);
  addBoxes(plane, gridPoints);
  const auto regionOf = [&](size_t i) { return size_t(arcs_[i].region); };
  const auto arcOf = [&](size_t i) { return arcs_[i]; };
  arcs_ = detail::groupBy<RegionArc>(cutMesh_.regionCount, arcs_.size(), regionOf, arcOf).items;
  return arcs_;
}

/// Whether an edge between vertices lies on an edge of the grid that lies on a side of its box.
bool RegionArcs::liesOnSide(const std::array<uint32_t, 2>& edge, GridEdge& gridEdge) const {
  const int32_t *a = &cutMesh_.vertexCell[3 * size_t(edge[0])], *b = &cutMesh_.vertexCell[3 * size_t(edge[1])];
  const uint8_t planes = cutMesh_.commonPlanes(edge[0], edge[1]);
  int common = 0;
  bool onSide = false;
  gridEdge.axis = 0;
  for (int d = 0; d < 3; ++d) {
    gridEdge.at[size_t(d)] = std::min(a[d], b[d]);
    if ((planes >> d & 1) != 0) {
      ++common;
      onSide |= a[d] == 0 || a[d] == cutMesh_.grid.cells(d) || !cutMesh_.regionInsideness.empty();
    } else {
      gridEdge.axis = d;
    }
  }
  return common == 2 && onSide;
}

void RegionArcs::addFaces(const CutFaces& cut) {
  for (const CutFace& face : cut.faces) {
    const std::array<int64_t, 2> regions = {regionBeside(face, 0), regionBeside(face, 1)};
    int32_t line = cutMesh_.faceTriangle[face.face];
    if (line < 0) {
      if (regions[0] == regions[1]) continue;  // a piece of a grid-face between two cells
      line = ~(3 * cutMesh_.facePlane[face.face] + int32_t(cutMesh_.faceAxis[face.face]));
    }
    const bool isSlit = regions[0] == regions[1];
    for (size_t side = 0; side < (isSlit ? 1 : 2); ++side) {
      if (regions[side] < 0) continue;
      for (uint32_t s = face.firstSegment; s < face.endSegment; ++s) {
        const Segment& segment = cut.segments[s];
        add({uint32_t(regions[side]), pointOfEdge_[segment[side]], pointOfEdge_[segment[1 - side]], line, isSlit});
      }
    }
  }
}

/// The region on a side of a face, or -1 outside the grid.
int64_t RegionArcs::regionBeside(const CutFace& face, int side) const {
  const uint32_t cell = face.cells[size_t(side)], opposite = face.cells[size_t(1 - side)];
  if (cell != CutFace::kNone) return cutMesh_.cellRegion[cell];
  const int axis = cutMesh_.faceAxis[face.face];
  if (axis < 0) return -1;  // the cut-mesh is not valid
  std::array<int32_t, 3> at;
  for (size_t d = 0; d < 3; ++d) at[d] = cutMesh_.cellGridCell[3 * size_t(opposite) + d];
  at[size_t(axis)] = 2 * cutMesh_.facePlane[face.face] - 1 - at[size_t(axis)];  // the plane's index is that of the cell above it
  return UntouchedCells(cutMesh_).regionAt(at[0], at[1], at[2]);
}

/// Whether a side of an untouched grid cell is one of the grid's box, or has an untouched grid cell of another region beyond it.
bool RegionArcs::isBorder(const GridCell& gridCell, uint32_t region, int axis, int upper) const {
  if (gridCell[size_t(axis)] == (upper == 1 ? int32_t(cutMesh_.grid.cells(axis)) - 1 : 0)) return true;
  if (cutMesh_.regionInsideness.empty()) return false;
  GridCell next = gridCell;
  next[size_t(axis)] += upper == 1 ? 1 : -1;
  const int64_t other = UntouchedCells(cutMesh_).regionAt(next[0], next[1], next[2]);
  return other >= 0 && other != region;
}

/// Those sides of all untouched grid cells.
void RegionArcs::addBoxes(const CuttingPlane& plane, GridPoints& gridPoints) {
  const auto isLast = [&](int32_t i, int d) { return i == 0 || i + 1 == cutMesh_.grid.cells(d); };
  boxes_.forUntouched(plane, [&](int32_t begin, int32_t end, int32_t j, int32_t k, uint32_t region) {
    if (isLast(j, 1) || isLast(k, 2) || !cutMesh_.regionInsideness.empty()) {
      for (int32_t i = begin; i < end; ++i) addBox({i, j, k}, region, plane, gridPoints);
    } else {
      if (isLast(begin, 0)) addBox({begin, j, k}, region, plane, gridPoints);
      if (end - begin > 1 && isLast(end - 1, 0)) addBox({end - 1, j, k}, region, plane, gridPoints);
    }
  });
}

void RegionArcs::addBox(const GridCell& gridCell, uint32_t region, const CuttingPlane& plane, GridPoints& gridPoints) {
  const auto corner = [&](unsigned c) {
    return GridCell{gridCell[0] + int32_t(c & 1), gridCell[1] + int32_t(c >> 1 & 1), gridCell[2] + int32_t(c >> 2)};
  };
  const auto pointOn = [&](unsigned edge) {
    const unsigned lower = edge / 8, upper = edge % 8;
    return gridPoints.pointOn({int((upper - lower) / 2), corner(lower)});
  };
  unsigned above = 0;
  for (unsigned c = 0; c < 8; ++c) above |= unsigned(plane.isAbove(cuts_.grid.corner(corner(c)))) << c;
  const BoxCut& cut = boxCuts_[uint8_t(above)];
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, upper = side % 2;
    const BoxCut::Way way = cut.wayOn(side);
    if (way.start == BoxCut::kNone || !isBorder(gridCell, region, axis, upper)) continue;
    const int32_t line = ~(3 * (gridCell[size_t(axis)] + upper) + axis);
    add({region, pointOn(way.start), pointOn(way.end), line, false});
  }
}

void RegionArcs::add(const RegionArc& arc) {
  if (arc.start != arc.end) arcs_.push_back(arc);
}

}  // namespace mandoline::operators
