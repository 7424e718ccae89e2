// Random meshes on a coarse lattice, where vertices, edges and triangles lie on planes, grid lines and each other all the time, and an
// exact word on whether such a mesh intersects itself. Shared by the fuzz target and the test that replays its finds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mandoline/mandoline.h"

struct LatticeCase {
  using Point = std::array<int64_t, 3>;
  std::vector<std::array<Point, 3>> triangles;  ///< unwelded
  bool intersects = false;                      ///< whether two triangles with area meet other than in a common vertex or edge
  mandoline::Mesh mesh;
  mandoline::Grid grid;
};

/// Makes a mesh of single triangles, sheets and closed shapes with coordinates 0..9 and a grid of up to 10 x 10 x 10 cells. Any bytes will
/// do.
LatticeCase decodeLattice(const uint8_t* bytes, size_t size);

/// Cuts, validates, estimates what is inside and orients. Empty if the promises hold: any triangles are cut, the results are valid, the
/// boundary of what is inside is closed, and oriented triangles agree. Otherwise what is wrong, followed by the mesh as OBJ and the grid's
/// planes.
std::string brokenPromise(const LatticeCase& latticeCase);
