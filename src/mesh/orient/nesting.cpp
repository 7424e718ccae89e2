#include "mesh/orient/nesting.h"

#include <cmath>

#include "base/box_tree.h"
#include "mesh/resolve/contacts.h"

namespace mandoline::detail {
namespace {

using ShellPair = std::array<uint32_t, 2>;

/// The centre of a triangle, as the sum of its corners: three times itself, which needs no rounding.
struct Centre {
  uint32_t triangle;
  std::array<const Point*, 3> corners;

  /// Three times the difference to p along an axis.
  template <class Number>
  Number from(const Point& p, size_t d) const {
    return Number::difference((*corners[0])[d], p[d]) + Number::difference((*corners[1])[d], p[d]) +
           Number::difference((*corners[2])[d], p[d]);
  }
  /// A box around it. Its sides are several roundings wide.
  Box box() const {
    Box box;
    for (size_t d = 0; d < 3; ++d) {
      const double a = (*corners[0])[d], b = (*corners[1])[d], c = (*corners[2])[d];
      const double centre = (a + b + c) / 3, room = 8 * kRoundoff * (std::fabs(a) + std::fabs(b) + std::fabs(c));
      box.low[d] = centre - room;
      box.high[d] = centre + room;
    }
    return box;
  }
};

/// Rays along an axis against one triangle.
class Ray {
 public:
  Ray(const WeldedMesh& mesh, const Centre& start, size_t axis, Predicates& predicates)
      : mesh_(mesh), start_(start), axis_(axis), predicates_(predicates) {}

  enum class Meets { no, yes, atStart };
  /// Whether the ray, shifted sideways by next to nothing so that it passes no vertex and no edge, meets a triangle; or whether it starts
  /// on the triangle.
  Meets test(uint32_t triangle) {
    const auto& v = mesh_.triangles[triangle];
    const Point &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
    const int above = sideOfPlane(a, b, c);
    if (above == 0 && holdsStart(a, b, c)) return Meets::atStart;
    const int side = shiftedTurn(a, b);
    if (side == 0 || side != shiftedTurn(b, c) || side != shiftedTurn(c, a)) return Meets::no;
    return above == -side ? Meets::yes : Meets::no;
  }

 private:
  /// On which side of the triangle's plane the ray starts: 1 where its normal points to.
  int sideOfPlane(const Point& a, const Point& b, const Point& c) {
    return predicates_.sign([&]<class Number>(const Number&) {
      const auto difference = [&](const Point& p, size_t d) { return Number::difference(p[d], a[d]); };
      Number sum;
      for (size_t d = 0; d < 3; ++d) {
        const size_t p = (d + 1) % 3, q = (d + 2) % 3;
        sum = sum + (difference(b, p) * difference(c, q) - difference(b, q) * difference(c, p)) * start_.from<Number>(a, d);
      }
      return sum;
    });
  }
  /// Seen against an axis: whether a, b and the start turn counter-clockwise.
  int turn(const Point& a, const Point& b, size_t axis) {
    const size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
    return predicates_.sign([&]<class Number>(const Number&) {
      return Number::difference(b[p], a[p]) * start_.from<Number>(a, q) - Number::difference(b[q], a[q]) * start_.from<Number>(a, p);
    });
  }
  /// The same of the ray's start shifted by (e^2, e) for an e as small as need be: 0 only if a and b are one.
  int shiftedTurn(const Point& a, const Point& b) {
    const size_t p = (axis_ + 1) % 3, q = (axis_ + 2) % 3;
    const int exact = turn(a, b, axis_);
    if (exact != 0) return exact;
    return b[p] != a[p] ? signOf(b[p] - a[p]) : signOf(a[q] - b[q]);
  }
  /// Whether a triangle with area holds the start, which lies in its plane.
  bool holdsStart(const Point& a, const Point& b, const Point& c) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
      const int area = predicates_.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
      if (area == 0) continue;
      return turn(a, b, axis) != -area && turn(b, c, axis) != -area && turn(c, a, axis) != -area;
    }
    return false;
  }

  const WeldedMesh& mesh_;
  const Centre& start_;
  size_t axis_;
  Predicates& predicates_;
};

class Nester {
 public:
  Nester(const WeldedMesh& mesh, const Patches& patches, const Shells& shells, std::vector<ShellPair> crossing, Predicates& predicates)
      : mesh_(mesh), patches_(patches), shells_(shells), crossing_(std::move(crossing)), predicates_(predicates) {
    std::vector<uint32_t> walls;  // triangles of shells
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (shellOf(t) >= 0) walls.push_back(t);
    }
    tree_.build(walls.size(), [&](size_t i) { return BoxTree::Item{boxOf(mesh_, walls[i]), walls[i]}; });
  }

  /// A patch, by its first triangle on which no other one lies.
  void nest(std::span<const uint32_t> triangles, uint8_t& isInside, int8_t& facing) {
    for (const uint32_t t : triangles) {
      if (mesh_.states[t] == TriangleState::zeroArea) continue;
      if (!castFrom(t)) continue;
      size_t others = 0;
      bool own = false;
      forOddShells([&](uint32_t shell) {
        if (int32_t(shell) == shellOf(t)) {
          own = true;
        } else {
          others += !cross(shell, uint32_t(shellOf(t)));
        }
      });
      isInside = others % 2 != 0;
      const bool pointsAlong = (normalSign(mesh_, TriangleId{t}, int(axis_), predicates_) > 0) != (patches_.turned[t] != 0);
      if (!shells_.isSingle[size_t(shellOf(t))]) facing = own == pointsAlong ? -1 : 1;
      return;
    }
  }

 private:
  /// -1 for triangles that are in none, or without area.
  int32_t shellOf(uint32_t triangle) const {
    if (!patches_.has(triangle) || mesh_.states[triangle] == TriangleState::zeroArea) return -1;
    return shells_.shellOf[patches_.of(triangle)];
  }
  bool cross(uint32_t s, uint32_t t) const {
    return std::binary_search(crossing_.begin(), crossing_.end(), ShellPair{std::min(s, t), std::max(s, t)});
  }

  /// Notes the shell of each triangle that a ray from the centre of one meets; false if another one lies there.
  bool castFrom(uint32_t triangle) {
    const auto& v = mesh_.triangles[triangle];
    const Centre start{triangle, {&mesh_.points[v[0]], &mesh_.points[v[1]], &mesh_.points[v[2]]}};
    axis_ = 0;
    while (normalSign(mesh_, TriangleId{triangle}, int(axis_), predicates_) == 0) ++axis_;
    Ray ray(mesh_, start, axis_, predicates_);
    met_.clear();
    bool isClear = true;
    Box box = start.box();
    box.high[axis_] = INFINITY;
    tree_.forOverlapping(box, [&](uint32_t other) {
      const int32_t shell = shellOf(other);
      const bool isOwn = shell == shellOf(triangle);
      if (other == triangle || (isOwn && shells_.isSingle[size_t(shell)]) || !isClear) return;
      const Ray::Meets meets = ray.test(other);
      if (meets == Ray::Meets::yes) met_.push_back(uint32_t(shell));
      isClear &= meets != Ray::Meets::atStart;
    });
    return isClear;
  }
  /// Calls f(shell) for those that the last ray has met an odd number of times.
  template <class F>
  void forOddShells(const F& f) {
    sortItems(met_);
    for (size_t begin = 0, end = 0; begin < met_.size(); begin = end) {
      while (end < met_.size() && met_[end] == met_[begin]) ++end;
      if ((end - begin) % 2 != 0) f(met_[begin]);
    }
  }

  const WeldedMesh& mesh_;
  const Patches& patches_;
  const Shells& shells_;
  std::vector<ShellPair> crossing_;  // ascending
  Predicates& predicates_;
  BoxTree tree_;
  size_t axis_ = 0;
  std::vector<uint32_t> met_;
};

/// Pairs of shells that cross, ascending.
std::vector<ShellPair> crossingShells(const WeldedMesh& mesh, const Patches& patches, const Shells& shells, Monitor& monitor,
                                      Predicates& predicates) {
  std::vector<ShellPair> pairs;
  if (shells.count() < 2) return pairs;
  for (const PairContact& pair : findContacts(mesh, findNear(SortedMesh(mesh), monitor), monitor, predicates).pairs) {
    const int32_t s = shells.shellOf[patches.of(pair.triangles[0])], t = shells.shellOf[patches.of(pair.triangles[1])];
    if (s >= 0 && t >= 0 && s != t && pair.kind() == IntersectionKind::crossing)
      pairs.push_back({uint32_t(std::min(s, t)), uint32_t(std::max(s, t))});
  }
  sortUnique(pairs);
  return pairs;
}

}  // namespace

Nesting findNesting(const WeldedMesh& mesh, const Patches& patches, const Shells& shells, Monitor& monitor, Predicates& predicates) {
  Nesting nesting{std::vector<uint8_t>(patches.count(), 0), std::vector<int8_t>(patches.count(), 0)};
  const bool isOne = shells.count() == 0 || (shells.count() == 1 && shells.isSingle[0]);
  if (isOne) return nesting;
  Nester nester(mesh, patches, shells, crossingShells(mesh, patches, shells, monitor, predicates), predicates);
  const Csr<uint32_t> triangles = trianglesOf(patches);
  for (size_t p = 0; p < patches.count(); ++p) {
    if (p % 256 == 0) monitor.report(p, patches.count());
    if (shells.shellOf[p] >= 0) nester.nest(triangles[p], nesting.isInside[p], nesting.facing[p]);
  }
  return nesting;
}

}  // namespace mandoline::detail
