#include "operators/slice/nesting.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/sort.h"

namespace mandoline::operators {

const detail::Csr<uint32_t>& Nesting::run(const detail::Csr<uint32_t>& loops, const std::vector<PlanePoint>& at) {
  points_ = &loops;
  at_ = &at;
  loops_.clear();
  for (size_t l = 0; l < loops.size(); ++l) loops_.push_back(measure(loops[l]));
  decideUnclear();
  for (uint32_t l = 0; l < loops_.size(); ++l) loops_[l].outline = loops_[l].kind == Kind::hole ? outlineOf(l) : l;
  makePolygons();
  return polygons_;
}

/// In the order of their outlines, each followed by its holes.
void Nesting::makePolygons() {
  order_.clear();
  for (uint32_t l = 0; l < loops_.size(); ++l) {
    if (loops_[l].outline != kNone) order_.push_back(l);
  }
  const auto key = [&](uint32_t l) { return std::tuple(loops_[l].outline, loops_[l].outline != l, l); };
  detail::sortItems(order_, [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  polygons_.offsets.assign(1, 0);
  polygons_.items.clear();
  for (const uint32_t l : order_) {
    if (loops_[l].outline == l && !polygons_.items.empty()) polygons_.offsets.push_back(uint32_t(polygons_.items.size()));
    polygons_.items.push_back(l);
  }
  if (!polygons_.items.empty()) polygons_.offsets.push_back(uint32_t(polygons_.items.size()));
}

Nesting::Loop Nesting::measure(std::span<const uint32_t> points) const {
  const PlanePoint& origin = (*at_)[points[0]];
  Loop loop = {Kind::unclear, 0, {}, {}, origin, origin, kNone};
  double perimeter = 0, longest = -1;
  for (size_t i = 0; i < points.size(); ++i) {
    const std::array<uint32_t, 2> segment = {points[i], points[i + 1 < points.size() ? i + 1 : 0]};
    const PlanePoint &a = (*at_)[segment[0]], &b = (*at_)[segment[1]];
    loop.area += 0.5 * ((a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x));
    const double length = std::fabs(b.x - a.x) + std::fabs(b.y - a.y);
    perimeter += length;
    loop.low = {std::min(loop.low.x, a.x), std::min(loop.low.y, a.y)};
    loop.high = {std::max(loop.high.x, a.x), std::max(loop.high.y, a.y)};
    if (length > longest) {
      longest = length;
      loop.longest = segment;
      loop.sample = {0.5 * a.x + 0.5 * b.x, 0.5 * a.y + 0.5 * b.y};
    }
  }
  // Coordinates are below 2, so rounding moves points by some 2^-52.
  constexpr double kMoved = 0x1p-49;
  if (points.size() < 3) {
    loop.kind = Kind::hole;
  } else if (std::fabs(loop.area) > kMoved * perimeter) {
    loop.kind = loop.area > 0 ? Kind::outline : Kind::hole;
  }
  return loop;
}

/// Loops so thin that the sign of their area may be rounding's are holes if they lie within the cell: slits. A cell has an outline.
void Nesting::decideUnclear() {
  const auto isUnclear = [](const Loop& loop) { return loop.kind == Kind::unclear; };
  if (std::none_of(loops_.begin(), loops_.end(), isUnclear)) return;
  if (std::none_of(loops_.begin(), loops_.end(), [](const Loop& loop) { return loop.kind == Kind::outline; })) {
    const auto thinner = [&](const Loop& a, const Loop& b) { return isUnclear(b) && (!isUnclear(a) || a.area < b.area); };
    std::max_element(loops_.begin(), loops_.end(), thinner)->kind = Kind::outline;
  }
  std::vector<Kind> kinds;
  for (const Loop& loop : loops_) {
    int within = 0;
    for (uint32_t other = 0; other < loops_.size() && isUnclear(loop); ++other) {
      if (!isUnclear(loops_[other])) within += winding(other, loop.sample);
    }
    kinds.push_back(!isUnclear(loop) ? loop.kind : within > 0 ? Kind::hole : Kind::outline);
  }
  for (size_t l = 0; l < loops_.size(); ++l) loops_[l].kind = kinds[l];
}

/// The smallest outline around a hole; if rounding has left none, the largest of all. One that runs along the hole backwards lies within
/// it: both sides of a closed slit.
uint32_t Nesting::outlineOf(uint32_t hole) {
  uint32_t around = kNone, largest = kNone;
  const auto isSmaller = [&](uint32_t a, uint32_t b) { return loops_[a].area < loops_[b].area; };
  uint32_t outlines = 0;
  for (uint32_t l = 0; l < loops_.size(); ++l) {
    if (loops_[l].kind != Kind::outline) continue;
    ++outlines;
    if (largest == kNone || isSmaller(largest, l)) largest = l;
  }
  if (outlines <= 1) return largest;
  for (uint32_t l = 0; l < loops_.size(); ++l) {
    if (loops_[l].kind != Kind::outline || (around != kNone && !isSmaller(l, around))) continue;
    if (winding(l, loops_[hole].sample) > 0 && !runsAlong(l, loops_[hole].longest[1], loops_[hole].longest[0])) around = l;
  }
  return around != kNone ? around : largest;
}

bool Nesting::runsAlong(uint32_t loop, uint32_t from, uint32_t to) const {
  const auto points = (*points_)[loop];
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i] == from && points[i + 1 < points.size() ? i + 1 : 0] == to) return true;
  }
  return false;
}

/// How often a loop winds around a place.
int Nesting::winding(uint32_t loop, const PlanePoint& p) {
  const PlanePoint &low = loops_[loop].low, &high = loops_[loop].high;
  if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y) return 0;
  const auto points = (*points_)[loop];
  int result = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const PlanePoint &a = (*at_)[points[i]], &b = (*at_)[points[i + 1 < points.size() ? i + 1 : 0]];
    const int direction = int(b.y > p.y) - int(a.y > p.y);
    if (direction != 0 && predicates_.orient2d({a.x, a.y}, {b.x, b.y}, {p.x, p.y}) == direction) result += direction;
  }
  return result;
}

}  // namespace mandoline::operators
