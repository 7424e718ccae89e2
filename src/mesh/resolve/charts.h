// Parts of a mesh that can't meet themselves, found without comparing triangles.
//
// A chart is a set of triangles that an axial projection lays out side by side. Each triangle keeps its orientation. The outline, which is
// all sides but those that two triangles of the chart traverse in opposite directions, goes once around a centre, and each of its sides
// goes counter-clockwise. So every ray from the centre meets the outline once: it does not touch itself, and its winding number about any
// other point, which is how many triangles cover that, is 1 or 0. (Volino and Magnenat-Thalmann 1994, "Efficient self-collision detection
// on smoothly discretized surface animations using geometrical shape regularity", look for such parts, too.)
#pragma once

#include "mesh/resolve/sorted_mesh.h"

namespace mandoline::detail {

struct Charts {
  size_t count;
  std::vector<uint32_t> chartOf;  ///< each triangle; numbered in the order of their first ones
};

/// Two triangles of a chart have nothing in common but shared vertices and whole shared sides.
Charts findCharts(const SortedMesh& mesh);

}  // namespace mandoline::detail
