// The filled cross-section of a cut-mesh with a plane, and the outlines of its regions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// The points x with normal . x = offset. The normal may have any length.
struct Plane {
  std::array<double, 3> normal;
  double offset;
};

struct SliceOptions {
  bool untouched = true;  ///< whether untouched grid cells are cut, too
};

/// The polygons in which a plane cuts the cells: those of the cut-cells in ascending order, then those of the untouched grid cells. A cell
/// may have several. A slit (the cut of a sheet that ends within the cell) is a part of a loop that runs there and back, or a loop of its
/// own; triangles ignore slits. Points are shared by the polygons of neighbouring cut-cells; each polygon of an untouched grid
/// cell has its own. Where triangles cross that Intersections::assumeNone did not look for, so may a polygon's loops.
struct Slice {
  std::vector<double> positions;                ///< 3 per point, on the plane, world units
  std::vector<uint32_t> loopOffsets{0};         ///< into loopPoints
  std::vector<uint32_t> loopPoints;             ///< points of the loops
  std::vector<uint32_t> polygonLoopOffsets{0};  ///< into loops, per polygon: an outer one, counter-clockwise about the normal, then holes
  std::vector<int32_t> polygonCell;             ///< per polygon: the cut-cell that it is a cut of, or -1 for an untouched grid cell
  std::vector<int32_t> polygonGridCell;         ///< 3 per polygon: the grid cell
  std::vector<uint32_t> polygonRegion;          ///< per polygon: region
  std::vector<uint32_t> polygonTriangleOffsets{0};  ///< into triangles (in triangles, not entries), per polygon
  std::vector<uint32_t> triangles;                  ///< 3 points per triangle, counter-clockwise about the normal

  size_t polygonCount() const { return polygonRegion.size(); }

  static void fields(auto& self, const auto& f) {
    f("positions", self.positions);
    f("loopOffsets", self.loopOffsets);
    f("loopPoints", self.loopPoints);
    f("polygonLoopOffsets", self.polygonLoopOffsets);
    f("polygonCell", self.polygonCell);
    f("polygonGridCell", self.polygonGridCell);
    f("polygonRegion", self.polygonRegion);
    f("polygonTriangleOffsets", self.polygonTriangleOffsets);
    f("triangles", self.triangles);
  }
};

/// Which vertices lie on which side is decided exactly and once for all cells. Those on the plane count as above it (below it if nothing
/// else is): the result is that of a plane moved by an infinitesimal, so a plane through vertices, edges or faces still cuts everything
/// exactly once. Polygons that have no width on the plane itself may be left out. A plane that misses the grid cuts nothing. Throws
/// CallError for a normal that is zero or not finite (element: the axis) and an offset that is not finite (element: which).
Slice slice(const CutMesh& cutMesh, const Plane& plane, const SliceOptions& options = {});

/// The slices of parallel planes, each as slice() gives it, in the order of their offsets, for less than many calls cost.
std::vector<Slice> slices(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets,
                          const SliceOptions& options = {});

/// The outlines of regions in a plane: each region's polygons of Slice as one, without the seams between cells and with untouched grid
/// cells. What is left is where the surface is cut, and where the grid's box ends. A point lies where an edge of the input is cut, where
/// the surface meets the box, or on an edge of the box; none where only a plane of the grid was crossed. Points are shared by the outlines
/// of neighbouring regions.
///
/// Where the surface has one region on both sides (an open sheet, or a mesh with a hole in it) it is no outline but a slit: a polyline,
/// from point to point with the triangles' normals to its right; the first point again at the end of one that is closed. Slits end where
/// the surface ends, meets others or turns its normals around.
struct Outlines {
  std::vector<double> positions;                ///< 3 per point, on the plane, world units
  std::vector<uint32_t> loopOffsets{0};         ///< into loopPoints
  std::vector<uint32_t> loopPoints;             ///< points of the loops
  std::vector<uint32_t> polygonLoopOffsets{0};  ///< into loops, per polygon: an outer one, counter-clockwise about the normal, then holes
  std::vector<uint32_t> polygonRegion;          ///< per polygon: region, ascending
  std::vector<uint32_t> slitOffsets{0};         ///< into slitPoints
  std::vector<uint32_t> slitPoints;             ///< points of the slits
  std::vector<uint32_t> slitRegion;             ///< per slit: region around it, ascending

  size_t polygonCount() const { return polygonRegion.size(); }
  size_t slitCount() const { return slitRegion.size(); }

  static void fields(auto& self, const auto& f) {
    f("positions", self.positions);
    f("loopOffsets", self.loopOffsets);
    f("loopPoints", self.loopPoints);
    f("polygonLoopOffsets", self.polygonLoopOffsets);
    f("polygonRegion", self.polygonRegion);
    f("slitOffsets", self.slitOffsets);
    f("slitPoints", self.slitPoints);
    f("slitRegion", self.slitRegion);
  }
};

/// With the rules and errors of slice().
Outlines outlines(const CutMesh& cutMesh, const Plane& plane);
/// Those of parallel planes, in the order of their offsets.
std::vector<Outlines> outlines(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets);

/// Axes for drawing what lies in a plane: unit vectors along it, with right x up in the direction of the normal. If the normal is along an
/// axis of the grid, so are they.
struct PlaneAxes {
  std::array<double, 3> right, up;
};
/// Throws CallError for a normal that is zero or not finite.
PlaneAxes planeAxes(const std::array<double, 3>& normal);

}  // namespace mandoline
