// Winding numbers at a point, exactly: where the steps from region to region begin.
#pragma once

#include "cut/counted.h"

namespace mandoline::detail {

/// What a triangle adds to the winding number, of those counted, about the point (x + e^3, y + e, z + e^2) beside `corner` (x, y, z), where
/// e is arbitrarily small: the sign of its crossing with the ray from there to -x, times its copies.
int32_t windingBeside(const Point& corner, const Prepared& mesh, const Counted& counted, TriangleId triangle, Predicates& predicates);

/// The sums over the kept ones of some triangles, one for each of countedOf(mesh).
template <class TriangleIds>
std::vector<int32_t> windingsBeside(const Point& corner, const Prepared& mesh, const TriangleIds& triangles, Predicates& predicates) {
  std::vector<int32_t> windings;
  for (const Counted& counted : countedOf(mesh)) {
    int32_t winding = 0;
    for (const auto t : triangles) {
      const TriangleId triangle{t};
      if (mesh.kept(triangle)) winding += windingBeside(corner, mesh, counted, triangle, predicates);
    }
    windings.push_back(winding);
  }
  return windings;
}

}  // namespace mandoline::detail
