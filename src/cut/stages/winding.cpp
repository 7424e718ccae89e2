#include "cut/stages/winding.h"

#include "cut/stages/face_parents.h"

namespace mandoline::detail {
namespace {

/// Which triangles count, and how: all of a mesh that has winding numbers, or those of parts that have them, or that have parity.
class Counted {
 public:
  explicit Counted(const Prepared& mesh) : mesh_(mesh) {}
  /// Of parts that are at most as bad; modulo 2 unless those have winding numbers.
  Counted(const Prepared& mesh, PartKind worst) : mesh_(mesh), worst_(worst) {}

  bool has(TriangleId t) const { return mesh_.parts.kinds.empty() || mesh_.parts.kinds[t.number] <= worst_; }
  /// The sum of the signs of a kept triangle and its duplicates.
  int32_t signSum(TriangleId t) const {
    int32_t sum = has(t);
    for (const Duplicate& d : mesh_.duplicatesOf(t)) sum += !has({d.triangle}) ? 0 : d.sameWay ? 1 : -1;
    return sum;
  }
  bool areEqual(int32_t a, int32_t b) const { return worst_ == PartKind::winding ? a == b : (a - b) % 2 == 0; }

 private:
  const Prepared& mesh_;
  PartKind worst_ = PartKind::winding;
};

/// Winding number of the counted triangles about the point (x0 + e^3, y0 + e, z0 + e^2), where (x0, y0, z0) is the grid's lowest corner and
/// e is arbitrarily small: the sum of the signs of the crossings of the ray from there to -x.
int windingAtLowestCorner(const Input& input, const Counted& counted, Predicates& predicates) {
  const Point o = {input.planes[0][0], input.planes[1][0], input.planes[2][0]};
  int winding = 0;
  for (const TriangleId t : input.triangleIds()) {
    if (!input.kept(t)) continue;
    const int32_t copies = counted.signSum(t);
    if (copies == 0) continue;
    const auto v = input.verticesOf(t);
    const Slab &sa = input.slabs[v[0]], &sb = input.slabs[v[1]], &sc = input.slabs[v[2]];
    if (std::min({sa[0], sb[0], sc[0]}) > 0) continue;
    if (std::min({sa[1], sb[1], sc[1]}) > 0 || std::max({sa[1], sb[1], sc[1]}) <= 0) continue;
    if (std::min({sa[2], sb[2], sc[2]}) > 0 || std::max({sa[2], sb[2], sc[2]}) < 0) continue;
    const Point &a = input.point(v[0]), &b = input.point(v[1]), &c = input.point(v[2]);
    const auto sideOf = [&](const Point& p, const Point& q) {  // of the shifted point about p -> q, seen along -x
      const int side = predicates.orient2d({p[1], p[2]}, {q[1], q[2]}, {o[1], o[2]});
      if (side != 0) return side;
      const int byY = -signOf(q[2] - p[2]);
      return byY != 0 ? byY : signOf(q[1] - p[1]);
    };
    const int side = sideOf(a, b);
    if (side == 0 || side != sideOf(b, c) || side != sideOf(c, a)) continue;  // side is now the sign of the normal's x
    int above = predicates.orient3d(a.data(), b.data(), c.data(), o.data());
    if (above == 0) above = predicates.orient2d({a[2], a[0]}, {b[2], b[0]}, {c[2], c[0]});
    if (above == 0) above = predicates.orient2d({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
    if (above == 0) above = side;
    if (above == side) winding -= side * copies;  // the point lies beyond the triangle along +x, so the ray meets it
  }
  return winding;
}

/// The region that holds the point of windingAtLowestCorner.
uint32_t regionAtLowestCorner(const CutVertices& vertices, const Sides& sides, const Regions& regions) {
  const Stencil& stencil = sides.stencil;
  if (stencil.cells.empty() || stencil.cells.front().element != Slab{1, 1, 1}) return regions.runRegion[0];
  // Its grid-face x = x0 holds the point's shadow right beside the y-axis: in the face with the directed edge from the corner along y.
  for (const HalfFace fromBelow : sides.faces.grid.halfFaces[stencil.cells.front().faces[cellFace(0, 0)]]) {
    const bool reversed = fromBelow.side() == 1;  // a triangle's face whose normal is -x
    const auto loop = sides.faces.loops(fromBelow.face())[0];
    for (size_t i = 0; i < loop.size(); ++i) {
      VertexId u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
      if (reversed) std::swap(u, v);
      const bool found = vertices.slabs[u] == Slab{0, 0, 0} && vertices.slabs[v][0] == 0 && vertices.slabs[v][2] == 0;
      if (found) return regions.cellRegion[sides.cell(fromBelow.twin())];
    }
  }
  return regions.runRegion[0];
}

/// Disjoint sets of regions whose winding numbers are known relative to each other.
class WindingSets {
 public:
  explicit WindingSets(uint32_t count) : parent_(count), toParent_(count, 0) {
    for (uint32_t r = 0; r < count; ++r) parent_[r] = r;
  }

  uint32_t find(uint32_t r) {
    uint32_t root = r;
    int32_t sum = 0;
    for (; parent_[root] != root; root = parent_[root]) sum += toParent_[root];
    for (uint32_t at = r; at != root;) {
      const uint32_t up = parent_[at];
      const int32_t step = toParent_[at];
      parent_[at] = root;
      toParent_[at] = sum;
      sum -= step;
      at = up;
    }
    return root;
  }
  /// The winding number of r less that of its root; call find(r) before.
  int32_t toRoot(uint32_t r) const { return toParent_[r]; }

  /// Says that r has `step` more than s; false if that contradicts what was said before.
  bool setMore(uint32_t r, uint32_t s, int32_t step, const Counted& counted) {
    const uint32_t rootR = find(r), rootS = find(s);
    if (rootR == rootS) return counted.areEqual(toRoot(r), toRoot(s) + step);
    toParent_[rootR] = toRoot(s) + step - toRoot(r);
    parent_[rootR] = rootS;
    return true;
  }

 private:
  std::vector<uint32_t> parent_;
  std::vector<int32_t> toParent_;  // winding number less the parent's; 0 of a root
};

[[noreturn]] void failAt(const CutVertices& vertices, const Sides& sides, FaceId face) {
  const auto triangle = sides.faces.triangle(face);
  std::optional<TriangleId> other;  // another triangle in the same grid cell
  for (const HalfFace h : sides.cells.halfFaces[sides.cell(HalfFace(face, 0))]) {
    const auto found = sides.faces.triangle(h.face());
    if (found && found != triangle) other = found;
  }
  vertices.failSelfIntersection(triangle, other);
}

/// Per region the winding number of the counted triangles.
std::vector<int32_t> windingOf(const Surface& surface, const Sides& sides, const Regions& regions, const Counted& counted,
                               Predicates& predicates) {
  WindingSets sets(regions.count);
  FaceParents parents(surface.input, sides.faces.tri);
  for (const FaceId face : sides.faces.tri.ids()) {
    const CellId behind = sides.cell(HalfFace(face, 0)), inFront = sides.cell(HalfFace(face, 1));
    if (behind == Sides::kNone || inFront == Sides::kNone) continue;  // on the boundary of the grid
    int32_t step = 0;
    parents.forEach(face, [&](TriangleId t, bool sameWay) { step += !counted.has(t) ? 0 : sameWay ? 1 : -1; });
    const uint32_t regionBehind = regions.cellRegion[behind], regionInFront = regions.cellRegion[inFront];
    if (!sets.setMore(regionBehind, regionInFront, step, counted)) failAt(surface.vertices, sides, face);
  }
  const uint32_t anchor = regionAtLowestCorner(surface.vertices, sides, regions), root = sets.find(anchor);
  const int32_t shift = windingAtLowestCorner(surface.input, counted, predicates) - sets.toRoot(anchor);
  std::vector<int32_t> winding(regions.count);
  for (uint32_t r = 0; r < regions.count; ++r) winding[r] = sets.find(r) == root ? shift + sets.toRoot(r) : 0;
  return winding;
}

}  // namespace

void findWinding(const Surface& surface, const Sides& sides, Regions& regions, Predicates& predicates) {
  const Prepared& mesh = *surface.input.mesh;
  const PartCounts& parts = mesh.parts.counts;
  regions.hasWinding = mesh.closed;
  if (mesh.closed) {
    regions.winding = windingOf(surface, sides, regions, Counted(mesh), predicates);
    return;
  }
  if (parts.winding > 0) {
    regions.partWinding = windingOf(surface, sides, regions, {mesh, PartKind::winding}, predicates);
  }
  if (parts.winding + parts.parity > 0) {
    for (const int32_t crossings : windingOf(surface, sides, regions, {mesh, PartKind::parity}, predicates)) {
      regions.parity.push_back(uint8_t(crossings & 1));
    }
  }
}

}  // namespace mandoline::detail
