#include "cut/predicates/radial_order.h"

#include <algorithm>

namespace mandoline::detail {
namespace {

/// Whether two points in one plane with the line a b lie on the same side of it.
bool inOneHalfPlane(const Point& a, const Point& b, const Point& c, const Point& d, Predicates& predicates) {
  for (int axis = 0; axis < 3; ++axis) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const int side = predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
    if (side != 0) return side == predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {d[p], d[q]});
  }
  return true;
}

}  // namespace

size_t sortRadially(const Point& a, const Point& b, bool open, std::vector<Flap>& flaps, Predicates& predicates) {
  const auto turn = [&](const Flap& f, const Flap& g) { return predicates.orient3d(a.data(), b.data(), f.tip->data(), g.tip->data()); };
  flaps[0].quarter = 0;
  for (size_t i = 1; i < flaps.size(); ++i) {  // 0: with the first one, 1: less than half a turn on, 2: opposite, 3: beyond
    const int side = open ? 0 : turn(flaps[0], flaps[i]);
    flaps[i].quarter = side > 0 ? 1 : side < 0 ? 3 : open || inOneHalfPlane(a, b, *flaps[0].tip, *flaps[i].tip, predicates) ? 0 : 2;
  }
  std::sort(flaps.begin(), flaps.end(),
            [&](const Flap& f, const Flap& g) { return f.quarter != g.quarter ? f.quarter < g.quarter : turn(f, g) > 0; });
  for (size_t i = 1; i < flaps.size(); ++i) {
    if (flaps[i].quarter == flaps[i - 1].quarter && turn(flaps[i - 1], flaps[i]) == 0) return i;
  }
  return 0;
}

}  // namespace mandoline::detail
