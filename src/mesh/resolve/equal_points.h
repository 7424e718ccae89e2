// Points at one place: a made point may be made in several ways, or be where a tri-vertex is.
#pragma once

#include "mesh/resolve/mesh_points.h"

namespace mandoline::detail {

/// Per point the lowest one at its place, among the made points and the given tri-vertices; the others keep their own.
std::vector<uint32_t> findEqualPoints(const MeshPoints& points, const std::vector<uint32_t>& triVertices, Predicates& predicates);

}  // namespace mandoline::detail
