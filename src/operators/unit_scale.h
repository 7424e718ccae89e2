// Scaling by a power of two, which changes no digit.
#pragma once

#include <algorithm>
#include <cmath>

namespace mandoline::operators {

/// The exponent of the power of two that brings numbers up to `largest` near 1, so that their products neither over- nor underflow.
inline int unitExponent(double largest) { return largest > 0 ? std::clamp(-std::ilogb(largest), -1000, 1000) : 0; }

}  // namespace mandoline::operators
