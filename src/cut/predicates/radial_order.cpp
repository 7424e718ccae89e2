#include "cut/predicates/radial_order.h"

#include "base/sort.h"

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

/// Sorts by angle, where turn(f, g) is the sign of the turn from f to g and isOpposite() tells those apart that have none.
template <class Item, class Turn, class IsOpposite>
size_t sortByTurns(bool open, std::vector<Item>& items, const Turn& turn, const IsOpposite& isOpposite) {
  items[0].quarter = 0;
  for (size_t i = 1; i < items.size(); ++i) {  // 0: with the first one, 1: less than half a turn on, 2: opposite, 3: beyond
    const int side = open ? 0 : turn(items[0], items[i]);
    items[i].quarter = side > 0 ? 1 : side < 0 ? 3 : open || !isOpposite(items[0], items[i]) ? 0 : 2;
  }
  sortItems(items, [&](const Item& f, const Item& g) { return f.quarter != g.quarter ? f.quarter < g.quarter : turn(f, g) > 0; });
  for (size_t i = 1; i < items.size(); ++i) {
    if (items[i].quarter == items[i - 1].quarter && turn(items[i - 1], items[i]) == 0) return i;
  }
  return 0;
}

}  // namespace

size_t sortRadially(const Point& a, const Point& b, bool open, std::vector<Flap>& flaps, Predicates& predicates) {
  return sortByTurns(
      open, flaps, [&](const Flap& f, const Flap& g) { return predicates.orient3d(a.data(), b.data(), f.tip->data(), g.tip->data()); },
      [&](const Flap& f, const Flap& g) { return !inOneHalfPlane(a, b, *f.tip, *g.tip, predicates); });
}

size_t sortRadially(const WeldedMesh& mesh, const Line& line, bool open, std::vector<HalfPlane>& halfPlanes, Predicates& predicates) {
  const auto normal = [&]<class Number>(TriangleId triangle, Number) {
    const auto& t = mesh.triangles[triangle.number];
    return normalOf<Number>(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  };
  // A half-plane is spanned by the line's direction d and n x d, or its opposite, for the normal n. Two of them turn about d by the sign of
  // d . (m x n); where that is 0, their normals are parallel.
  const auto turn = [&](const HalfPlane& f, const HalfPlane& g) {
    if (f.triangle == g.triangle) return 0;
    const int sign = predicates.sign([&](auto number) {
      return dot(line.direction<decltype(number)>(mesh), cross(normal(f.triangle, number), normal(g.triangle, number)));
    });
    return f.ascending == g.ascending ? sign : -sign;
  };
  const auto isOpposite = [&](const HalfPlane& f, const HalfPlane& g) {
    if (f.triangle == g.triangle) return f.ascending != g.ascending;
    const int sign = predicates.sign([&](auto number) { return dot(normal(f.triangle, number), normal(g.triangle, number)); });
    return (f.ascending == g.ascending) != (sign > 0);
  };
  return sortByTurns(open, halfPlanes, turn, isOpposite);
}

}  // namespace mandoline::detail
