#include <algorithm>

#include "mandoline/coarsen.h"
#include "mandoline/resolve.h"
#include "operators/cell_complex/grid_corners.h"
#include "operators/inside/inside_rule.h"
#include "operators/measure/owners.h"
#include "operators/mesh_writer.h"
#include "operators/require_cut_mesh.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline {
namespace {

/// Refuses arrays that don't fit together, as far as boundary() reads them.
void requireArrays(const ResolvedMesh& resolved) {
  const Mesh& mesh = resolved.mesh;
  const size_t n = mesh.triangleCount();
  const bool isWhole = mesh.positions.size() % 3 == 0 && mesh.triangles.size() % 3 == 0;
  const bool hasVertices = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](uint32_t v) { return v < mesh.vertexCount(); });
  const size_t winding = resolved.hasWinding ? n : 0, partWinding = resolved.frontPartWinding.empty() ? 0 : n;
  const size_t parity = resolved.frontParity.empty() ? 0 : n;
  const bool haveLengths = resolved.frontWinding.size() == winding && resolved.backWinding.size() == winding &&
                           resolved.frontPartWinding.size() == partWinding && resolved.backPartWinding.size() == partWinding &&
                           resolved.frontParity.size() == parity && resolved.backParity.size() == parity;
  if (!isWhole || !hasVertices || !haveLengths) operators::refuse("The arrays of the resolved mesh don't fit together.");
  if (resolved.hasWinding || parity > 0 || n == 0) return;
  operators::refuse(
      "No part of the mesh is closed, so that nothing is inside for certain. Close it, or cut it, estimate with estimateInside(), and take "
      "the boundary of that.");
}

/// Whether a triangle has the inside in front of it, or behind it.
std::array<bool, 2> isInsideAt(const ResolvedMesh& mesh, size_t t, WindingRule rule) {
  if (mesh.hasWinding) return {operators::isInside(mesh.frontWinding[t], rule), operators::isInside(mesh.backWinding[t], rule)};
  const bool hasPart = !mesh.frontPartWinding.empty();
  return {operators::isInside(hasPart ? mesh.frontPartWinding[t] : 0, mesh.frontParity[t] != 0, rule),
          operators::isInside(hasPart ? mesh.backPartWinding[t] : 0, mesh.backParity[t] != 0, rule)};
}

/// The sum of the boundaries of the cells inside of a solid: what two of them share cancels.
class SolidBoundary {
 public:
  SolidBoundary(const CutMesh& cutMesh, std::span<const uint8_t> isInside)
      : cutMesh_(cutMesh), positions_(cutMesh.positions), triangulator_(positions_), isInside_(isInside) {}

  Mesh run() {
    addCutFaces();
    if (hasGridCellsAtSides() || hasEstimates()) addSides();
    Mesh result;
    operators::MeshWriter writer(positions_, result);
    for (size_t t = 0; t < triangles_.size(); t += 3) writer.add(&triangles_[t], false);
    return result;
  }

 private:
  /// The pieces of triangles and of the grid's sides that cut-cells have.
  void addCutFaces() {
    const std::vector<int32_t> owners = operators::ownersOf(cutMesh_);
    const auto isInsideAt = [&](size_t halfFace) {
      const int32_t cell = owners[halfFace];
      return cell >= 0 ? isInside_[cutMesh_.cellRegion[size_t(cell)]] != 0 : isInsideBeyond(halfFace, owners[halfFace ^ 1]);
    };
    for (size_t f = 0; f < cutMesh_.faceCount(); ++f) {
      const Face face = cutMesh_.face(f);
      const bool isBetweenRegions = face.triangle >= 0 || face.plane == 0 || face.plane == cutMesh_.grid.cells(face.axis) || hasEstimates();
      if (!isBetweenRegions) continue;
      const bool back = isInsideAt(2 * f), front = isInsideAt(2 * f + 1);
      if (front != back) triangulator_.runOutwards(face, front ? 1 : 0, triangles_);
    }
  }

  /// Of a half-face that no cut-cell has: whether the untouched grid cell there is inside. Nothing is beyond the grid.
  bool isInsideBeyond(size_t halfFace, int32_t cellOpposite) const {
    const int8_t axis = cutMesh_.faceAxis[halfFace / 2];
    if (cellOpposite < 0 || axis < 0) return false;
    const int32_t* gridCell = &cutMesh_.cellGridCell[3 * size_t(cellOpposite)];
    operators::GridIndex at = {gridCell[0], gridCell[1], gridCell[2]};
    at[size_t(axis)] = 2 * cutMesh_.facePlane[halfFace / 2] - 1 - at[size_t(axis)];  // the plane's index is that of the cell above it
    const int64_t region = UntouchedCells(cutMesh_).regionAt(at[0], at[1], at[2]);
    return region >= 0 && isInside_[size_t(region)];
  }

  /// Regions end at triangles and at the grid's sides; with estimates, at any grid-face.
  bool hasEstimates() const { return !cutMesh_.regionInsideness.empty(); }

  bool hasGridCellsAtSides() const {
    const int64_t nx = cutMesh_.grid.cells(0), ny = cutMesh_.grid.cells(1), nz = cutMesh_.grid.cells(2);
    bool has = false;
    UntouchedCells(cutMesh_).forEach([&](const UntouchedCells::Run& run) {
      const bool atSide = run.begin == 0 || run.end == nx || run.j == 0 || run.j == ny - 1 || run.k == 0 || run.k == nz - 1;
      has |= atSide && isInside_[run.region];
    });
    return has;
  }

  /// The grid's sides where untouched grid cells are, in squares as large as octree cells, and those of their other sides that lie between
  /// regions.
  void addSides() {
    CoarsenOptions coarsening;
    coarsening.layersPerLevel = 1;  // more are for what computes on the cells, and here only make more squares
    const OctreeCells octree = coarsen(cutMesh_, coarsening);
    operators::GridCorners corners(cutMesh_, octree);
    corners.setPlaces();
    corners.linkCutVertices();
    corners.appendPositions(positions_);
    for (size_t c = 0; c < octree.cellCount(); ++c) {
      if (!isInside_[octree.cellRegion[c]]) continue;
      for (size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) addSide(octree, corners, c, axis, side);
      }
    }
  }

  /// The side of an octree cell inside, or the sides of smaller ones there that are outside.
  void addSide(const OctreeCells& octree, const operators::GridCorners& corners, size_t cell, size_t axis, int side) {
    const operators::GridIndex low = octree.corner(cell), high = octree.end(cell);
    const int32_t plane = (side ? high : low)[axis];
    if (plane == (side ? octree.gridCells[axis] : 0)) return addSquare(corners, cell, axis, side, true);
    if (!hasEstimates()) return;
    operators::GridIndex at = low;
    at[axis] = side ? high[axis] : low[axis] - 1;
    const int32_t half = octree.cellLevel[cell] > 0 ? 1 << (octree.cellLevel[cell] - 1) : 0;  // cells beyond are at most one level smaller
    for (int quarter = 0; quarter < (half > 0 ? 4 : 1); ++quarter) {
      operators::GridIndex beyond = at;
      beyond[(axis + 1) % 3] += (quarter & 1) * half;
      beyond[(axis + 2) % 3] += (quarter >> 1) * half;
      const int64_t other = octree.find(beyond[0], beyond[1], beyond[2]);  // cut-cells have the faces towards them
      if (other < 0 || isInside_[octree.cellRegion[size_t(other)]]) continue;
      if (octree.cellLevel[size_t(other)] < octree.cellLevel[cell]) {
        addSquare(corners, size_t(other), axis, 1 - side, false);
      } else {
        return addSquare(corners, cell, axis, side, true);
      }
    }
  }

  /// A side of an octree cell, whether that is inside or what lies beyond.
  void addSquare(const operators::GridCorners& corners, size_t cell, size_t axis, int side, bool isInside) {
    std::vector<uint32_t> loop;
    corners.appendSide(cell, corners.ofCell(cell), axis, side, loop);
    const uint32_t offsets[] = {0, uint32_t(loop.size())};
    triangulator_.runOutwards({-1, int32_t(axis), 0, Loops(offsets, 1, loop.data())}, (side != 0) == isInside ? 0 : 1, triangles_);
  }

  const CutMesh& cutMesh_;
  std::vector<double> positions_;  // of cut-vertices, and of corners of octree cells
  operators::FaceTriangulator triangulator_;
  std::span<const uint8_t> isInside_;  // per region
  std::vector<uint32_t> triangles_;    // oriented outwards
};

}  // namespace

Mesh boundary(const ResolvedMesh& mesh, WindingRule rule) {
  requireArrays(mesh);
  Mesh result;
  operators::MeshWriter writer(mesh.mesh.positions, result);
  for (size_t t = 0; t < mesh.mesh.triangleCount(); ++t) {
    const auto [front, back] = isInsideAt(mesh, t, rule);
    if (front != back) writer.add(&mesh.mesh.triangles[3 * t], front);
  }
  return result;
}

Mesh boundary(const CutMesh& cutMesh, WindingRule rule) { return boundary(cutMesh, insideRegions(cutMesh, {rule}).isInside); }

Mesh boundary(const CutMesh& cutMesh, std::span<const uint8_t> isInside) {
  operators::requireCutMesh(cutMesh);
  if (isInside.size() != cutMesh.regionCount) {
    operators::refuse("Which regions are inside must be told for each of the " + std::to_string(cutMesh.regionCount) + ", not for " +
                      std::to_string(isInside.size()) + ".");
  }
  return SolidBoundary(cutMesh, isInside).run();
}

}  // namespace mandoline
