// How a plane cuts the box of a grid cell, by the side of the plane that each corner lies on.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mandoline::operators {

/// Corner: bit d is set on the upper plane of axis d. Edge: 8 * its lower corner + its upper one. Side: 2 * axis + (1 if it is the upper).
class BoxCut {
 public:
  static constexpr uint8_t kNone = 255;

  /// On a side that is cut, with the inside of the box to its left: the edge on which the way starts and that on which it ends.
  struct Way {
    uint8_t start = kNone, end = kNone;
  };

  /// Bit c of `above` tells whether corner c is above the plane.
  explicit BoxCut(uint8_t above);

  const Way& wayOn(int side) const { return ways_[size_t(side)]; }
  /// The edges that are cut, in the order of the outline.
  std::span<const uint8_t> outline() const { return {edges_.data(), edgeCount_}; }

 private:
  static Way findWay(int side, uint8_t above);

  std::array<Way, 6> ways_;
  std::array<uint8_t, 6> edges_{};
  size_t edgeCount_ = 0;
};

/// All of them, each made when it is asked for.
class BoxCuts {
 public:
  const BoxCut& operator[](uint8_t above);

 private:
  std::array<uint8_t, 256> places_{};  // in cuts_, + 1
  std::vector<BoxCut> cuts_;
};

}  // namespace mandoline::operators
