// Which shells of a mesh lie inside others, by exact rays.
#pragma once

#include "base/parallel.h"
#include "mesh/orient/parts.h"
#include "mesh/welded_mesh.h"

namespace mandoline::detail {

struct Nesting {
  std::vector<uint8_t> isInside;  ///< per part: whether its shell lies inside an odd number of others, none of which it crosses
  /// Per part of a shell of several, else 0: 1 if the normals of its triangles, turned as `parts` has them, point away from where a ray
  /// leaves through an odd number of the shell's triangles, -1 if they point there; 0 if other triangles lie on all of its own.
  std::vector<int8_t> facing;
};

Nesting findNesting(const WeldedMesh& mesh, const Parts& parts, const Shells& shells, Monitor& monitor, Predicates& predicates);

}  // namespace mandoline::detail
