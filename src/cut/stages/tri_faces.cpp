#include "cut/stages/tri_faces.h"

#include "base/sort.h"
#include "cut/stages/sweep.h"

namespace mandoline::detail {
namespace {

/// What one chunk of triangles makes. Ids of its own vertices count from vertices.size() on.
struct Chunk {
  TriFaces faces;
  UndividedFaces undivided;
  std::vector<Slab> slabs;          // of those vertices
  std::vector<TriangleId> parents;  // of those vertices
  Predicates predicates;
  Polygon whole, line;
  Polygon piece[3], floor[3];  // per axis
};

constexpr size_t kMost = size_t(1) << 31;  // loop entries, vertices

[[noreturn]] void failTooLarge(int64_t element) {
  throw Failure{{Status::meshTooLarge, element, -1, "The cut-mesh would have more than 2^31 loop entries or vertices."}};
}

class Dicer {
 public:
  Dicer(const Surface& surface, Monitor& monitor, Chunk& chunk)
      : input_(surface.input), edges_(surface.edges()), vertices_(surface.vertices), monitor_(monitor), chunk_(chunk) {}

  void cut(TriangleId triangle) {
    triangle_ = triangle;
    findInside();
    const auto t = input_.verticesOf(triangle);
    const Slab &a = input_.slabs[t[0]], &b = input_.slabs[t[1]], &c = input_.slabs[t[2]];
    Slab element;
    bool oneCell = !edges_.hasStitchedSide(triangle);
    for (int d = 0; d < 3; ++d) {
      const int32_t least = std::min({a[d], b[d], c[d]}), greatest = std::max({a[d], b[d], c[d]});
      if (!keepOutside_ && (greatest < 0 || least > 2 * input_.cells(d))) return;
      oneCell &= inOneSlab(least, greatest);
      element[d] = slabBetween(least, greatest);
    }
    if (oneCell) {
      if (!keepOutside_ && !input_.inGrid(element)) return;
      faces_->loops.items.insert(faces_->loops.items.end(), t.begin(), t.end());
      return addFace(element, planeCount(a) > 1 || planeCount(b) > 1 || planeCount(c) > 1);
    }
    outline(t);
    split(0, chunk_.whole);
  }

 private:
  /// The vertices and edges of other triangles inside this one, which decide where its faces go.
  void findInside() {
    faces_ = &chunk_.faces;
    keepOutside_ = false;
    onLines_.clear();
    if (!input_.mesh->hasIntersections()) return;
    const Arrangement& arrangement = *input_.mesh->arrangement;
    const uint32_t t = triangle_.number;
    const auto vertices = arrangement.innerVertices[t];
    keepOutside_ = !arrangement.overlaps[t].empty();  // whose faces are told apart by how they are connected
    if (vertices.empty() && arrangement.innerEdges[t].empty() && !keepOutside_) return;
    faces_ = &chunk_.undivided;
    const auto add = [&](VertexId v) {
      if (vertices_.isUsed(v) && planeCount(vertices_.slabs[v]) > 1) onLines_.push_back({v, vertices_.slabs[v]});
    };
    for (const uint32_t v : vertices) add({v});
    for (const TriEdgeId e : edges_.innerOf(triangle_)) {
      for (const VertexId v : vertices_.crossings(e)) add(v);
    }
    sortItems(onLines_, [](const Corner& a, const Corner& b) { return a.slab < b.slab; });
  }

  /// The triangle as a polygon with all vertices on its sides.
  void outline(const std::array<VertexId, 3>& t) {
    chunk_.whole.clear();
    const auto add = [&](VertexId v) { chunk_.whole.push_back({v, vertices_.slabs[v]}); };
    for (int side = 0; side < 3; ++side) {
      VertexId from = t[side];
      edges_.forSide(*input_.mesh, triangle_, side, [&](TriEdgeId edge, bool forward) {
        add(from);
        const size_t first = chunk_.whole.size();
        for (const VertexId v : vertices_.crossings(edge)) {
          if (vertices_.isUsed(v)) add(v);
        }
        if (!forward) std::reverse(chunk_.whole.begin() + std::ptrdiff_t(first), chunk_.whole.end());
        from = edges_.ends[edge][forward ? 1 : 0];
      });
    }
  }

  /// Cuts a convex polygon by the planes of `axis` and of those after it.
  void split(int axis, const Polygon& polygon) {
    if (axis == 3) return emit(polygon);
    const auto [least, greatest] = extent(polygon, axis);
    const int32_t first = firstPlaneAfter(least), last = lastPlaneBefore(greatest);
    if (first > last) return splitOn(axis, slabBetween(least, greatest), polygon);
    Sweep sweep(polygon, axis, least, chunk_.piece[axis], chunk_.floor[axis]);
    for (int32_t plane = first; plane <= last; ++plane) {
      sweep.climb(2 * plane);
      makeLine(axis, plane, sweep.up(), sweep.down());
      addHybridEdges(sweep.up(), sweep.down());
      splitOn(axis, 2 * plane - 1, sweep.below(chunk_.line));
      sweep.beginAbove();
    }
    splitOn(axis, 2 * last + 1, sweep.rest());
  }

  /// Goes on with a polygon that lies in one slab of the axis.
  void splitOn(int axis, int32_t slab, const Polygon& polygon) {
    if (!keepOutside_ && (slab < 0 || slab > 2 * input_.cells(axis))) return;
    element_[axis] = slab;
    split(axis + 1, polygon);
  }

  static std::pair<int32_t, int32_t> extent(const Polygon& polygon, int axis) {
    int32_t least = polygon[0].slab[axis], greatest = least;
    for (const Corner& c : polygon) {
      least = std::min(least, c.slab[axis]);
      greatest = std::max(greatest, c.slab[axis]);
    }
    return {least, greatest};
  }

  /// The pieces of a hybrid edge, whose inner vertices have been made.
  void addHybridEdges(const Corner& a, const Corner& b) {
    const Polygon& line = chunk_.line;
    const Corner* from = &a;
    for (size_t i = 0; i <= line.size(); ++i) {
      const Corner* to = i < line.size() ? &line[i] : &b;
      const Slab element = elementBetween(from->slab, to->slab);
      if (planeCount(element) == 1 && (keepOutside_ || input_.inGrid(element))) {
        faces_->hybridEdges.push_back({element, from->id, to->id});
        if (faces_ == &chunk_.undivided) chunk_.undivided.hybridTriangles.push_back(triangle_);
      }
      from = to;
    }
  }

  /// The vertices inside of the hybrid edge a -> b, which lies in the plane: its crossings with planes of the axes not yet cut.
  void makeLine(int axis, int32_t plane, const Corner& a, const Corner& b) {
    Polygon& line = chunk_.line;
    line.clear();
    if (axis == 2) return;
    Corner at = a;
    if (axis == 0) {  // crossings with y-planes; where they lie along z is up to P2
      const int step = b.slab[1] > a.slab[1] ? 1 : -1;
      const int32_t first = step > 0 ? firstPlaneAfter(a.slab[1]) : lastPlaneBefore(a.slab[1]);
      const int32_t past = step > 0 ? lastPlaneBefore(b.slab[1]) + 1 : firstPlaneAfter(b.slab[1]) - 1;
      for (int32_t j = first; step > 0 ? j < past : j > past; j += step) {
        const Slab slab = {2 * plane, 2 * j, heightOf(plane, j, step, at.slab[2], b.slab[2])};
        crossZ(at, slab);
        at = addVertex(slab);
        line.push_back(at);
      }
    }
    crossZ(at, b.slab);
  }

  /// Appends the crossings with z-planes strictly between two points of a hybrid edge that has no other crossings there.
  void crossZ(const Corner& from, const Slab& to) {
    const int step = to[2] > from.slab[2] ? 1 : -1;
    const int32_t first = step > 0 ? firstPlaneAfter(from.slab[2]) : lastPlaneBefore(from.slab[2]);
    const int32_t past = step > 0 ? lastPlaneBefore(to[2]) + 1 : firstPlaneAfter(to[2]) - 1;
    Slab slab = elementBetween(from.slab, to);
    for (int32_t k = first; step > 0 ? k < past : k > past; k += step) {
      slab[2] = 2 * k;
      chunk_.line.push_back(addVertex(slab));
    }
  }

  /// P2: the z-slab at which the triangle meets the grid line (x = plane i, y = plane j). It lies strictly between two slabs of the
  /// hybrid edge in the plane x = i (or all are the same); that edge runs to growing y where the triangle's normal has z > 0.
  int32_t heightOf(int32_t i, int32_t j, int stepY, int32_t from, int32_t to) {
    if (inOneSlab(std::min(from, to), std::max(from, to))) return slabBetween(std::min(from, to), std::max(from, to));
    const auto t = input_.verticesOf(triangle_);
    const int step = to > from ? 1 : -1;
    const int32_t last = step > 0 ? lastPlaneBefore(to) : firstPlaneAfter(to);
    for (int32_t k = step > 0 ? firstPlaneAfter(from) : lastPlaneBefore(from); step > 0 ? k <= last : k >= last; k += step) {
      const Point p = {input_.planes[0][i], input_.planes[1][j], input_.planes[2][k]};
      const int above =  // the sign of the height less plane k
          -stepY * chunk_.predicates.orient3d(input_.point(t[0]).data(), input_.point(t[1]).data(), input_.point(t[2]).data(), p.data());
      if (above == 0) return 2 * k;
      if (above != step) return 2 * k - step;
    }
    return 2 * last + step;
  }

  Corner addVertex(const Slab& slab) {
    const auto known = std::lower_bound(onLines_.begin(), onLines_.end(), slab, [](const Corner& c, const Slab& s) { return c.slab < s; });
    if (known != onLines_.end() && known->slab == slab) return *known;
    const VertexId id{uint32_t(vertices_.size() + chunk_.slabs.size())};
    chunk_.slabs.push_back(slab);
    chunk_.parents.push_back(triangle_);
    return {id, slab};
  }

  void emit(const Polygon& polygon) {
    bool touchesLine = false;
    for (const Corner& c : polygon) {
      faces_->loops.items.push_back(c.id);
      touchesLine |= planeCount(c.slab) > 1;
    }
    addFace(element_, touchesLine);
  }

  void addFace(const Slab& element, bool touchesLine) {
    TriFaces& faces = *faces_;
    faces.loops.endGroup();
    faces.triangles.push_back(triangle_);
    faces.elements.push_back(element);
    faces.touchesLine.push_back(touchesLine);
    if (faces.size() % 4096 != 0) return;  // one triangle may have millions
    if (faces.loops.items.size() > kMost || vertices_.size() + chunk_.slabs.size() > kMost) failTooLarge(triangle_.number);
    monitor_.report(triangle_.number, input_.mesh->triangles.size());
  }

  const Input& input_;
  const MeshEdges& edges_;
  const CutVertices& vertices_;
  Monitor& monitor_;
  Chunk& chunk_;
  TriangleId triangle_{0};
  TriFaces* faces_ = nullptr;    // where faces go
  bool keepOutside_ = false;     // those outside the grid as well
  Slab element_{};               // of the piece, for the axes by which it has been cut
  std::vector<Corner> onLines_;  // vertices of the arrangement inside of the triangle that lie on grid lines, by slab
};

/// Appends b, whose vertices in triangles are shifted by the number that the chunks before it made.
void append(TriFaces& a, const TriFaces& b, VertexId firstInTriangle, uint32_t shift) {
  const auto shifted = [&](VertexId v) { return v < firstInTriangle ? v : VertexId{v.number + shift}; };
  a.loops.append(b.loops, shifted);
  a.triangles.insert(a.triangles.end(), b.triangles.begin(), b.triangles.end());
  a.elements.insert(a.elements.end(), b.elements.begin(), b.elements.end());
  a.touchesLine.insert(a.touchesLine.end(), b.touchesLine.begin(), b.touchesLine.end());
  for (const FaceEdge& e : b.hybridEdges) a.hybridEdges.push_back({e.element, shifted(e.from), shifted(e.to)});
}

}  // namespace

TriFaces cutTriangles(Surface& surface, UndividedFaces& undivided, Run& run) {
  const Input& input = surface.input;
  CutVertices& vertices = surface.vertices;
  auto chunks = forChunks<Chunk>(input.mesh->triangles.size(), run.monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    Dicer dicer(surface, run.monitor, chunk);
    for (const TriangleId t : Ids<TriangleId>(begin, end)) {
      if (input.kept(t)) dicer.cut(t);
    }
  });
  size_t entries = 0, made = vertices.size();
  for (const Chunk& c : chunks) {
    entries += c.faces.loops.items.size() + c.undivided.loops.items.size();
    made += c.slabs.size();
    run.count(c.predicates);
  }
  if (entries > kMost || made > kMost) failTooLarge(-1);
  TriFaces faces = std::move(chunks[0].faces);
  uint32_t shift = 0;
  for (size_t c = 0; c < chunks.size(); ++c) {
    if (c > 0) append(faces, chunks[c].faces, vertices.firstInTriangle, shift);
    append(undivided, chunks[c].undivided, vertices.firstInTriangle, shift);
    const std::vector<TriangleId>& triangles = chunks[c].undivided.hybridTriangles;
    undivided.hybridTriangles.insert(undivided.hybridTriangles.end(), triangles.begin(), triangles.end());
    shift += uint32_t(chunks[c].slabs.size());
  }
  for (const Chunk& c : chunks) {
    vertices.slabs.insert(vertices.slabs.end(), c.slabs.begin(), c.slabs.end());
    vertices.parentTriangles.insert(vertices.parentTriangles.end(), c.parents.begin(), c.parents.end());
  }
  vertices.firstOnGrid = {uint32_t(vertices.size())};
  return faces;
}

}  // namespace mandoline::detail
