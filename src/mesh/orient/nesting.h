// Which shells of a mesh lie inside others, by exact rays.
#pragma once

#include "base/parallel.h"
#include "mesh/orient/patches.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

struct Nesting {
  std::vector<uint8_t> isInside;  ///< per patch: whether its shell lies inside an odd number of others, none of which it crosses
  /// Per patch of a shell of several, else 0: 1 if the normals of its triangles, turned as `patches` has them, point away from where a ray
  /// leaves through an odd number of the shell's triangles, -1 if they point there; 0 if other triangles lie on all of its own.
  std::vector<int8_t> facing;
};

Nesting findNesting(const WeldedMesh& mesh, const Patches& patches, const Shells& shells, Monitor& monitor, Predicates& predicates);

}  // namespace mandoline::detail
