// Cuts triangles, or pieces of them, by axial planes (paper, 4.1.2): by all, or by those between bricks.
//
// A hybrid edge is cut at all planes whichever planes cut the triangle: so pieces that are cut further have all vertices on their sides,
// and what two of them have in common is the same to both.
#pragma once

#include "cut/stages/sweep.h"
#include "cut/stages/tri_edges.h"

namespace mandoline::detail {

/// The outline of a triangle, with all vertices on its sides.
inline void outlineOf(const Surface& surface, TriangleId triangle, Polygon& outline) {
  const CutVertices& vertices = surface.vertices;
  outline.clear();
  const auto add = [&](VertexId v) { outline.push_back({v, vertices.slab(v)}); };
  const auto t = surface.input.verticesOf(triangle);
  for (int side = 0; side < 3; ++side) {
    VertexId from = t[size_t(side)];
    surface.edges().forSide(*surface.input.mesh, triangle, side, [&](TriEdgeId edge, bool forward) {
      add(from);
      const size_t first = outline.size();
      for (const VertexId v : vertices.crossings(edge)) {
        if (vertices.isUsed(v)) add(v);
      }
      if (!forward) std::reverse(outline.begin() + std::ptrdiff_t(first), outline.end());
      from = surface.edges().ends[edge][forward ? 1 : 0];
    });
  }
}

/// Hands what it makes to an `Out`, with addVertex(slab), which gives its id, addHybridEdge(edge) and addPiece(polygon, grid element).
template <class Out>
class Dicer {
 public:
  /// Cuts along each axis by every 2^shift-th plane, and by the last one.
  Dicer(const Input& input, const std::array<int, 3>& shifts, Out& out) : input_(input), shifts_(shifts), out_(out) {}

  /// `keepOutside`: pieces outside of the grid as well.
  void dice(TriangleId triangle, const Polygon& polygon, bool keepOutside = false) {
    triangle_ = triangle;
    keepOutside_ = keepOutside;
    split(0, polygon);
  }

  Predicates predicates;

 private:
  /// Cuts a convex polygon by the planes of `axis` and of those after it.
  void split(int axis, const Polygon& polygon) {
    if (axis == 3) return out_.addPiece(polygon, element_);
    const auto [least, greatest] = extent(polygon, axis);
    int32_t plane = seamFrom(axis, firstPlaneAfter(least));
    const int32_t last = lastPlaneBefore(greatest);
    if (plane > last) return splitOn(axis, slabBetween(least, greatest), polygon);
    Sweep sweep(polygon, axis, least, piece_[axis], floor_[axis]);
    int32_t above = 0;
    for (; plane <= last; plane = seamFrom(axis, plane + 1)) {
      sweep.climb(2 * plane);
      makeLine(axis, plane, sweep.up(), sweep.down());
      addHybridEdges(sweep.up(), sweep.down());
      splitOn(axis, 2 * plane - 1, sweep.below(line_));
      sweep.beginAbove();
      above = 2 * plane + 1;
    }
    splitOn(axis, above, sweep.rest());
  }

  /// The first of the planes to cut by that is not below `plane`; beyond all planes if there is none.
  int32_t seamFrom(int axis, int32_t plane) const {
    const int32_t mask = (1 << shifts_[size_t(axis)]) - 1, end = input_.cells(axis);
    return plane > end ? plane : std::min((plane + mask) & ~mask, end);
  }

  /// Goes on with a polygon that lies between two planes of the axis, or on one; `slab` is one of the slabs there.
  void splitOn(int axis, int32_t slab, const Polygon& polygon) {
    if (!keepOutside_ && (slab < 0 || slab > 2 * input_.cells(axis))) return;
    element_[size_t(axis)] = slab;
    split(axis + 1, polygon);
  }

  static std::pair<int32_t, int32_t> extent(const Polygon& polygon, int axis) {
    int32_t least = polygon[0].slab[size_t(axis)], greatest = least;
    for (const Corner& c : polygon) {
      least = std::min(least, c.slab[size_t(axis)]);
      greatest = std::max(greatest, c.slab[size_t(axis)]);
    }
    return {least, greatest};
  }

  /// The pieces of a hybrid edge, whose inner vertices have been made.
  void addHybridEdges(const Corner& a, const Corner& b) {
    const Corner* from = &a;
    for (size_t i = 0; i <= line_.size(); ++i) {
      const Corner* to = i < line_.size() ? &line_[i] : &b;
      const Slab element = elementBetween(from->slab, to->slab);
      if (planeCount(element) == 1 && (keepOutside_ || input_.inGrid(element))) out_.addHybridEdge({element, from->id, to->id});
      from = to;
    }
  }

  /// Calls f(plane, step) for the planes strictly between two slabs, in order.
  template <class F>
  static void forPlanes(int32_t from, int32_t to, const F& f) {
    const int step = to > from ? 1 : -1;
    const int32_t past = step > 0 ? lastPlaneBefore(to) + 1 : firstPlaneAfter(to) - 1;
    for (int32_t i = step > 0 ? firstPlaneAfter(from) : lastPlaneBefore(from); step > 0 ? i < past : i > past; i += step) f(i, step);
  }

  /// The vertices inside of the hybrid edge a -> b, which lies in the plane: its crossings with planes across the next axis, at heights
  /// along the one after that, which are up to P2; and with planes across that one in between.
  void makeLine(int axis, int32_t plane, const Corner& a, const Corner& b) {
    line_.clear();
    const size_t along = size_t(axis + 1) % 3, height = size_t(axis + 2) % 3;
    Corner at = a;
    forPlanes(a.slab[along], b.slab[along], [&](int32_t j, int step) {
      Slab slab;
      slab[size_t(axis)] = 2 * plane;
      slab[along] = 2 * j;
      slab[height] = heightOf(slab, height, step, at.slab[height], b.slab[height]);
      climb(at, slab, height);
      at = {out_.addVertex(slab), slab};
      line_.push_back(at);
    });
    climb(at, b.slab, height);
  }

  /// Appends the crossings with planes across `height` strictly between two points of a hybrid edge that has no other crossings there.
  void climb(const Corner& from, const Slab& to, size_t height) {
    Slab slab = elementBetween(from.slab, to);
    forPlanes(from.slab[height], to[height], [&](int32_t k, int) {
      slab[height] = 2 * k;
      line_.push_back({out_.addVertex(slab), slab});
    });
  }

  /// P2: the slab along `height` at which the triangle meets a grid line, whose planes are those of `line`. It lies strictly between two
  /// slabs of the hybrid edge in one of these planes (or all are the same); the edge runs upwards across the other one, by `step`, where
  /// the triangle's normal points up along `height`.
  int32_t heightOf(const Slab& line, size_t height, int step, int32_t from, int32_t to) {
    if (inOneSlab(std::min(from, to), std::max(from, to))) return slabBetween(std::min(from, to), std::max(from, to));
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
  const std::array<int, 3> shifts_;
  Out& out_;
  TriangleId triangle_{0};
  bool keepOutside_ = false;
  Slab element_{};  // of the piece, for the axes by which it has been cut
  Polygon line_;
  Polygon piece_[3], floor_[3];  // per axis
};

}  // namespace mandoline::detail
