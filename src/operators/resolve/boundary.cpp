#include <algorithm>

#include "mandoline/coarsen.h"
#include "mandoline/resolve.h"
#include "operators/cell_complex/grid_corners.h"
#include "operators/measure/owners.h"
#include "operators/mesh_writer.h"
#include "operators/require_cut_mesh.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline {
namespace {

bool isInside(int32_t winding, WindingRule rule) {
  return rule == WindingRule::positive ? winding > 0 : rule == WindingRule::nonZero ? winding != 0 : winding % 2 != 0;
}

void requireWinding(bool hasWinding) {
  if (!hasWinding) operators::refuse("The mesh is open or not consistently oriented, so that nothing is inside.");
}

/// Refuses arrays that don't fit together, as far as boundary() reads them.
void requireArrays(const ResolvedMesh& resolved) {
  const Mesh& mesh = resolved.mesh;
  const size_t n = mesh.triangleCount();
  const bool isWhole = mesh.positions.size() % 3 == 0 && mesh.triangles.size() % 3 == 0;
  const bool hasVertices = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](uint32_t v) { return v < mesh.vertexCount(); });
  if (!isWhole || !hasVertices || resolved.frontWinding.size() != n || resolved.backWinding.size() != n) {
    operators::refuse("The arrays of the resolved mesh don't fit together.");
  }
}

/// The sum of the boundaries of the cells inside of a solid: what two of them share cancels.
class SolidBoundary {
 public:
  SolidBoundary(const CutMesh& cutMesh, WindingRule rule) : cutMesh_(cutMesh), positions_(cutMesh.positions), triangulator_(positions_) {
    for (const int32_t winding : cutMesh.regionWinding) isInside_.push_back(isInside(winding, rule));
  }

  Mesh run() {
    addCutFaces();
    if (hasGridCellsAtSides()) addSides();
    Mesh result;
    operators::MeshWriter writer(positions_, result);
    for (size_t t = 0; t < triangles_.size(); t += 3) writer.add(&triangles_[t], false);
    return result;
  }

 private:
  /// The pieces of triangles and of the grid's sides that cut-cells have.
  void addCutFaces() {
    const std::vector<int32_t> owners = operators::ownersOf(cutMesh_);
    const auto isInsideAt = [&](size_t halfFace) {  // nothing is beyond the grid
      return owners[halfFace] >= 0 && isInside_[cutMesh_.cellRegion[size_t(owners[halfFace])]];
    };
    for (size_t f = 0; f < cutMesh_.faceCount(); ++f) {
      const Face face = cutMesh_.face(f);
      const bool isBetweenRegions = face.triangle >= 0 || face.plane == 0 || face.plane == cutMesh_.grid.cells(face.axis);
      const bool back = isInsideAt(2 * f), front = isInsideAt(2 * f + 1);
      if (isBetweenRegions && front != back) triangulator_.runOutwards(face, front ? 1 : 0, triangles_);
    }
  }

  bool hasGridCellsAtSides() const {
    const int64_t nx = cutMesh_.grid.cells(0), ny = cutMesh_.grid.cells(1), nz = cutMesh_.grid.cells(2);
    bool has = false;
    UntouchedCells(cutMesh_).forEach([&](const UntouchedCells::Run& run) {
      const bool atSide = run.begin == 0 || run.end == nx || run.j == 0 || run.j == ny - 1 || run.k == 0 || run.k == nz - 1;
      has |= atSide && isInside_[run.region];
    });
    return has;
  }

  /// The grid's sides where untouched grid cells are, in squares as large as octree cells.
  void addSides() {
    const OctreeCells octree = coarsen(cutMesh_);
    const operators::GridCorners corners(cutMesh_, octree);
    for (const operators::GridIndex& corner : corners.added()) {
      for (size_t d = 0; d < 3; ++d) positions_.push_back(cutMesh_.grid.planes[d][size_t(corner[d])]);
    }
    std::vector<uint32_t> loop;
    for (size_t c = 0; c < octree.cellCount(); ++c) {
      if (!isInside_[octree.cellRegion[c]]) continue;
      const auto low = octree.corner(c), high = octree.end(c);
      for (size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          const int32_t plane = (side ? high : low)[axis];
          if (plane != (side ? octree.gridCells[axis] : 0)) continue;
          loop.clear();
          corners.appendSide(c, axis, side, loop);
          const uint32_t offsets[] = {0, uint32_t(loop.size())};
          triangulator_.runOutwards({-1, int32_t(axis), plane, Loops(offsets, 1, loop.data())}, side ? 0 : 1, triangles_);
        }
      }
    }
  }

  const CutMesh& cutMesh_;
  std::vector<double> positions_;  // of cut-vertices, and of corners of octree cells
  operators::FaceTriangulator triangulator_;
  std::vector<uint8_t> isInside_;    // per region
  std::vector<uint32_t> triangles_;  // oriented outwards
};

}  // namespace

Mesh boundary(const ResolvedMesh& mesh, WindingRule rule) {
  requireWinding(mesh.hasWinding);
  requireArrays(mesh);
  Mesh result;
  operators::MeshWriter writer(mesh.mesh.positions, result);
  for (size_t t = 0; t < mesh.mesh.triangleCount(); ++t) {
    const bool front = isInside(mesh.frontWinding[t], rule), back = isInside(mesh.backWinding[t], rule);
    if (front != back) writer.add(&mesh.mesh.triangles[3 * t], front);
  }
  return result;
}

Mesh boundary(const CutMesh& cutMesh, WindingRule rule) {
  operators::requireCutMesh(cutMesh);
  requireWinding(cutMesh.hasWinding);
  return SolidBoundary(cutMesh, rule).run();
}

}  // namespace mandoline
