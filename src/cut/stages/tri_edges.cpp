#include "cut/stages/tri_edges.h"

#include <cstring>

#include "base/run_tasks.h"

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
  int32_t next[3], left[3];  // planes
  for (int d = 0; d < 3; ++d) {
    const int32_t first = firstPlaneAfter(std::min(from[d], to[d])), last = lastPlaneBefore(std::max(from[d], to[d]));
    step[d] = (to[d] > from[d]) - (to[d] < from[d]);
    next[d] = step[d] > 0 ? first : last;
    left[d] = last - first + 1;  // not positive if there are none
    if (onPlane(from[d])) at[d] += step[d];
  }
  size_t count = 0;
  for (;;) {
    int first = -1;
    bool tied[3] = {};
    for (int d = 0; d < 3; ++d) {
      if (left[d] <= 0) continue;
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
      --left[d];
    }
    out[count++] = crossing;
  }
}

/// The same where it crosses one plane alone.
Slab crossOnePlane(const Input& input, const std::array<VertexId, 2>& ends) {
  const Slab &from = input.slabs[ends[0]], &to = input.slabs[ends[1]];
  Slab crossing;
  for (size_t d = 0; d < 3; ++d) {
    const int32_t least = std::min(from[d], to[d]), greatest = std::max(from[d], to[d]);
    crossing[d] = inOneSlab(least, greatest) ? slabBetween(least, greatest) : 2 * firstPlaneAfter(least);
  }
  return crossing;
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

/// Ids for the crossings of all tri-edges, and which of these lie in an axial plane.
class CrossingLayout {
 public:
  CrossingLayout(Surface& surface, const KnownCrossings* known) : surface_(surface), vertices_(surface.vertices), known_(known) {}

  /// How many there are; which ids they have is found next.
  void count(Monitor& monitor) {
    const size_t edges = surface_.edges().ends.size();
    vertices_.crossingOffsets.resize(edges + 1);
    chunks_ = forChunks<Chunk>(edges, monitor, [&](Chunk& chunk, size_t begin, size_t end) {
      layOut({uint32_t(begin)}, {uint32_t(end)}, chunk);
      chunk.past = end;
    });
    uint64_t total = surface_.input.slabs.size();
    for (const Chunk& chunk : chunks_) total += chunk.crossings;
    requireFewVertices(total);
    vertices_.firstInTriangle = {uint32_t(total)};
  }
  void number() {
    uint32_t before = uint32_t(surface_.input.slabs.size());
    VertexId* offset = vertices_.crossingOffsets.data();
    for (const Chunk& chunk : chunks_) {
      for (VertexId* const past = vertices_.crossingOffsets.data() + chunk.past; offset < past; ++offset) offset->number += before;
      before += uint32_t(chunk.crossings);
      surface_.inPlane.insert(surface_.inPlane.end(), chunk.inPlane.begin(), chunk.inPlane.end());
    }
    *offset = vertices_.firstInTriangle;
  }

 private:
  /// Of some tri-edges, whose offsets count from the first of them on until it is known what comes before.
  struct Chunk {
    size_t past = 0;  ///< the edge after them
    uint64_t crossings = 0;
    std::vector<TriEdgeId> inPlane;
  };

  void layOut(TriEdgeId e, TriEdgeId past, Chunk& chunk) {
    while (e < past) {
      const TriEdgeId pastKnown = known_ ? known_->pastKnown(e, past) : e;
      if (e < pastKnown) {
        layOutKnown(e, pastKnown, chunk);
        e = pastKnown;
      } else {
        const TriEdgeId pastNew = known_ ? TriEdgeId{e.number + 1} : past;
        layOutNew(e, pastNew, chunk);
        e = pastNew;
      }
    }
  }

  void layOutNew(TriEdgeId first, TriEdgeId past, Chunk& chunk) {
    const std::array<VertexId, 2>* ends = surface_.edges().ends.data();
    const Slab* slabs = surface_.input.slabs.data();
    VertexId* offsets = vertices_.crossingOffsets.data();
    uint64_t crossings = chunk.crossings;
    for (const TriEdgeId e : Ids<TriEdgeId>(first, past)) {
      const auto& [low, high] = ends[e.number];
      const PlanesBetween between = planesBetween(slabs[low.number], slabs[high.number]);
      if (between.hasBoth && surface_.here.has(e)) chunk.inPlane.push_back(e);
      offsets[e.number] = {uint32_t(crossings)};
      crossings += between.count;
    }
    chunk.crossings = crossings;
  }

  void layOutKnown(TriEdgeId first, TriEdgeId past, Chunk& chunk) {
    const Surface& known = known_->surface();
    const VertexId* offsets = known.vertices.crossingOffsets.data();
    const uint32_t shift = uint32_t(chunk.crossings) - offsets[first.number].number;
    VertexId* to = vertices_.crossingOffsets.data();
    for (uint32_t e = first.number; e < past.number; ++e) to[e] = {offsets[e].number + shift};
    chunk.crossings += offsets[past.number].number - offsets[first.number].number;
    const auto begin = std::lower_bound(known.inPlane.begin(), known.inPlane.end(), first),
               end = std::lower_bound(begin, known.inPlane.end(), past);
    chunk.inPlane.insert(chunk.inPlane.end(), begin, end);
  }

  Surface& surface_;
  CutVertices& vertices_;
  const KnownCrossings* known_;
  std::vector<Chunk> chunks_;
};

void cutEdge(TriEdgeId e, Surface& surface, bool onlyGeneral, Predicates& predicates) {
  CutVertices& vertices = surface.vertices;
  const uint32_t first = vertices.crossingOffsets[e.number].number, past = vertices.crossingOffsets[e.number + 1].number;
  if (first == past) return;
  Slab* const slabs = &vertices.slabs[first];
  const std::array<VertexId, 2>& ends = surface.edges().ends[e];
  size_t count = 0;
  if (past - first == 1 && surface.here.has(e) && !onlyGeneral) {
    slabs[count++] = crossOnePlane(surface.input, ends);
  } else if (surface.here.has(e)) {
    count = crossEdge(surface.input, ends, surface.edges().line(e), slabs, predicates);
  }
  for (uint32_t v = first; v < past; ++v) vertices.parentEdges[v - vertices.firstOnEdge.number] = e;
  for (size_t i = count; i < past - first; ++i) slabs[i] = CutVertices::kNone;
}

/// Those of tri-edges first .. past - 1.
void copyCrossings(const CutVertices& known, TriEdgeId first, TriEdgeId past, CutVertices& vertices) {
  const size_t from = known.crossingOffsets[first.number].number, end = known.crossingOffsets[past.number].number,
               to = vertices.crossingOffsets[first.number].number;
  std::copy(known.slabs.begin() + ptrdiff_t(from), known.slabs.begin() + ptrdiff_t(end), vertices.slabs.begin() + ptrdiff_t(to));
  const auto parents = known.parentEdges.begin() + ptrdiff_t(from - known.firstOnEdge.number);
  std::copy(parents, parents + ptrdiff_t(end - from), vertices.parentEdges.begin() + ptrdiff_t(to - vertices.firstOnEdge.number));
}

/// Pieces of tri-edges that lie in an axial plane, but not on a grid line.
void collectInPlane(Surface& surface) {
  const Input& input = surface.input;
  const CutVertices& vertices = surface.vertices;
  const MeshEdges& edges = surface.edges();
  for (const TriEdgeId e : surface.inPlane) {
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

/// Whether each of vertices first .. past - 1 lies on so many planes.
bool areOn(int planes, const Slab* slabs, size_t first, size_t past) {
  bool isAnyOther = false;
  for (size_t v = first; v < past; ++v) isAnyOther |= planeCount(slabs[v]) != planes;
  return !isAnyOther;
}

/// Cuts tri-edges first .. past - 1. Whether their crossings lie on one plane each; not where some ids of crossings are unused.
template <class CutEdge>
bool cutEdges(TriEdgeId first, TriEdgeId past, Surface& surface, const KnownCrossings* known, const CutEdge& cutNew) {
  CutVertices& vertices = surface.vertices;
  const auto areOnOne = [&](TriEdgeId begin, TriEdgeId end) {
    return areOn(1, vertices.slabs.data(), vertices.crossingOffsets[begin.number].number, vertices.crossingOffsets[end.number].number);
  };
  bool areAll = true;
  for (TriEdgeId e = first; e < past;) {
    const TriEdgeId pastKnown = known ? known->pastKnown(e, past) : e;
    if (e < pastKnown) {
      copyCrossings(known->surface().vertices, e, pastKnown, vertices);
      areAll = areAll && (known->surface().isPlain || areOnOne(e, pastKnown));
      e = pastKnown;
    } else {
      cutNew(e);
      areAll = areAll && areOnOne(e, {e.number + 1});
      ++e.number;
    }
  }
  return areAll;
}

/// Surface::unpaired.
IdVector<TriangleId, uint8_t> findUnpaired(const Input& input) {
  const MeshEdges& edges = input.mesh->edges;
  if (edges.unpaired) return *edges.unpaired;
  IdVector<TriEdgeId, uint8_t> uses(edges.ends.size(), 0);
  IdVector<TriangleId, uint8_t> unpaired(input.mesh->triangles.size());
  const auto forKept = [&](const auto& f) {
    for (const TriangleId t : unpaired.ids()) {
      if (input.kept(t)) edges.forTriangle(t, [&](TriEdgeId e) { f(t, uses[e]); });
    }
  };
  forKept([](TriangleId, uint8_t& count) { count += count < 3; });
  forKept([&](TriangleId t, uint8_t count) { unpaired[t] |= count != 2; });
  return unpaired;
}

}  // namespace

CrossingsBefore::CrossingsBefore(const Surface& before, const Surface& now, const Moved& moved)
    : before_(before),
      areKnown_(before.edges().lines.empty() && now.edges().lines.empty() &&
                (before.edges().ends.empty() || before.edges().ends == now.edges().ends)) {
  if (!areKnown_) return;
  haveMoved_.resize(now.edges().ends.size());
  for (const TriEdgeId e : haveMoved_.ids()) {
    const auto& [low, high] = now.edges().ends[e];
    haveMoved_[e] = moved[low] | moved[high];
  }
}

TriEdgeId CrossingsBefore::pastKnown(TriEdgeId first, TriEdgeId past) const {
  if (!areKnown_ || first == past) return first;
  const uint8_t* const edges = haveMoved_.data();
  const void* const found = std::memchr(edges + first.number, 1, past.number - first.number);
  return found ? TriEdgeId{uint32_t(static_cast<const uint8_t*>(found) - edges)} : past;
}

uint32_t crossingIds(const Slab& low, const Slab& high) { return planesBetween(low, high).count; }

void requireFewVertices(uint64_t count) {
  if (count >= uint64_t(1) << 31) throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices."}};
}

void cutTriEdges(Surface& surface, Run& run, const KnownCrossings* known) {
  const Input& input = surface.input;
  CutVertices& vertices = surface.vertices;
  vertices.input = &input;
  vertices.edges = &surface.edges();
  vertices.firstOnEdge = {uint32_t(input.slabs.size())};
  CrossingLayout layout(surface, known);
  layout.count(run.monitor);
  const auto makeSlabs = [&] {
    vertices.slabs.reserve(vertices.firstInTriangle.number + vertices.firstInTriangle.number / 16);  // and for those on seams
    vertices.slabs.assign(input.slabs.begin(), input.slabs.end());
    vertices.slabs.resize(vertices.firstInTriangle.number);
  };
  const auto numberRest = [&] {
    layout.number();
    vertices.parentEdges.resize(vertices.firstInTriangle.number - input.slabs.size());
  };
  runBoth(makeSlabs, numberRest, run.monitor);
  struct Chunk {
    Predicates predicates;
    bool areOnOne = true;
  };
  const auto chunks = forChunks<Chunk>(surface.edges().ends.size(), run.monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    const auto cutNew = [&](TriEdgeId e) { cutEdge(e, surface, run.onlyGeneral, chunk.predicates); };
    chunk.areOnOne &= cutEdges({uint32_t(begin)}, {uint32_t(end)}, surface, known, cutNew);
  });
  surface.isPlain = areOn(0, vertices.slabs.data(), 0, vertices.firstOnEdge.number);
  for (const Chunk& chunk : chunks) {
    run.count(chunk.predicates);
    surface.isPlain = surface.isPlain && chunk.areOnOne;
  }
  surface.unpaired = findUnpaired(input);
  collectInPlane(surface);
}

}  // namespace mandoline::detail
