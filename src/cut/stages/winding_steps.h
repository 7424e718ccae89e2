// How winding numbers and parity change from one side of a tri-cut-face to the other.
#pragma once

#include <tuple>

#include "cut/counted.h"
#include "cut/stages/face_parents.h"

namespace mandoline::detail {

/// From the front of a tri-cut-face to behind it.
struct WindingStep {
  uint32_t behind, inFront;      ///< components of a brick, or regions
  std::array<int32_t, 2> steps;  ///< per Counted

  bool operator==(const WindingStep&) const = default;
  bool operator<(const WindingStep& other) const {
    return std::tie(behind, inFront, steps) < std::tie(other.behind, other.inFront, other.steps);
  }
};

/// The step at a face, for each of `counted`.
inline std::array<int32_t, 2> stepsAt(FaceId face, const FaceParents& parents, const std::vector<Counted>& counted) {
  std::array<int32_t, 2> steps{};
  parents.forEach(face, [&](TriangleId t, bool sameWay) {
    for (size_t i = 0; i < counted.size(); ++i) steps[i] += !counted[i].has(t) ? 0 : sameWay ? 1 : -1;
  });
  return steps;
}

}  // namespace mandoline::detail
