#include "operators/slice/box_cut.h"

#include <algorithm>

namespace mandoline::operators {

/// From the edge on which the side's outline goes down to that on which it goes up.
BoxCut::Way BoxCut::findWay(int side, uint8_t above) {
  const int axis = side / 2, upper = side % 2, u = 1 << (axis + 2 - upper) % 3, v = 1 << (axis + 1 + upper) % 3, base = upper << axis;
  const std::array<int, 4> corners = {base, base + u, base + u + v, base + v};
  Way way;
  for (size_t i = 0; i < 4; ++i) {
    const int a = corners[i], b = corners[(i + 1) % 4];
    if ((above >> a & 1) != (above >> b & 1)) ((above >> a & 1) != 0 ? way.start : way.end) = uint8_t(8 * std::min(a, b) + std::max(a, b));
  }
  return way;
}

BoxCut::BoxCut(uint8_t above) {
  std::array<uint8_t, 64> next{};
  uint8_t start = kNone;
  for (int side = 0; side < 6; ++side) {
    const Way way = ways_[size_t(side)] = findWay(side, above);
    if (way.start == kNone) continue;
    start = way.start;
    next[start] = way.end;
  }
  if (start == kNone) return;
  uint8_t edge = start;
  do {
    edges_[edgeCount_++] = edge;
    edge = next[edge];
  } while (edge != start && edgeCount_ < edges_.size());
}

const BoxCut& BoxCuts::operator[](uint8_t above) {
  uint8_t& place = places_[above];
  if (place == 0) {
    cuts_.emplace_back(above);
    place = uint8_t(cuts_.size());
  }
  return cuts_[place - 1u];
}

}  // namespace mandoline::operators
