// Cuts triangles, or pieces of them, by axial planes (paper, 4.1.2): by all, or by those between bricks.
//
// A hybrid edge is cut at all planes whichever planes cut the triangle: so pieces that are cut further have all vertices on their sides,
// and what two of them have in common is the same to both.
#pragma once

#include "cut/stages/brick_grid.h"
#include "cut/stages/polygon_halves.h"
#include "cut/stages/sweep.h"
#include "cut/stages/tri_edges.h"

namespace mandoline::detail {

/// Appends a vertex and the crossings of a tri-edge that leads on from it, in the direction in which it is traversed.
inline void appendEdge(const Surface& surface, VertexId from, TriEdgeId edge, bool forward, CornerRow& outline) {
  const CutVertices& vertices = surface.vertices;
  const Slab* slabs = vertices.slabs.data();
  const VertexId* offsets = vertices.crossingOffsets.data() + edge.number;
  const uint32_t first = offsets[0].number;
  uint32_t past = offsets[1].number;
  outline.makeRoom(past - first + 1);
  if (!surface.isPlain) {
    while (past > first && slabs[past - 1][0] == CutVertices::kUnused) --past;
  }
  const uint32_t count = past - first, last = uint32_t(vertices.slabs.size() - 1), step = forward ? 1 : ~0u;
  Corner* to = outline.lengthen(count + 1);
  *to++ = {from, slabs[from.number]};
  // Nearly always there are two at most, but how many can't be foretold: so these are written, and overwritten by what comes next.
  static_assert(CornerRow::kBlock >= 2);
  uint32_t v = forward ? first : past - 1;
  for (uint32_t i = 0; i < 2; ++i, v += step) *to++ = {{v}, slabs[std::min(v, last)]};
  for (uint32_t i = 2; i < count; ++i, v += step) *to++ = {{v}, slabs[v]};
}

/// The outline of a triangle, with all vertices on its sides.
inline void outlineOf(const Surface& surface, TriangleId triangle, CornerRow& outline) {
  outline.clear();
  const MeshEdges& edges = surface.edges();
  const auto t = surface.input.verticesOf(triangle);
  if (!edges.hasStitchedSide(triangle)) {
    const uint32_t* sides = &edges.sideEdges[3 * size_t(triangle.number)];
    appendEdge(surface, t[0], {sides[0]}, t[0] < t[1], outline);
    appendEdge(surface, t[1], {sides[1]}, t[1] < t[2], outline);
    return appendEdge(surface, t[2], {sides[2]}, t[2] < t[0], outline);
  }
  for (int side = 0; side < 3; ++side) {
    VertexId from = t[size_t(side)];
    edges.forSide(*surface.input.mesh, triangle, side, [&](TriEdgeId edge, bool forward) {
      appendEdge(surface, from, edge, forward, outline);
      from = edges.ends[edge][forward ? 1 : 0];
    });
  }
}

/// The least and the greatest slabs of something.
struct Extent {
  Slab least, greatest;

  /// Whether it lies in one closed grid element, which is element().
  bool isOneElement() const {
    bool isOne = true;
    for (size_t d = 0; d < 3; ++d) isOne &= inOneSlab(least[d], greatest[d]);
    return isOne;
  }
  Slab element() const {
    Slab element;
    for (size_t d = 0; d < 3; ++d) element[d] = slabBetween(least[d], greatest[d]);
    return element;
  }

  static Extent of(const Slab& a, const Slab& b, const Slab& c) {
    Extent extent;
    for (size_t d = 0; d < 3; ++d) {
      extent.least[d] = std::min(std::min(a[d], b[d]), c[d]);
      extent.greatest[d] = std::max(std::max(a[d], b[d]), c[d]);
    }
    return extent;
  }
  static Extent of(Polygon polygon) {
    Extent extent{polygon[0].slab, polygon[0].slab};
    for (const Corner& c : polygon) {
      for (size_t d = 0; d < 3; ++d) {
        extent.least[d] = std::min(extent.least[d], c.slab[d]);
        extent.greatest[d] = std::max(extent.greatest[d], c.slab[d]);
      }
    }
    return extent;
  }
};

/// Hands what it makes to an `Out`, with addVertex(slab), which gives its id, addHybridEdge(edge) and addPiece(polygon, grid element).
template <class Out>
class Dicer {
 public:
  /// Cuts by the planes between bricks, and the last ones of the grid; by all where there are no bricks.
  Dicer(const Input& input, const BrickGrid* bricks, Out& out) : input_(input), bricks_(bricks), out_(out) {}

  /// `extent`: the polygon's. `keepOutside`: pieces outside of the grid as well.
  void dice(TriangleId triangle, Polygon polygon, const Extent& extent, bool keepOutside = false) {
    triangle_ = triangle;
    keepOutside_ = keepOutside;
    Planes planes{kNoAxis, 0, 0};  // across the first axis of which some cut it
    for (size_t d = 3; d-- > 0;) {
      const int32_t least = extent.least[d], greatest = extent.greatest[d];
      nextAxis_[d] = planes.axis;
      const Planes across = {d, seamFrom(d, firstPlaneAfter(least)), lastPlaneBefore(greatest)};
      if (across.first <= across.last) {
        planes = across;
      } else if (!enter(d, slabBetween(least, greatest))) {
        return;
      }
    }
    if (planes.axis == kNoAxis) return out_.addPiece(polygon, element_);
    splitBy(planes, polygon, room_);
  }

  Predicates predicates;
  bool onlySweep = false;  ///< without polygon_halves.h: pieces are the same, but may begin elsewhere

 private:
  static constexpr size_t kNoAxis = 3;
  struct Planes {
    size_t axis;
    int32_t first, last;  // the polygon is cut by the first one
  };

  /// Cuts a convex polygon by the planes of `axis` and of those after it.
  void split(size_t axis, Polygon polygon, HalvesRoom& room) {
    for (; axis != kNoAxis; axis = nextAxis_[axis]) {
      const auto [least, greatest] = extent(polygon, axis);
      const int32_t first = seamFrom(axis, firstPlaneAfter(least)), last = lastPlaneBefore(greatest);
      if (first <= last) return splitBy({axis, first, last}, polygon, room);
      if (!enter(axis, slabBetween(least, greatest))) return;
    }
    out_.addPiece(polygon, element_);
  }

  /// The same where some of these planes cut it.
  void splitBy(const Planes& planes, Polygon polygon, HalvesRoom& room) {
    if (polygon.size() > PolygonHalves::kMostCorners || onlySweep) return sweep(planes, polygon, room);
    const auto [axis, plane, last] = planes;
    const PolygonHalves halves(polygon, axis, 2 * plane);
    room.line.clear();
    if (crossesPlanes(axis, halves.up(), halves.down())) {
      makeLine(axis, halves.up(), halves.down(), room.line, 0);
      addHybridEdges(axis, room.line.all());
    } else {
      addHybridEdge(axis, halves.up(), halves.down());
    }
    const auto [below, above] = halves.pieces(room);
    HalvesRoom& deeper = room.deeper();
    if (enter(axis, 2 * plane - 1)) split(nextAxis_[axis], below, deeper);
    const int32_t next = seamFrom(axis, plane + 1);
    if (next <= last) return splitBy({axis, next, last}, above, deeper);
    if (enter(axis, 2 * plane + 1)) split(nextAxis_[axis], above, deeper);
  }
  void sweep(const Planes& planes, Polygon polygon, HalvesRoom& room) {
    const size_t axis = planes.axis;
    Sweep sweep(polygon, axis, extent(polygon, axis).first, sweepRooms_[axis]);
    int32_t above = 0;
    for (int32_t plane = planes.first; plane <= planes.last; plane = seamFrom(axis, plane + 1)) {
      sweep.climb(2 * plane);
      makeLine(axis, sweep.up(), sweep.down(), sweep.unfinished(), polygon.size());
      sweep.close();
      addHybridEdges(axis, sweep.line());
      if (enter(axis, 2 * plane - 1)) split(nextAxis_[axis], sweep.piece(), room);
      sweep.beginAbove();
      above = 2 * plane + 1;
    }
    sweep.closeLast();
    if (enter(axis, above)) split(nextAxis_[axis], sweep.piece(), room);
  }

  /// The least slab along an axis, and the greatest.
  static std::pair<int32_t, int32_t> extent(Polygon polygon, size_t axis) {
    int32_t least = polygon[0].slab[axis], greatest = least;
    for (const Corner& c : polygon) {
      least = std::min(least, c.slab[axis]);
      greatest = std::max(greatest, c.slab[axis]);
    }
    return {least, greatest};
  }

  /// The first of the planes to cut by that is not below `plane`; beyond all planes if there is none.
  int32_t seamFrom(size_t axis, int32_t plane) const {
    return !bricks_ || plane > bricks_->cells[axis] ? plane : bricks_->planeFrom(axis, plane);
  }

  /// Goes on with what lies between two planes of the axis, or on one, in one of the slabs there. False if it is left out.
  bool enter(size_t axis, int32_t slab) {
    element_[axis] = slab;
    return keepOutside_ || (slab >= 0 && slab <= 2 * input_.cells(int(axis)));
  }

  static constexpr std::array<size_t, 5> kAxes{0, 1, 2, 0, 1};

  /// The pieces of a hybrid edge between its vertices, which lies in a plane across the axis.
  void addHybridEdges(size_t axis, Polygon line) {
    for (size_t i = 1; i < line.size(); ++i) addHybridEdge(axis, line[i - 1], line[i]);
  }
  void addHybridEdge(size_t axis, const Corner& from, const Corner& to) {
    const size_t d = kAxes[axis + 1], e = kAxes[axis + 2];
    Slab element = from.slab;
    element[d] = between(from.slab[d], to.slab[d]);
    element[e] = between(from.slab[e], to.slab[e]);
    if (onPlane(element[d] & element[e])) return;  // it lies on a grid line
    if (keepOutside_ || input_.inGrid(element)) out_.addHybridEdge({element, from.id, to.id});
  }

  /// Whether a segment in a plane across the axis crosses others.
  static bool crossesPlanes(size_t axis, const Corner& from, const Corner& to) {
    const auto crosses = [&](size_t d) { return !inOneSlab(std::min(from.slab[d], to.slab[d]), std::max(from.slab[d], to.slab[d])); };
    return crosses(kAxes[axis + 1]) || crosses(kAxes[axis + 2]);
  }

  /// Calls f(plane, step) for the planes strictly between two slabs, in order.
  template <class F>
  static void forPlanes(int32_t from, int32_t to, const F& f) {
    const int step = to > from ? 1 : -1;
    const int32_t past = step > 0 ? lastPlaneBefore(to) + 1 : firstPlaneAfter(to) - 1;
    for (int32_t i = step > 0 ? firstPlaneAfter(from) : lastPlaneBefore(from); step > 0 ? i < past : i > past; i += step) f(i, step);
  }

  /// Adds the vertices of a hybrid edge a -> b, which lies in a plane across the axis: its crossings with planes across the next axis, at
  /// heights along the one after that, which are up to P2; and with planes across that one in between. Makes room for some more.
  void makeLine(size_t axis, const Corner& a, const Corner& b, CornerRow& line, size_t more) {
    const size_t along = kAxes[axis + 1], height = kAxes[axis + 2];
    const size_t most = planesTo(a.slab[along], b.slab[along]) + planesTo(a.slab[height], b.slab[height]);
    line.makeRoom(most + more + 2);
    line.add(a);
    if (most > 0) {
      Corner at = a;
      forPlanes(a.slab[along], b.slab[along], [&](int32_t j, int step) {
        Slab slab;
        slab[axis] = a.slab[axis];
        slab[along] = 2 * j;
        slab[height] = heightOf(slab, height, step, at.slab[height], b.slab[height]);
        climb(at, slab, height, line);
        at = {out_.addVertex(slab), slab};
        line.add(at);
      });
      climb(at, b.slab, height, line);
    }
    line.add(b);
  }

  /// The slab inside of a segment that crosses no plane, along an axis.
  static int32_t between(int32_t a, int32_t b) { return slabBetween(std::min(a, b), std::max(a, b)); }
  /// The number of planes strictly between two slabs.
  static size_t planesTo(int32_t a, int32_t b) {
    return size_t(std::max(lastPlaneBefore(std::max(a, b)) + 1 - firstPlaneAfter(std::min(a, b)), 0));
  }

  /// Appends the crossings with planes across `height` strictly between two points of a hybrid edge that has no other crossings there.
  void climb(const Corner& from, const Slab& to, size_t height, CornerRow& line) {
    Slab slab = elementBetween(from.slab, to);
    forPlanes(from.slab[height], to[height], [&](int32_t k, int) {
      slab[height] = 2 * k;
      line.add({out_.addVertex(slab), slab});
    });
  }

  /// P2: the slab along `height` at which the triangle meets a grid line, whose planes are those of `line`. It lies strictly between two
  /// slabs of the hybrid edge in one of these planes (or all are the same); the edge runs upwards across the other one, by `step`, where
  /// the triangle's normal points up along `height`.
  int32_t heightOf(const Slab& line, size_t height, int step, int32_t from, int32_t to) {
    if (inOneSlab(std::min(from, to), std::max(from, to))) return between(from, to);
    const auto t = input_.verticesOf(triangle_);
    const int way = to > from ? 1 : -1;
    Point p;
    for (size_t d = 0; d < 3; ++d) {
      if (d != height) p[d] = input_.planes[d][size_t(line[d] >> 1)];
    }
    const int32_t last = way > 0 ? lastPlaneBefore(to) : firstPlaneAfter(to);
    for (int32_t k = way > 0 ? firstPlaneAfter(from) : lastPlaneBefore(from); way > 0 ? k <= last : k >= last; k += way) {
      p[height] = input_.planes[height][size_t(k)];
      const int above =  // the sign of the triangle's height less plane k
          -step * predicates.orient3d(input_.point(t[0]).data(), input_.point(t[1]).data(), input_.point(t[2]).data(), p.data());
      if (above == 0) return 2 * k;
      if (above != way) return 2 * k - way;
    }
    return 2 * last + way;
  }

  const Input& input_;
  const BrickGrid* bricks_;
  Out& out_;
  TriangleId triangle_{0};
  bool keepOutside_ = false;
  std::array<size_t, 3> nextAxis_{};  // after an axis: across which planes cut the polygon
  Slab element_{};                    // of the piece, for the axes by which it has been cut
  HalvesRoom room_;
  std::array<SweepRoom, 3> sweepRooms_;  // per axis
};

}  // namespace mandoline::detail
