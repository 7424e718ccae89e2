#include "cut/stages/floating_shells.h"

#include <optional>

#include "cut/predicates/inner_point.h"

namespace mandoline::detail {
namespace {

class Nester {
 public:
  Nester(const CellView& cell, DisjointSets& shells, Predicates& predicates)
      : input_(cell.surface.input),
        vertices_(cell.surface.vertices),
        stencil_(cell.stencil),
        faces_(cell.faces),
        cell_(cell.halves),
        shells_(shells),
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

  Corners corners(uint32_t local) const {
    const auto& t = input_.triangles[triangle(local)];
    return {&input_.points[t[0]], &input_.points[t[1]], &input_.points[t[2]]};
  }
  uint32_t triangle(uint32_t local) const { return faces_.tri.triangles[cell_.triFaces[local]]; }

  /// Components of tri-cut-faces that are joined by edges; those that no grid-face joins are floating.
  void findComponents() {
    DisjointSets components = shells_;
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
    for (const uint32_t root : roots) {
      std::vector<Corners> triangles;  // seen from outside of the shell's cell; those with both sides in it bound nothing
      for (const uint32_t i : component.locals) {
        const bool out = shells_.find(2 * i) == root, in = shells_.find(2 * i + 1) == root;
        if (out == in) continue;
        triangles.push_back(corners(i));
        if (in) std::swap(triangles.back()[1], triangles.back()[2]);
      }
      if (volumeSign(triangles, predicates_) <= 0) return root;
    }
    vertices_.failSelfIntersection(triangle(component.locals[0]), triangle(component.locals.back()));
  }

  /// A half-face of the shell around a component, by a ray against an axis from inside of one of its triangles.
  uint32_t holder(const Component& component) {
    const uint32_t start = component.locals[0];
    int axis = 0;
    while (normalSign(corners(start), axis, predicates_) == 0) ++axis;
    for (int attempt = 0; attempt < 64; ++attempt) {
      const InnerPoint from = {corners(start), {1.0 + attempt * 7 % 11, 1.0 + attempt * 5 % 13, 1.0 + attempt * 3 % 17}};
      if (const auto found = shoot(component, start, from, axis)) return *found;
    }
    vertices_.failSelfIntersection(triangle(start), blocker_);
  }

  /// Nothing if the ray grazes something.
  std::optional<uint32_t> shoot(const Component& component, uint32_t start, const InnerPoint& from, int axis) {
    std::vector<uint32_t> hits;  // tri-cut-faces in the order that the ray meets them
    for (uint32_t i = 0; i < cell_.triFaces.size(); ++i) {
      if (i == start) continue;
      const auto hit = intersect(i, start, from, axis);
      if (!hit) return {};
      if (*hit) hits.push_back(i);
    }
    const auto compare = [&](uint32_t i, uint32_t j) { return compareHeights(corners(i), corners(j), from, axis, predicates_); };
    std::sort(hits.begin(), hits.end(), [&](uint32_t i, uint32_t j) { return compare(i, j) > 0; });
    for (size_t i = 1; i < hits.size(); ++i) {
      if (compare(hits[i - 1], hits[i]) == 0) vertices_.failSelfIntersection(triangle(hits[i - 1]), triangle(hits[i]));
    }
    // Behind the last hit with a component its outer side is seen, so the ray is where it was before it met the component.
    size_t at = 0;
    const auto skip = [&](int32_t index) {
      for (size_t i = at; i < hits.size(); ++i) {
        if (componentOf_[hits[i]] == index) at = i + 1;
      }
    };
    skip(componentOf_[component.locals[0]]);
    while (at < hits.size()) {
      const uint32_t seen = 2 * hits[at] + (normalSign(corners(hits[at]), axis, predicates_) > 0 ? 1 : 0);
      const int32_t other = componentOf_[hits[at]];
      if (other < 0 || shells_.find(seen) != shells_.find(floating_[size_t(other)].outer)) return seen;
      skip(other);
    }
    return halfFaceBelow(from, axis);
  }

  /// Whether the ray hits the triangle inside of the grid cell; nothing if that is a close call.
  std::optional<bool> intersect(uint32_t local, uint32_t start, const InnerPoint& from, int axis) {
    const Corners t = corners(local);
    const int inside = insideOf(t, from, axis, predicates_);
    if (inside < 0) return false;
    if (inside == 0) return graze(local);
    const int normal = normalSign(t, axis, predicates_);
    const int startSide = normal * sideOfPlane(t, from, predicates_);
    if (startSide == 0) vertices_.failSelfIntersection(triangle(start), triangle(local));
    const double bottom = input_.planes[axis][stencil_.cells[cell_.stencilCell].at(axis)];
    const int bottomSide = normal * sideOfPlane(t, from, axis, bottom, predicates_);
    if (bottomSide == 0) return graze(local);
    return startSide > 0 && bottomSide < 0;
  }

  std::optional<bool> graze(uint32_t local) {
    blocker_ = triangle(local);
    return {};
  }

  /// The half-face of the lower grid-face across the axis that the ray leaves the grid cell through.
  std::optional<uint32_t> halfFaceBelow(const InnerPoint& from, int axis) {
    const uint32_t gridFace = stencil_.cells[cell_.stencilCell].faces[cellFace(axis, 0)];
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
        const std::array<uint32_t, 2> edge = {loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]};
        const int crossing = crossingOf(edge, from, axis);
        grazed |= crossing == 0;
        inside ^= crossing > 0;
      }
    }
    return inside && !grazed;
  }

  /// 1 if the ray to growing p crosses the edge, -1 if not, 0 if that is a close call.
  int crossingOf(std::array<uint32_t, 2> edge, const InnerPoint& from, int axis) {
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
  DisjointSets& shells_;
  Predicates& predicates_;
  std::vector<Component> floating_;
  std::vector<int32_t> componentOf_;  // per local tri-cut-face: index into floating_, or -1
  int64_t blocker_ = -1;
};

}  // namespace

void nestFloatingShells(const CellView& cell, DisjointSets& shells, Predicates& predicates) { Nester(cell, shells, predicates).run(); }

}  // namespace mandoline::detail
