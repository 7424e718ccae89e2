// Points at one place: a made point may be made in several ways, or be where a tri-vertex is.
#pragma once

#include "mesh/resolve/mesh_points.h"

namespace mandoline::detail {

/// For each made point and given tri-vertex, the lowest of them at its place; for other points, themselves.
std::vector<uint32_t> findEqualPoints(const MeshPoints& points, const std::vector<uint32_t>& triVertices, Predicates& predicates);

}  // namespace mandoline::detail
