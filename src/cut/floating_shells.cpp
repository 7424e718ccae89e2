#include "cut/floating_shells.h"

#include <optional>

namespace mandoline::detail {
namespace {

/// A point inside of a triangle: the mean of its corners by whole-number weights, so that another can be tried if one lies unluckily.
struct InnerPoint {
  const Point* corners[3];
  double weights[3];

  template <class Number>
  Number weight() const {
    return Number(weights[0] + weights[1] + weights[2]);
  }
  /// weight() times the coordinate less r.
  template <class Number>
  Number coordinate(int axis, double r) const {
    Number x = Number(weights[0]) * Number::difference((*corners[0])[axis], r);
    for (int i = 1; i < 3; ++i) x = x + Number(weights[i]) * Number::difference((*corners[i])[axis], r);
    return x;
  }
};

struct Hit {
  uint32_t local;  ///< index into CellHalves::triFaces
  int normal;      ///< sign of its triangle's normal along the ray's axis
};

class Nester {
 public:
  Nester(const Input& input, const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces, const CutVertices& vertices,
         const CellHalves& cell, UnionFind& shells, Predicates& predicates)
      : input_(input), stencil_(stencil), triFaces_(triFaces), gridFaces_(gridFaces), vertices_(vertices), cell_(cell), shells_(shells),
        predicates_(predicates) {}

  void run() {
    findComponents();
    std::vector<std::pair<uint32_t, uint32_t>> nested;  // outer shell, shell around it; united last, when all outer shells are known
    for (const auto& component : floating_) nested.push_back({component.outer, holder(component)});
    for (const auto& [outer, around] : nested) shells_.unite(outer, around);
  }

 private:
  struct Component {
    uint32_t root;
    uint32_t outer;                ///< a local half-face of its outer shell
    std::vector<uint32_t> locals;  ///< its tri-cut-faces
  };

  const std::array<uint32_t, 3>& corners(uint32_t local) const { return input_.triangles[triangle(local)]; }
  uint32_t triangle(uint32_t local) const { return triFaces_.triangles[cell_.triFaces[local]]; }

  /// Components of tri-cut-faces that are joined by edges; those that no grid-face joins are floating.
  void findComponents() {
    UnionFind components = shells_;
    for (uint32_t i = 0; i < cell_.triFaces.size(); ++i) components.unite(2 * i, 2 * i + 1);
    std::vector<uint8_t> anchored(cell_.halfFaces.size(), 0);
    for (uint32_t h = uint32_t(cell_.triHalves()); h < cell_.halfFaces.size(); ++h) anchored[components.find(h)] = 1;
    std::vector<int32_t> indexOf(cell_.halfFaces.size(), -1);
    componentOf_.assign(cell_.triFaces.size(), -1);
    for (uint32_t i = 0; i < cell_.triFaces.size(); ++i) {
      const uint32_t root = components.find(2 * i);
      if (anchored[root]) continue;
      if (indexOf[root] < 0) {
        indexOf[root] = int32_t(floating_.size());
        floating_.push_back({root, 0, {}});
      }
      componentOf_[i] = indexOf[root];
      floating_[size_t(indexOf[root])].locals.push_back(i);
    }
    for (Component& component : floating_) component.outer = findOuter(component);
  }

  /// Of the shells of a component all but one bound a cell of positive volume from inside.
  uint32_t findOuter(const Component& component) {
    std::vector<uint32_t> roots;
    for (const uint32_t i : component.locals) {
      for (uint32_t h = 2 * i; h < 2 * i + 2; ++h) {
        if (shells_.find(h) == h) roots.push_back(h);
      }
    }
    if (roots.size() == 1) return roots[0];
    const Point& r = input_.points[corners(component.locals[0])[0]];
    for (const uint32_t root : roots) {
      const int sign = predicates_.sign([&](auto number) {
        using Number = decltype(number);
        Number sum(0);
        for (const uint32_t i : component.locals) {
          const bool out = shells_.find(2 * i) == root, in = shells_.find(2 * i + 1) == root;
          if (out == in) continue;
          Number x[3][3];
          for (int k = 0; k < 3; ++k) {
            for (int d = 0; d < 3; ++d) x[k][d] = Number::difference(input_.points[corners(i)[k]][d], r[d]);
          }
          const Number det = x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
                             x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
          sum = out ? sum + det : sum - det;
        }
        return sum;
      });
      if (sign <= 0) return root;
    }
    vertices_.failSelfIntersection(triangle(component.locals[0]), triangle(component.locals.back()));
  }

  /// P7: a half-face of the shell around a component, by a ray against an axis from inside of one of its triangles.
  uint32_t holder(const Component& component) {
    const uint32_t start = component.locals[0];
    int axis = 0;
    while (normalSign(start, axis) == 0) ++axis;
    for (int attempt = 0; attempt < 64; ++attempt) {
      const InnerPoint from = {{&input_.points[corners(start)[0]], &input_.points[corners(start)[1]], &input_.points[corners(start)[2]]},
                               {1.0 + attempt * 7 % 11, 1.0 + attempt * 5 % 13, 1.0 + attempt * 3 % 17}};
      if (const auto found = shoot(component, start, from, axis)) return *found;
    }
    vertices_.failSelfIntersection(triangle(start), blocker_);
  }

  /// Nothing if the ray grazes something.
  std::optional<uint32_t> shoot(const Component& component, uint32_t start, const InnerPoint& from, int axis) {
    std::vector<Hit> hits;
    for (uint32_t i = 0; i < cell_.triFaces.size(); ++i) {
      if (i == start) continue;
      const auto hit = intersect(i, start, from, axis);
      if (!hit) return {};
      if (*hit) hits.push_back({i, normalSign(i, axis)});
    }
    std::sort(hits.begin(), hits.end(), [&](const Hit& a, const Hit& b) { return compareHeights(a, b, from, axis) > 0; });
    for (size_t i = 1; i < hits.size(); ++i) {
      if (compareHeights(hits[i - 1], hits[i], from, axis) == 0) vertices_.failSelfIntersection(triangle(hits[i - 1].local), triangle(hits[i].local));
    }
    // Behind the last hit with a component its outer side is seen, so the ray is where it was before it met the component.
    size_t at = 0;
    const auto skip = [&](int32_t index) {
      for (size_t i = at; i < hits.size(); ++i) {
        if (componentOf_[hits[i].local] == index) at = i + 1;
      }
    };
    skip(componentOf_[component.locals[0]]);
    while (at < hits.size()) {
      const uint32_t seen = 2 * hits[at].local + (hits[at].normal > 0 ? 1 : 0);
      const int32_t other = componentOf_[hits[at].local];
      if (other < 0 || shells_.find(seen) != shells_.find(floating_[size_t(other)].outer)) return seen;
      skip(other);
    }
    return halfFaceBelow(from, axis);
  }

  int normalSign(uint32_t local, int axis) {
    const Point &a = input_.points[corners(local)[0]], &b = input_.points[corners(local)[1]], &c = input_.points[corners(local)[2]];
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    return predicates_.orient2d(a[p], a[q], b[p], b[q], c[p], c[q]);
  }

  /// Whether the ray hits the triangle inside of the grid cell; nothing if that is a close call.
  std::optional<bool> intersect(uint32_t local, uint32_t start, const InnerPoint& from, int axis) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const auto& t = corners(local);
    bool left = false, right = false, on = false;
    for (int i = 0; i < 3; ++i) {
      const Point &a = input_.points[t[i]], &b = input_.points[t[(i + 1) % 3]];
      const int side = predicates_.sign([&](auto number) {
        using Number = decltype(number);
        return Number::difference(b[p], a[p]) * from.coordinate<Number>(q, a[q]) - Number::difference(b[q], a[q]) * from.coordinate<Number>(p, a[p]);
      });
      left |= side > 0;
      right |= side < 0;
      on |= side == 0;
    }
    if (left && right) return false;
    if (on) return graze(local);
    const int normal = left ? 1 : -1;
    const int startSide = normal * sideOfPlane(local, from, axis, nullptr);
    if (startSide == 0) vertices_.failSelfIntersection(triangle(start), triangle(local));
    const double bottom = input_.planes[axis][stencil_.cells[cell_.stencilCell].at(axis)];
    const int bottomSide = normal * sideOfPlane(local, from, axis, &bottom);
    if (bottomSide == 0) return graze(local);
    return startSide > 0 && bottomSide < 0;
  }

  std::optional<bool> graze(uint32_t local) {
    blocker_ = triangle(local);
    return {};
  }

  /// Side of a triangle's plane that a point lies on; its coordinate along the axis may be replaced.
  int sideOfPlane(uint32_t local, const InnerPoint& from, int axis, const double* replaced) {
    const Point &a = input_.points[corners(local)[0]], &b = input_.points[corners(local)[1]], &c = input_.points[corners(local)[2]];
    return predicates_.sign([&](auto number) {
      using Number = decltype(number);
      Number sum(0);
      for (int d = 0; d < 3; ++d) {
        const int p = (d + 1) % 3, q = (d + 2) % 3;
        const Number normal = Number::difference(b[p], a[p]) * Number::difference(c[q], a[q]) - Number::difference(b[q], a[q]) * Number::difference(c[p], a[p]);
        const Number x = d == axis && replaced ? Number::difference(*replaced, a[d]) * from.weight<Number>() : from.coordinate<Number>(d, a[d]);
        sum = sum + normal * x;
      }
      return sum;
    });
  }

  /// P3 on the ray: order of the places where it meets two triangles.
  int compareHeights(const Hit& g, const Hit& h, const InnerPoint& from, int axis) {
    if (g.local == h.local) return 0;
    const double r = input_.points[corners(g.local)[0]][axis];
    const int sign = predicates_.sign([&](auto number) {
      using Number = decltype(number);
      Number height[2], normal[2];  // height times weight times normal
      for (int i = 0; i < 2; ++i) {
        const auto& t = corners(i == 0 ? g.local : h.local);
        const Point &a = input_.points[t[0]], &b = input_.points[t[1]], &c = input_.points[t[2]];
        Number n[3];
        for (int d = 0; d < 3; ++d) {
          const int p = (d + 1) % 3, q = (d + 2) % 3;
          n[d] = Number::difference(b[p], a[p]) * Number::difference(c[q], a[q]) - Number::difference(b[q], a[q]) * Number::difference(c[p], a[p]);
        }
        const int p = (axis + 1) % 3, q = (axis + 2) % 3;
        normal[i] = n[axis];
        height[i] = Number::difference(a[axis], r) * n[axis] * from.weight<Number>() -
                    (n[p] * from.coordinate<Number>(p, a[p]) + n[q] * from.coordinate<Number>(q, a[q]));
      }
      return height[0] * normal[1] - height[1] * normal[0];
    });
    return sign * g.normal * h.normal;
  }

  /// The half-face of the lower grid-face across the axis that the ray leaves the grid cell through.
  std::optional<uint32_t> halfFaceBelow(const InnerPoint& from, int axis) {
    const uint32_t gridFace = stencil_.cells[cell_.stencilCell].faces[cellFace(axis, 0)];
    const auto below = gridFaces_.halfFaces[gridFace];
    for (const uint32_t b : below) {
      const uint32_t halfFace = b ^ 1;  // seen from above
      bool grazed = false;
      if (below.size() == 1 || holds(halfFace / 2, from, axis, grazed)) {
        const auto at = std::find(cell_.halfFaces.begin() + std::ptrdiff_t(cell_.triHalves()), cell_.halfFaces.end(), halfFace);
        return uint32_t(at - cell_.halfFaces.begin());
      }
      if (grazed) return {};
    }
    return {};
  }

  /// Whether the point, projected along the axis, lies in a face: a ray to growing p crosses its loops an odd number of times.
  bool holds(uint32_t face, const InnerPoint& from, int axis, bool& grazed) {
    bool inside = false;
    const auto cross = [&](std::span<const uint32_t> loop) {
      for (size_t i = 0; i < loop.size(); ++i) crossEdge(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], from, axis, inside, grazed);
    };
    if (face < triFaces_.size()) {
      cross(triFaces_.loop(face));
    } else {
      const uint32_t g = face - uint32_t(triFaces_.size());
      for (uint32_t l = gridFaces_.faceLoopOffsets[g]; l < gridFaces_.faceLoopOffsets[g + 1]; ++l) {
        const uint32_t first = gridFaces_.loopOffsets[l];
        cross({gridFaces_.loopVertices.data() + first, gridFaces_.loopOffsets[l + 1] - first});
      }
    }
    return inside && !grazed;
  }

  void crossEdge(uint32_t u, uint32_t v, const InnerPoint& from, int axis, bool& inside, bool& grazed) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const auto above = [&](uint32_t w) {
      const Point r = vertices_.reference(w);
      return predicates_.sign([&](auto number) {
        using Number = decltype(number);
        const auto h = vertices_.point<Number>(w, r, predicates_);
        return h.x[q] * from.weight<Number>() - from.coordinate<Number>(q, r[q]) * h.w;
      }) > 0;
    };
    const bool fromAbove = above(u), toAbove = above(v);
    if (fromAbove == toAbove) return;
    if (fromAbove) std::swap(u, v);
    const Point r = vertices_.reference(u);
    const int side = predicates_.sign([&](auto number) {
      using Number = decltype(number);
      const auto a = vertices_.point<Number>(u, r, predicates_), b = vertices_.point<Number>(v, r, predicates_);
      const Number x = from.coordinate<Number>(p, r[p]), y = from.coordinate<Number>(q, r[q]), w = from.weight<Number>();
      return a.x[p] * (b.x[q] * w - y * b.w) - a.x[q] * (b.x[p] * w - x * b.w) + a.w * (b.x[p] * y - b.x[q] * x);
    });
    grazed |= side == 0;
    inside ^= side > 0;
  }

  const Input& input_;
  const Stencil& stencil_;
  const TriFaces& triFaces_;
  const GridFaces& gridFaces_;
  const CutVertices& vertices_;
  const CellHalves& cell_;
  UnionFind& shells_;
  Predicates& predicates_;
  std::vector<Component> floating_;
  std::vector<int32_t> componentOf_;  // per local tri-cut-face: index into floating_, or -1
  int64_t blocker_ = -1;
};

}  // namespace

void nestFloatingShells(const Input& input, const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces, const CutVertices& vertices,
                        const CellHalves& cell, UnionFind& shells, Predicates& predicates) {
  Nester(input, stencil, triFaces, gridFaces, vertices, cell, shells, predicates).run();
}

}  // namespace mandoline::detail
