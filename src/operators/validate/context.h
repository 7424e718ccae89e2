// The cut-mesh and its input as validate() sees them: scaled, snapped, welded, and grouped by grid cell.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/csr.h"
#include "mandoline/validate.h"
#include "operators/validate/exact_places.h"
#include "operators/validate/geometry.h"

namespace mandoline::validation {

/// All coordinates are scaled by one power of two that brings the largest up to here, so that products of up to eight of them neither
/// overflow nor underflow; and those smaller by a factor of 2^200 count as 0.
constexpr int kLargestExponent = 120, kNegligibleExponent = -80;
/// The exponent of that power of two.
int scaleOf(const MeshView& mesh, const Grid& grid);

/// Scaled coordinates.
struct Coordinates {
  std::array<std::vector<double>, 3> planes;
  std::vector<double> positions;     ///< the cut-mesh's
  std::vector<double> triPositions;  ///< the input's, snapped onto planes
};
Coordinates scaled(const MeshView& mesh, const CutMesh& cutMesh);

/// Cut-cells by grid cell.
struct GridCellGroups {
  std::vector<uint32_t> cells;    ///< ascending by the grid cell's z, y, x, and by id within one
  std::vector<uint32_t> offsets;  ///< into cells: one group per grid cell

  size_t count() const { return offsets.size() - 1; }
  std::span<const uint32_t> operator[](size_t group) const { return {cells.data() + offsets[group], offsets[group + 1] - offsets[group]}; }
};
GridCellGroups groupByGridCell(const CutMesh& cutMesh);

/// An edge by its vertices, the lower one first.
using Edge = std::array<uint32_t, 2>;
inline Edge edgeOf(uint32_t u, uint32_t v) { return {std::min(u, v), std::max(u, v)}; }

/// The cut-mesh and its input, with what follows from their arrays. Needs arrays that passed checkArrays.
struct Context {
  Context(const MeshView& mesh, const CutMesh& cutMesh);

  const MeshView& mesh;
  const CutMesh& cut;

  const Coordinates coordinates;
  const std::vector<uint8_t> dropped;  ///< per triangle
  const std::vector<uint32_t> weld;    ///< per tri-vertex: the lowest one at its position, among those that triangles have
  const Vec3 rounding;                 ///< one rounding per axis
  const std::vector<int32_t> owner;    ///< per half-face: its cut-cell (the first that lists it), or -1
  const GridCellGroups groups;
  /// Per group: edges in the lower sides of its grid cell that tri-faces beyond these sides have.
  const detail::Csr<Edge> edgesBeyond;
  const ExactPlaces exact;

  const std::array<std::vector<double>, 3>& planes() const { return coordinates.planes; }
  Vec3 vertex(uint32_t v) const { return at(coordinates.positions, v); }
  Vec3 triVertex(uint32_t v) const { return at(coordinates.triPositions, v); }
  Vec3 corner(size_t triangle, int i) const { return triVertex(mesh.triangles[3 * triangle + size_t(i)]); }
  Normal triangleNormal(size_t t) const { return normalOf(corner(t, 0), corner(t, 1), corner(t, 2)); }
  bool hasArea(size_t t) const { return !collinear(corner(t, 0), corner(t, 1), corner(t, 2)); }
  /// Coordinates relative to an origin, in roundings.
  Vec3 inRoundings(const Vec3& p, const Vec3& origin) const {
    return {{(p[0] - origin[0]) / rounding[0], (p[1] - origin[1]) / rounding[1], (p[2] - origin[2]) / rounding[2]}};
  }
  const int32_t* cellAt(uint32_t v) const { return cut.vertexCell.data() + 3 * size_t(v); }
  bool onPlane(uint32_t v, int axis) const { return cut.vertexMask[v] >> axis & 1; }
  /// Whether vertex v lies in the closed grid cells i along the axis.
  bool inSlab(uint32_t v, int axis, int32_t i) const { return cellAt(v)[axis] == i || (onPlane(v, axis) && cellAt(v)[axis] == i + 1); }
  const int32_t* gridCellOf(size_t cell) const { return cut.cellGridCell.data() + 3 * cell; }
  bool inBox(const Vec3& p) const;
  bool triangleInBox(size_t t) const { return inBox(corner(t, 0)) && inBox(corner(t, 1)) && inBox(corner(t, 2)); }
  /// The triangles that face f is a part of, and its signs of them.
  std::span<const uint32_t> parents(size_t f) const { return {cut.faceParents.data() + cut.faceParentOffsets[f], parentCount(f)}; }
  std::span<const int8_t> parentSigns(size_t f) const { return {cut.faceParentSigns.data() + cut.faceParentOffsets[f], parentCount(f)}; }
  /// Where a vertex is among the made ones, or -1.
  int64_t madeIndex(uint32_t v) const;
  /// Exact: whether a triangle's plane holds a vertex.
  bool inPlane(uint32_t v, size_t triangle) const { return !exact.isKnown(v) || exact.planeOf(triangle).holds(exact[v]); }
  /// Exact: whether the planes of two triangles are the same.
  bool haveOnePlane(size_t s, size_t t) const;
  /// Exact: sign of the axis-component of a triangle's normal.
  int sideOf(size_t triangle, int axis) const { return turn(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), axis); }
  /// Sign of the axis-component of the normal of an axial face.
  int axialSide(size_t face) const;
  /// The runs of untouched grid cells: index of the one that holds a grid cell, or -1.
  int64_t runAt(int64_t i, int64_t j, int64_t k) const;

 private:
  size_t parentCount(size_t f) const { return cut.faceParentOffsets[f + 1] - cut.faceParentOffsets[f]; }
  static Vec3 at(const std::vector<double>& coordinates, uint32_t v) {
    const double* p = &coordinates[3 * size_t(v)];
    return {{p[0], p[1], p[2]}};
  }
};

}  // namespace mandoline::validation
