// The kept triangles of a mesh in an order in which neighbours are mostly near in memory, whatever the order in which they were given.
#pragma once

#include "mesh/welded_mesh.h"

namespace mandoline::detail {

struct SortedMesh {
  std::vector<Point> points;                       ///< along a space-filling curve
  std::vector<std::array<uint32_t, 3>> triangles;  ///< places in `points`; ascending by the lowest of them
  std::vector<uint32_t> ids;                       ///< of the triangles

  explicit SortedMesh(const WeldedMesh& mesh);
};

}  // namespace mandoline::detail
