// A point in space.
#pragma once

#include <array>

namespace mandoline::detail {

using Point = std::array<double, 3>;

}  // namespace mandoline::detail
