// Cuts a mesh, requires that the result is complete and valid, and answers what the tests ask about it.
#pragma once

#include <functional>
#include <vector>

#include "mandoline/mandoline.h"
#include "mandoline/measure.h"
#include "mandoline/validate.h"

struct CheckedCut {
  mandoline::CutMesh mesh;
  mandoline::CutStats stats;
  mandoline::Measures measures;

  size_t cells() const { return mesh.cellCount() + mandoline::UntouchedCells(mesh).count(); }
  double volume() const;                                     ///< of all regions
  std::vector<double> regionVolumes() const;                 ///< ascending
  double windingVolume(int winding) const;                   ///< of the regions with this winding number
  std::vector<double> volumesIn(int i, int j, int k) const;  ///< of the cut-cells in a grid cell, ascending
  size_t facesWithHoles() const;
  /// Faces in an axial plane: pieces of grid-faces and coplanar triangles; those with at least `holes` holes.
  size_t facesIn(int axis, int plane, size_t holes = 0) const;
};

/// Requires status ok, a passing validate(), the grid's volume, no face twice.
CheckedCut checkedCut(const mandoline::Mesh& mesh, const mandoline::Grid& grid, const mandoline::CutOptions& options = {});

/// Runs `body` with the mesh's cut (orientation 1) and with that of the flipped mesh (orientation -1).
void atBothOrientations(const mandoline::Mesh& mesh, const mandoline::Grid& grid,
                        const std::function<void(const CheckedCut&, int orientation)>& body);

/// n x n x n unit cells from the origin.
inline mandoline::Grid unitGrid(int64_t nx, int64_t ny, int64_t nz) {
  return mandoline::Grid::box({0, 0, 0}, {double(nx), double(ny), double(nz)}, {nx, ny, nz});
}
inline mandoline::Grid unitGrid(int64_t n) { return unitGrid(n, n, n); }

/// Whether two ascending lists agree up to rounding.
bool near(const std::vector<double>& a, const std::vector<double>& b, double tolerance = 1e-12);
