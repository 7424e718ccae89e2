#include "cut/stages/floating_shells.h"

#include <cmath>
#include <optional>

#include "base/box_tree.h"
#include "cut/predicates/inner_point.h"
#include "cut/stages/shared_vertices.h"

namespace mandoline::detail {
namespace {

class Nester {
 public:
  Nester(const CellView& cell, Shells& shells, Predicates& predicates)
      : input_(cell.surface.input),
        vertices_(cell.surface.vertices),
        stencil_(cell.stencil),
        faces_(cell.faces),
        cell_(cell.halves),
        shells_(shells),
        predicates_(predicates) {}

  void run() {
    findComponents();
    if (floating_.empty()) return;
    buildTree();
    for (Component& component : floating_) component.outer = findOuter(component);
    for (const Component& component : floating_) {
      if (!tryRays(component, [&](Ray& ray) { return nest(component, ray); })) fail(component);
    }
  }

 private:
  struct Component {
    LocalHalf outer;  ///< a half-face of its outer shell
    std::vector<LocalFace> faces;
  };

  TriangleId triangle(LocalFace face) const { return faces_.tri.triangles[cell_.triFace(face)]; }

  /// Components of tri-cut-faces that are joined by edges; those that no grid-face joins are floating.
  void findComponents() {
    Shells components = shells_;
    for (const LocalFace f : cell_.localFaces()) components.unite(sideOf(f, 0), sideOf(f, 1));
    IdVector<LocalHalf, uint8_t> anchored(cell_.halfFaces.size(), 0);
    for (const LocalHalf h : cell_.gridHalves()) anchored[components.find(h)] = 1;
    IdVector<LocalHalf, int32_t> indexOf(cell_.halfFaces.size(), -1);  // of roots: into floating_
    componentOf_.assign(cell_.triFaces.size(), -1);
    for (const LocalFace f : cell_.localFaces()) {
      const LocalHalf root = components.find(sideOf(f, 0));
      if (anchored[root]) continue;
      if (indexOf[root] < 0) {
        indexOf[root] = int32_t(floating_.size());
        floating_.push_back({});
      }
      componentOf_[f] = indexOf[root];
      floating_[size_t(indexOf[root])].faces.push_back(f);
    }
  }

  /// Indexes the tri-cut-faces by the bounds of their vertices.
  void buildTree() {
    for (const LocalFace f : cell_.localFaces()) {
      const auto outline = faces_.loops(cell_.triFace(f))[0];
      Box box = boxOf(outline[0]);
      for (const VertexId v : outline) box.include(boxOf(v));
      boxes_.push_back(box);
    }
    tree_.build(boxes_.size(), [&](size_t f) { return BoxTree::Item{boxes_[LocalFace{uint32_t(f)}], uint32_t(f)}; });
  }
  Box boxOf(VertexId v) {
    Box box;
    for (int d = 0; d < 3; ++d) {
      const auto [low, high] = vertices_.range(v, d, predicates_);
      box.low[size_t(d)] = low;
      box.high[size_t(d)] = high;
    }
    return box;
  }

  /// A line against an axis from inside of a component's first face, as far as it was followed: to below the face `last`.
  struct Ray {
    InnerPoint from;
    int axis;
    LocalFace last;
    Box ahead;
  };

  /// Calls f(ray) for rays from a component, behind the last of its own faces, until it is true. False if all graze something.
  bool tryRays(const Component& component, FunctionRef<bool(Ray&)> f) {
    const LocalFace start = component.faces[0];
    for (int attempt = 0; attempt < 96; ++attempt) {
      Ray ray;
      ray.axis = attempt % 3;
      if (normalOf(start, ray.axis) == 0) continue;
      const int n = attempt / 3;
      ray.from = {cornerOf(cell_.triFace(start), ray.axis), {1.0 + n * 7 % 11, 1.0 + n * 5 % 13, 1.0 + n * 3 % 17}};
      const auto point = approximate(vertices_, ray.from, predicates_);
      for (size_t d = 0; d < 3; ++d) {
        ray.ahead.low[d] = point[d].value - 2 * point[d].error;
        ray.ahead.high[d] = point[d].value + 2 * point[d].error;
      }
      follow(ray, start);
      if (skip(component, ray) && f(ray)) return true;
    }
    return false;
  }
  [[noreturn]] void fail(const Component& component) const { vertices_.failSelfIntersection(triangle(component.faces[0]), blocker_); }

  /// Moves on to below a face.
  void follow(Ray& ray, LocalFace face) {
    ray.last = face;
    ray.ahead.low[size_t(ray.axis)] = -INFINITY;
    ray.ahead.high[size_t(ray.axis)] = heightOf(face, ray).high;
  }
  /// Moves on to below all faces of a component. False if the ray grazes one.
  bool skip(const Component& component, Ray& ray) {
    for (const LocalFace f : component.faces) {
      const Meeting meeting = meet(f, ray);
      if (meeting == Meeting::grazing) return false;
      if (meeting == Meeting::hit) follow(ray, f);
    }
    return true;
  }

  /// All shells of a component but one bound a cell from inside. Behind the last of its faces that a ray meets, the ray sees the outer
  /// one.
  LocalHalf findOuter(const Component& component) {
    std::optional<LocalHalf> outer;
    for (const LocalFace f : component.faces) {
      for (const LocalHalf h : {sideOf(f, 0), sideOf(f, 1)}) {
        if (shells_.find(h) != h) continue;
        if (outer) {
          const auto see = [&](const Ray& ray) {
            outer = below(ray.last, ray.axis);
            return true;
          };
          if (!tryRays(component, see)) fail(component);
          return *outer;
        }
        outer = h;
      }
    }
    return *outer;
  }

  /// Unites a component's outer shell with the shell that is seen behind its last face. If both are known to be in the same place already,
  /// looks behind that component, too: so each component either unites two shells or reaches a shell around all of them. False if the ray
  /// grazes something.
  bool nest(const Component& component, Ray& ray) {
    for (;;) {
      std::optional<LocalFace> next;
      if (!findNext(ray, next)) return false;
      const std::optional<LocalHalf> seen = next ? above(*next, ray.axis) : halfFaceBelow(ray.from, ray.axis);
      if (!seen) return false;
      const int32_t other = next ? componentOf_[*next] : -1;
      const LocalHalf shell = shells_.find(*seen);
      if (other < 0 || shell != shells_.find(floating_[size_t(other)].outer) || shell != shells_.find(component.outer)) {
        shells_.unite(component.outer, shell);
        return true;
      }
      if (!skip(floating_[size_t(other)], ray)) return false;
    }
  }

  /// Three vertices whose triangle, except its outline, lies inside of a face: its first vertex, as the plane is seen along the axis, the
  /// vertex before it, and the next one or, if others are in the way, the one that is seen nearest to the edge between them.
  std::array<VertexId, 3> cornerOf(FaceId face, int axis) {
    const auto loops = faces_.loops(face);
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const auto isBefore = [&](VertexId a, VertexId b) {
      const int order = vertices_.compare(a, b, p, predicates_);
      return order != 0 ? order < 0 : vertices_.compare(a, b, q, predicates_) < 0;
    };
    const auto turn = [&](VertexId a, VertexId b, VertexId c) { return vertices_.orient(a, b, c, axis, predicates_); };
    const auto outer = loops[0];
    VertexId first = outer[0];
    for (const VertexId v : outer) {
      if (v != first && isBefore(v, first)) first = v;
    }
    const int normal = normalSign(*input_.mesh, *faces_.triangle(face), axis, predicates_);
    VertexId before = first, after = first;
    for (size_t i = 0; i < outer.size(); ++i) {
      if (outer[i] != first) continue;
      before = outer[i > 0 ? i - 1 : outer.size() - 1];
      after = outer[i + 1 < outer.size() ? i + 1 : 0];
      if (turn(before, first, after) == normal) break;
    }
    VertexId nearest = after;
    for (const auto loop : loops) {
      for (const VertexId v : loop) {
        if (v == before || v == first || v == nearest) continue;
        const bool inCorner = turn(before, first, v) == normal && turn(first, after, v) == normal && turn(after, before, v) != -normal;
        if (inCorner && turn(before, nearest, v) == -normal) nearest = v;
      }
    }
    return {before, first, nearest};
  }

  enum class Meeting { none, hit, grazing };

  /// What happens at a face behind the last one.
  Meeting meet(LocalFace face, const Ray& ray) {
    if (face == ray.last || !boxes_[face].overlaps(ray.ahead)) return Meeting::none;
    const bool parallel = normalOf(face, ray.axis) == 0;
    const int order = parallel ? 0 : compare(face, ray.last, ray);
    if (order > 0) return Meeting::none;
    bool grazed = false;
    const bool hit = holds(cell_.triFace(face), ray.from, ray.axis, grazed);
    if (grazed) blocker_ = triangle(face);
    if (grazed) return Meeting::grazing;
    if (hit && order == 0) vertices_.failSelfIntersection(triangle(ray.last), triangle(face));
    return hit ? Meeting::hit : Meeting::none;
  }

  /// Finds the first face behind the last one, if any. False if the ray grazes something.
  bool findNext(const Ray& ray, std::optional<LocalFace>& next) {
    Ray rest = ray;  // down to the next face so far
    bool grazed = false;
    tree_.forOverlappingFromAbove(rest.ahead, size_t(ray.axis), [&](uint32_t f) {
      const Meeting meeting = meet({f}, rest);
      grazed |= meeting == Meeting::grazing;
      if (meeting != Meeting::hit) return;
      const int order = next ? compare({f}, *next, ray) : 1;
      if (order == 0) vertices_.failSelfIntersection(triangle(*next), triangle({f}));
      if (order < 0) return;
      next = LocalFace{f};
      rest.ahead.low[size_t(ray.axis)] = heightOf(*next, ray).low;
    });
    return !grazed;
  }

  /// Order along the axis of the places where a ray meets two faces' planes.
  int compare(LocalFace f, LocalFace g, const Ray& ray) {
    return compareHeights(vertices_, {triangle(f), triangle(g)}, ray.from, ray.axis, predicates_);
  }
  CutVertices::Range heightOf(LocalFace face, const Ray& ray) {
    const Bounded height = approximateHeight(vertices_, triangle(face), ray.from, ray.axis, predicates_);
    return {height.value - 2 * height.error, height.value + 2 * height.error};
  }
  int normalOf(LocalFace face, int axis) { return normalSign(*input_.mesh, triangle(face), axis, predicates_); }

  /// The half-face that a ray sees on a face before it, and behind it.
  LocalHalf above(LocalFace face, int axis) { return sideOf(face, normalOf(face, axis) > 0 ? 1 : 0); }
  LocalHalf below(LocalFace face, int axis) { return sideOf(face, normalOf(face, axis) > 0 ? 0 : 1); }

  /// The half-face of the lower grid-face across the axis that the ray leaves the grid cell through.
  std::optional<LocalHalf> halfFaceBelow(const InnerPoint& from, int axis) {
    const GridFaceId gridFace = stencil_.cells[cell_.gridCell].faces[cellFace(axis, 0)];
    const auto below = faces_.grid.halfFaces[gridFace];
    for (const HalfFace fromBelow : below) {
      const HalfFace halfFace = fromBelow.twin();
      bool grazed = false;
      if (below.size() == 1 || holds(halfFace.face(), from, axis, grazed)) {
        return cell_.localOf(halfFace);
      }
      if (grazed) return {};
    }
    return {};
  }

  /// Whether the point, projected along the axis, lies in a face: a ray to growing p crosses its loops an odd number of times.
  bool holds(FaceId face, const InnerPoint& from, int axis, bool& grazed) {
    bool inside = false;
    for (const auto loop : faces_.loops(face)) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const std::array<VertexId, 2> edge = {loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]};
        const int crossing = crossingOf(edge, from, axis);
        grazed |= crossing == 0;
        inside ^= crossing > 0;
      }
    }
    return inside && !grazed;
  }

  /// 1 if the ray to growing p crosses the edge, -1 if not, 0 if that is a close call.
  int crossingOf(std::array<VertexId, 2> edge, const InnerPoint& from, int axis) {
    const bool fromAbove = isAbove(vertices_, edge[0], from, axis, predicates_),
               toAbove = isAbove(vertices_, edge[1], from, axis, predicates_);
    if (fromAbove == toAbove) return -1;
    if (fromAbove) std::swap(edge[0], edge[1]);
    return sideOfLine(vertices_, edge, from, axis, predicates_);
  }

  const Input& input_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  const CutFaces& faces_;
  const CellHalves& cell_;
  Shells& shells_;
  Predicates& predicates_;
  std::vector<Component> floating_;
  IdVector<LocalFace, Box> boxes_;            // of tri-cut-faces
  BoxTree tree_;                              // the same
  IdVector<LocalFace, int32_t> componentOf_;  // index into floating_, or -1
  std::optional<TriangleId> blocker_;
};

}  // namespace

void nestFloatingShells(const CellView& cell, Shells& shells, Predicates& predicates) {
  uniteAtVertices(cell, shells);
  Nester(cell, shells, predicates).run();
}

}  // namespace mandoline::detail
