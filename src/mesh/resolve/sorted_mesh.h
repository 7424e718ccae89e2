// The kept triangles of a mesh, each once, reordered so that neighbours are mostly near each other in memory.
#pragma once

#include "base/large_array.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

struct SortedMesh {
  LargeVector<Point> points;                       ///< along a space-filling curve
  LargeVector<std::array<uint32_t, 3>> triangles;  ///< places in `points`; ascending by the lowest of them
  LargeVector<uint32_t> ids;                       ///< of the triangles

  explicit SortedMesh(const WeldedMesh& mesh) : SortedMesh(mesh, mesh.states) {}
  /// With other states than the mesh's own. Duplicates need not be known yet.
  SortedMesh(const WeldedMesh& mesh, const std::vector<TriangleState>& states);
  /// The same of some of its triangles, which ascend.
  SortedMesh(const WeldedMesh& mesh, const std::vector<uint32_t>& some);

 private:
  void dropDuplicates(const std::vector<uint32_t>& ends);
};

}  // namespace mandoline::detail
