// Winding numbers at a point, exactly: where the steps from region to region begin.
#pragma once

#include "cut/counted.h"

namespace mandoline::detail {

/// What a triangle adds to the winding number, of those counted, about the point (x + e^3, y + e, z + e^2) beside `corner` (x, y, z), where
/// e is arbitrarily small: the sign of its crossing with the ray from there to -x, times its copies.
int32_t windingBeside(const Point& corner, const Prepared& mesh, const Counted& counted, TriangleId triangle, Predicates& predicates);

}  // namespace mandoline::detail
