// Vertices by their positions.
#pragma once

#include "base/position_table.h"

namespace mandoline::detail {

/// Positions of vertices by their place in an array.
struct PositionOf {
  const double* positions;

  const double* operator()(uint32_t v) const { return positions + 3 * size_t(v); }
};
using Places = PositionTable<PositionOf>;

/// The first of the vertices with these positions, which have to outlive it, that takesPart(v), at each position.
template <class TakesPart>
Places placesOf(const std::vector<double>& positions, const TakesPart& takesPart) {
  const PositionOf at{positions.data()};
  const size_t count = positions.size() / 3;
  Places places(count, at);
  for (uint32_t v = 0; v < count; ++v) {
    if (!takesPart(v)) continue;
    uint32_t& place = places.find(at(v));
    if (place == Places::kFree) place = v;
  }
  return places;
}
inline Places placesOf(const std::vector<double>& positions) {
  return placesOf(positions, [](uint32_t) { return true; });
}

/// Finds at which of some positions, which have to outlive it, vertices are: of each the first that comes.
class FirstAt {
 public:
  explicit FirstAt(const std::vector<double>& positions)
      : at_{positions.data()}, places_(placesOf(positions)), first_(positions.size() / 3, Places::kFree) {}

  void add(uint32_t vertex, const double* p) {
    const uint32_t place = places_.find(p);
    if (place != Places::kFree && first_[place] == Places::kFree) first_[place] = vertex;
  }
  bool has(const double* p) { return places_.find(p) != Places::kFree; }
  /// Per position the first vertex, or 2^32 - 1.
  std::vector<uint32_t> first() {
    std::vector<uint32_t> all;
    for (uint32_t i = 0; i < first_.size(); ++i) all.push_back(first_[places_.find(at_(i))]);
    return all;
  }

 private:
  const PositionOf at_;
  Places places_;
  std::vector<uint32_t> first_;
};

}  // namespace mandoline::detail
