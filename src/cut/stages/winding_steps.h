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

/// The steps at faces, for each of `counted`.
class FaceSteps {
 public:
  FaceSteps(const Input& input, const FaceParents& parents, const std::vector<Counted>& counted)
      : parents_(parents), counted_(counted), areAlike_(input.mesh->closed && parents.areSingle()) {}

  /// Whether they are the same for all faces.
  bool areAlike() const { return areAlike_; }
  std::array<int32_t, 2> at(FaceId face) const {
    if (areAlike_) return {1, 0};
    std::array<int32_t, 2> steps{};
    parents_.forEach(face, [&](TriangleId t, bool sameWay) {
      for (size_t i = 0; i < counted_.size(); ++i) steps[i] += !counted_[i].has(t) ? 0 : sameWay ? 1 : -1;
    });
    return steps;
  }

 private:
  const FaceParents parents_;
  const std::vector<Counted>& counted_;
  const bool areAlike_;
};

}  // namespace mandoline::detail
