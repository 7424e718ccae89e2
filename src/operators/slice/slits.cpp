#include "operators/slice/slits.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/sort.h"

namespace mandoline::operators {

const detail::Csr<uint32_t>& Slits::remove(const detail::Csr<uint32_t>& loops, std::span<const uint32_t> polygon,
                                           const std::vector<PlanePoint>& at) {
  if (polygon.size() == 1 && !mayHaveAny(loops[polygon[0]])) {
    loops_.offsets = {0, uint32_t(loops[polygon[0]].size())};
    loops_.items.assign(loops[polygon[0]].begin(), loops[polygon[0]].end());
    return loops_;
  }
  arcs_.clear();
  for (const uint32_t l : polygon) addLoop(loops[l]);
  removePairs();
  trace(at);
  return loops_;
}

/// A loop with edges in both directions has only two points, or comes to a point twice.
bool Slits::mayHaveAny(std::span<const uint32_t> loop) {
  ++round_;
  for (const uint32_t p : loop) {
    if (lastRound_.size() <= p) lastRound_.resize(p + 1, 0);
    if (std::exchange(lastRound_[p], round_) == round_) return true;
  }
  return loop.size() < 3;
}

void Slits::addLoop(std::span<const uint32_t> points) {
  const uint32_t first = uint32_t(arcs_.size()), count = uint32_t(points.size());
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    arcs_.push_back({points[i], points[next], first + (i + count - 1) % count, first + next});
  }
}

/// Finds pairs of opposite arcs: next to each other when sorted by their points.
void Slits::removePairs() {
  order_.resize(arcs_.size());
  for (uint32_t a = 0; a < arcs_.size(); ++a) order_[a] = a;
  const auto key = [&](uint32_t a) { return std::minmax(arcs_[a].start, arcs_[a].end); };
  detail::sortItems(order_, [&](uint32_t a, uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (size_t begin = 0, end; begin < order_.size(); begin = end) {
    end = begin + 1;
    while (end < order_.size() && key(order_[end]) == key(order_[begin])) ++end;
    for (size_t i = begin; i < end; ++i) {
      for (size_t j = i + 1; j < end && arcs_[order_[i]].kept; ++j) {
        if (arcs_[order_[j]].kept && arcs_[order_[j]].start == arcs_[order_[i]].end) remove(order_[i], order_[j]);
      }
    }
  }
}

/// Removes two opposite arcs: the arc before each is joined to the arc after the other.
void Slits::remove(uint32_t a, uint32_t b) {
  const auto bypass = [&](uint32_t from, uint32_t to) {
    arcs_[from].next = to;
    arcs_[to].previous = from;
  };
  const Arc first = arcs_[a], second = arcs_[b];
  if (first.previous != b) bypass(first.previous, second.next);
  if (second.previous != a) bypass(second.previous, first.next);
  arcs_[a].kept = arcs_[b].kept = false;
}

void Slits::trace(const std::vector<PlanePoint>& at) {
  detail::Csr<uint32_t> traced;
  std::vector<double> areas;
  for (uint32_t first = 0; first < arcs_.size(); ++first) {
    if (!arcs_[first].kept) continue;
    double area = 0;
    const PlanePoint& origin = at[arcs_[first].start];
    for (uint32_t a = first; arcs_[a].kept; a = arcs_[a].next) {
      arcs_[a].kept = false;
      const PlanePoint &p = at[arcs_[a].start], &q = at[arcs_[a].end];
      area += (p.x - origin.x) * (q.y - origin.y) - (p.y - origin.y) * (q.x - origin.x);
      traced.items.push_back(arcs_[a].start);
    }
    traced.offsets.push_back(uint32_t(traced.items.size()));
    areas.push_back(area);
  }
  loops_.offsets.assign(1, 0);
  loops_.items.clear();
  const size_t outline = size_t(std::max_element(areas.begin(), areas.end()) - areas.begin());
  for (size_t i = 0; i < areas.size(); ++i) {
    const size_t l = i == 0 ? outline : i <= outline ? i - 1 : i;
    loops_.items.insert(loops_.items.end(), traced[l].begin(), traced[l].end());
    loops_.offsets.push_back(uint32_t(loops_.items.size()));
  }
}

}  // namespace mandoline::operators
