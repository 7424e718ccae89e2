#include "cut/stages/tri_edges.h"

namespace mandoline::detail {
namespace {

/// An axial plane that an edge crosses.
struct CrossedPlane {
  int axis;
  double coordinate;
  bool upwards;  ///< whether the edge ascends along the axis
};

/// P1: order of the crossings of edge a -> b with two planes, by place along the edge.
int compareCrossings(const Point& a, const Point& b, const CrossedPlane& u, const CrossedPlane& v, Predicates& predicates) {
  const int d = u.axis, e = v.axis;
  const double x = u.coordinate, y = v.coordinate;
  const double s = (x - a[d]) / (b[d] - a[d]), t = (y - a[e]) / (b[e] - a[e]);
  constexpr double bound = 10 * kRoundoff;  // each is in [0, 1] and has three roundings
  if (std::fabs(s - t) > bound) return signOf(s - t);
  // (x - a.d) (b.e - a.e) - (y - a.e) (b.d - a.d) has the sign of (s - t) (b.d - a.d) (b.e - a.e), and is the orientation of (b, (x, y))
  // about a.
  const int orientation = -predicates.orient2d({a[d], a[e]}, {b[d], b[e]}, {x, y});
  return u.upwards == v.upwards ? orientation : -orientation;
}

/// P1 on a line in two triangles' planes.
int compareCrossings(const WeldedMesh& mesh, const Line& line, const CrossedPlane& u, const CrossedPlane& v, Predicates& predicates) {
  const Point r = mesh.points[mesh.triangles[line.a][0]];
  const int beyond = predicates.sign([&](auto number) {  // where the line meets the first plane: against the second, times w
    using Number = decltype(number);
    const Plane<Number> plane{{{Number(u.axis == 0), Number(u.axis == 1), Number(u.axis == 2)}},
                              Number::difference(u.coordinate, r[size_t(u.axis)])};
    const Homogeneous<Number> h = meetingPoint(planeOf<Number>(mesh, line.a, r), planeOf<Number>(mesh, line.b, r), plane);
    return h.x[v.axis] - Number::difference(v.coordinate, r[size_t(v.axis)]) * h.w;
  });
  return u.upwards == v.upwards ? beyond : -beyond;  // w is the line's direction along the first axis
}

/// Writes the slabs of an edge's crossings, from its lower end on, to `out`; returns how many. Crossings at one point are one.
size_t crossEdge(const Input& input, const std::array<VertexId, 2>& ends, const Line& line, Slab* out, Predicates& predicates) {
  const Slab &from = input.slabs[ends[0]], &to = input.slabs[ends[1]];
  Slab at = from;  // slabs just before the next crossing
  int step[3];
  int32_t next[3], last[3];
  for (int d = 0; d < 3; ++d) {
    step[d] = (to[d] > from[d]) - (to[d] < from[d]);
    next[d] = step[d] > 0 ? firstPlaneAfter(from[d]) : lastPlaneBefore(from[d]);
    last[d] = step[d] > 0 ? lastPlaneBefore(to[d]) : firstPlaneAfter(to[d]);
    if (onPlane(from[d])) at[d] += step[d];
  }
  const auto pending = [&](int d) { return step[d] > 0 ? next[d] <= last[d] : step[d] < 0 && next[d] >= last[d]; };
  size_t count = 0;
  for (;;) {
    int first = -1;
    bool tied[3] = {};
    for (int d = 0; d < 3; ++d) {
      if (!pending(d)) continue;
      const auto planeOf = [&](int axis) { return CrossedPlane{axis, input.planes[axis][next[axis]], step[axis] > 0}; };
      const int order = first < 0       ? -1
                        : line.ofPlanes ? compareCrossings(*input.mesh, line, planeOf(d), planeOf(first), predicates)
                                        : compareCrossings(input.mesh->points[line.a], input.mesh->points[line.b], planeOf(d),
                                                           planeOf(first), predicates);
      if (order < 0) tied[0] = tied[1] = tied[2] = false;
      if (order <= 0) tied[d] = true;
      if (order < 0) first = d;
    }
    if (first < 0) return count;
    Slab crossing = at;
    for (int d = 0; d < 3; ++d) {
      if (!tied[d]) continue;
      crossing[d] = 2 * next[d];
      at[d] = crossing[d] + step[d];
      next[d] += step[d];
    }
    out[count++] = crossing;
  }
}

struct PlanesBetween {
  uint32_t count;  ///< strictly between two slabs, along all axes
  bool hasBoth;    ///< whether one has both slabs
};

PlanesBetween planesBetween(const Slab& a, const Slab& b) {
  uint32_t count = 0, both = 0;
  for (size_t d = 0; d < 3; ++d) {
    const int32_t first = firstPlaneAfter(std::min(a[d], b[d])), last = lastPlaneBefore(std::max(a[d], b[d]));
    const uint32_t isBoth = uint32_t(a[d] == b[d]) & uint32_t(onPlane(a[d]));
    count += uint32_t(last - first + 1) + isBoth;  // for which last is first - 2
    both |= isBoth;
  }
  return {count, both != 0};
}

/// Pieces of tri-edges that lie in an axial plane, but not on a grid line; `inPlane`: all edges in such a plane.
void collectInPlane(const std::vector<TriEdgeId>& inPlane, Surface& surface) {
  const Input& input = surface.input;
  const CutVertices& vertices = surface.vertices;
  const MeshEdges& edges = surface.edges();
  for (const TriEdgeId e : inPlane) {
    VertexId from = edges.ends[e][0];
    const auto piece = [&](VertexId to) {
      const Slab element = elementBetween(vertices.slab(from), vertices.slab(to));
      if (planeCount(element) == 1 && input.inGrid(element)) surface.edgesInPlane.push_back({element, from, to});
      from = to;
    };
    for (const VertexId v : vertices.crossings(e)) {
      if (vertices.isUsed(v)) piece(v);
    }
    piece(edges.ends[e][1]);
  }
}

}  // namespace

CrossingsBefore::CrossingsBefore(const Surface& before, const Surface& now, const Moved& moved) {
  const MeshEdges &were = before.edges(), &are = now.edges();
  if (!were.lines.empty() || !are.lines.empty() || were.ends != are.ends) return;
  before_ = &before;
  moved_ = &moved;
}

const Slab* CrossingsBefore::find(TriEdgeId edge) const {
  if (!before_) return nullptr;
  const auto& [low, high] = before_->edges().ends[edge];
  if ((*moved_)[low] || (*moved_)[high]) return nullptr;
  return &before_->vertices.slabs[(*before_->vertices.crossings(edge).begin()).number];
}

void cutTriEdges(Surface& surface, Run& run, const KnownCrossings* known) {
  const Input& input = surface.input;
  const MeshEdges& edges = surface.edges();
  CutVertices& vertices = surface.vertices;
  const size_t edgeCount = edges.ends.size();
  vertices.input = &input;
  vertices.edges = &edges;
  vertices.firstOnEdge = {uint32_t(input.slabs.size())};
  vertices.crossingOffsets.resize(edgeCount + 1);
  uint64_t total = input.slabs.size();
  std::vector<TriEdgeId> inPlane;
  for (const TriEdgeId e : edges.ends.ids()) {
    const Slab &low = input.slabs[edges.ends[e][0]], &high = input.slabs[edges.ends[e][1]];
    const PlanesBetween between = planesBetween(low, high);
    if (between.hasBoth && surface.here.has(e)) inPlane.push_back(e);
    vertices.crossingOffsets[e.number] = {uint32_t(total)};
    total += between.count;
    if (total >= uint64_t(1) << 31) throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices."}};
  }
  vertices.crossingOffsets[edgeCount] = {uint32_t(total)};
  vertices.firstInTriangle = {uint32_t(total)};
  vertices.slabs.assign(input.slabs.begin(), input.slabs.end());
  vertices.slabs.resize(total);
  vertices.parentEdges.resize(total - input.slabs.size());
  const auto chunks = forChunks<Predicates>(edgeCount, run.monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (const TriEdgeId e : Ids<TriEdgeId>(begin, end)) {
      const Ids<VertexId> crossings = vertices.crossings(e);
      if (crossings.empty()) continue;
      const VertexId first = *crossings.begin();
      for (const VertexId v : crossings) vertices.parentEdges[v.number - vertices.firstOnEdge.number] = e;
      if (const Slab* slabs = known ? known->find(e) : nullptr) {
        for (const VertexId v : crossings) vertices.slabs[v.number] = slabs[v.number - first.number];
        continue;
      }
      const size_t count =
          !surface.here.has(e) ? 0 : crossEdge(input, edges.ends[e], edges.line(e), &vertices.slabs[first.number], predicates);
      for (const VertexId v : crossings) {
        if (v.number >= first.number + count) vertices.slabs[v.number] = CutVertices::kNone;
      }
    }
  });
  for (const Predicates& p : chunks) run.count(p);
  collectInPlane(inPlane, surface);
}

}  // namespace mandoline::detail
