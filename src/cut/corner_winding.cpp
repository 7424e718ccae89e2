#include "cut/corner_winding.h"

namespace mandoline::detail {

int32_t windingBeside(const Point& corner, const Prepared& mesh, const Counted& counted, TriangleId triangle, Predicates& predicates) {
  const Point& o = corner;
  const auto v = mesh.verticesOf(triangle);
  const Point &a = mesh.point(v[0]), &b = mesh.point(v[1]), &c = mesh.point(v[2]);
  const auto least = [&](size_t d) { return std::min(std::min(a[d], b[d]), c[d]); };
  const auto greatest = [&](size_t d) { return std::max(std::max(a[d], b[d]), c[d]); };
  if (least(1) > o[1] || greatest(1) <= o[1] || least(2) > o[2] || greatest(2) < o[2] || least(0) > o[0]) return 0;
  const int32_t copies = counted.signSum(triangle);
  if (copies == 0) return 0;
  const auto sideOf = [&](const Point& p, const Point& q) {  // of the shifted point about p -> q, seen along -x
    const int side = predicates.orient2d({p[1], p[2]}, {q[1], q[2]}, {o[1], o[2]});
    if (side != 0) return side;
    const int byY = -signOf(q[2] - p[2]);
    return byY != 0 ? byY : signOf(q[1] - p[1]);
  };
  const int side = sideOf(a, b);
  if (side == 0 || side != sideOf(b, c) || side != sideOf(c, a)) return 0;  // side is now the sign of the normal's x
  int above = predicates.orient3d(a.data(), b.data(), c.data(), o.data());
  if (above == 0) above = predicates.orient2d({a[2], a[0]}, {b[2], b[0]}, {c[2], c[0]});
  if (above == 0) above = predicates.orient2d({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
  if (above == 0) above = side;
  return above == side ? -side * copies : 0;  // the same: the point lies beyond the triangle along +x, so the ray meets it
}

}  // namespace mandoline::detail
