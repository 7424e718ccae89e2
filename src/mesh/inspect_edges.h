// What inspect() finds of edges: components, closed or not, and defects.
#pragma once

#include "mandoline/inspect.h"
#include "mesh/edge_uses.h"

namespace mandoline::detail {

/// Sets all of `info` that is about edges. `triangles` are those of the mesh, whose vertices are the lowest at their positions.
void inspectEdges(const MeshView& mesh, const std::vector<Corners>& triangles, MeshInfo& info);

}  // namespace mandoline::detail
