// An order in which what is near in space is mostly near in memory.
#pragma once

#include <span>
#include <vector>

#include "base/csr.h"
#include "base/function_ref.h"
#include "base/point.h"

namespace mandoline::detail {

/// The order of points along a space-filling curve (Morton 1966): sorted by the interleaved bits of their coordinates, relative to the
/// box around them. Of equal points, the one with the lower idOf(i) comes first. Coordinates that are not finite are taken as 0.
std::vector<KeyedItem> orderAlongCurve(std::span<const Point> points, FunctionRef<uint32_t(size_t)> idOf);

}  // namespace mandoline::detail
