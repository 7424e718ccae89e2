// What is inside by a rule.
#pragma once

#include <algorithm>
#include <cmath>

#include "mandoline/inside.h"

namespace mandoline::operators {

inline bool isInside(int32_t winding, WindingRule rule) {
  return rule == WindingRule::positive ? winding > 0 : rule == WindingRule::nonZero ? winding != 0 : winding % 2 != 0;
}

/// The same with parts that have parity alone: `parity` is that of all.
inline bool isInside(int32_t winding, bool parity, WindingRule rule) {
  return rule == WindingRule::odd ? parity : isInside(winding, rule) || parity != (winding % 2 != 0);
}

/// The winding number that an estimate counts as.
inline int32_t roundedWinding(double estimate, double threshold) {
  const double size = std::floor(std::min(std::fabs(estimate), 1e9) + (1 - threshold));
  return int32_t(estimate < 0 ? -size : size);
}

/// Throws CallError unless it is above 0 and at most 1.
inline void requireThreshold(double threshold) {
  if (!(threshold > 0 && threshold <= 1)) throw CallError({Status::badOption, -1, -1, "threshold must be above 0 and at most 1."});
}

}  // namespace mandoline::operators
