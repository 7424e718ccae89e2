// Soups of triangles of all kinds, and where the vertices of their cuts truly lie.
#pragma once

#include "catch.h"
#include "exact_vectors.h"
#include "samples.h"
#include "staged_cut.h"

namespace exact_vectors {

using mandoline::Grid;
using mandoline::Mesh;

struct Soup {
  Mesh mesh;
  Grid grid;

  void add(const Point& p) { mesh.positions.insert(mesh.positions.end(), p.begin(), p.end()); }
  void finish() {
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v) mesh.triangles.push_back(v);
  }
};

/// Triangles with coordinates 0..9 and a grid at some of these, or at fractions between.
inline Soup latticeSoup(uint64_t seed) {
  Sampler sampler(Kind::lattice, seed);
  Soup soup;
  for (int i = 0; i < 3 * 8; ++i) soup.add(sampler.point());
  soup.finish();
  std::array<std::vector<double>, 3> planes;
  const double step = sampler.oneIn(3) ? 0.25 : 1;
  for (auto& p : planes) {
    for (double x = double(sampler.below(3)); x <= 9; x += step * double(1 + sampler.below(3))) p.push_back(x);
  }
  soup.grid = Grid::rectilinear(planes);
  return soup;
}

/// Random triangles in a uniform grid whose planes are rounded; many pass close to grid vertices and grid lines, by a side or inside.
inline Soup roundedSoup(uint64_t seed) {
  Sampler sampler(Kind::random, seed);
  Soup soup;
  soup.grid = Grid::box({-1.1, -1.1, -1.3}, {1.7, 1.3, 1.1}, {7, 6, 5});
  const auto gridVertex = [&] {
    Point p;
    for (int d = 0; d < 3; ++d) p[d] = soup.grid.planes[d][sampler.below(soup.grid.planes[d].size())];
    return p;
  };
  for (int i = 0; i < 12; ++i) {
    const Point g = gridVertex(), a = sampler.point();
    Point b = sampler.point();
    const int aim = int(sampler.below(4));  // at nothing, at a grid vertex by a side or by the inside, at a grid line by a side
    if (aim == 1) b = sampler.nudged(Sampler::combined(g, a, a, -0.5 - sampler.unit(), 0));
    if (aim == 3) b[0] = Sampler::combined(g, a, a, -1, 0)[0], b[1] = Sampler::combined(g, a, a, -1, 0)[1];
    soup.add(a);
    soup.add(b);
    soup.add(aim == 2 ? sampler.nudged(Sampler::combined(g, a, b, -0.5 - sampler.unit(), -0.5 - sampler.unit())) : sampler.point());
  }
  soup.finish();
  return soup;
}

/// Coordinates and planes of all magnitudes down to where input is flushed to 0.
inline Soup wideSoup(uint64_t seed) {
  Sampler sampler(Kind::wide, seed);
  Soup soup;
  std::array<std::vector<double>, 3> planes;
  for (auto& p : planes) {
    p = {-Sampler::kLimit / 2, 0, Sampler::kLimit / 2};
    for (int i = 0; i < 4; ++i) p.push_back(sampler.coordinate());
    std::sort(p.begin(), p.end());
    p.erase(std::unique(p.begin(), p.end()), p.end());
  }
  soup.grid = Grid::rectilinear(planes);
  for (int i = 0; i < 8; ++i) {
    const Point a = sampler.point(), b = sampler.point();
    soup.add(a);
    soup.add(b);
    soup.add(sampler.oneIn(2) ? sampler.point() : sampler.nudged(sampler.onLine(a, b)));
  }
  soup.finish();
  return soup;
}

/// A soup after stages 1 to 3, with some grid vertices, and where its vertices truly lie.
struct Cut : stages::StagedCut {
  Input& input = state.surface.input;
  const MeshEdges& edges = state.surface.edges();
  CutVertices& vertices = brick.vertices;
  TriFaces& faces = brick.triFaces;
  std::vector<VertexId> used;  // ids of vertices that there are
  IdVector<VertexId, Vector> points;

  explicit Cut(const Soup& soup) : StagedCut(soup.mesh, stages::Stage::triFaces, stages::unresolved(), soup.grid) {
    for (int32_t k = 0; k <= input.cells(2); k += 2) {
      for (int32_t j = 0; j <= input.cells(1); j += 2) {
        for (int32_t i = 0; i <= input.cells(0); i += 2) vertices.add({2 * i, 2 * j, 2 * k}, CutVertices::kNoTriangle);
      }
    }
    points.resize(vertices.size());
    for (const VertexId v : vertices.ids()) {
      if (!vertices.isUsed(v)) continue;
      used.push_back(v);
      points[v] = pointOf(v);
    }
  }

  Rational plane(int axis, int32_t index) const { return Rational(input.planes[axis][size_t(index)]); }
  Vector triVertex(VertexId v) const { return exact(input.point(v)); }
  bool inGrid(VertexId v) const { return input.inGrid(vertices.slab(v)); }

  Slab slabOf(const Vector& p) const {
    Slab slab;
    for (int d = 0; d < 3; ++d) {
      slab[d] = -1;
      for (int32_t k = 0; k <= input.cells(d); ++k) slab[d] = plane(d, k) < p[d] ? 2 * k + 1 : plane(d, k) == p[d] ? 2 * k : slab[d];
    }
    return slab;
  }

  /// Where plane `index` crosses a tri-edge: 0 at its lower end, 1 at its higher.
  Rational parameter(TriEdgeId edge, int axis, int32_t index) const {
    const Vector a = triVertex(edges.ends[edge][0]), b = triVertex(edges.ends[edge][1]);
    return (plane(axis, index) - a[axis]) / (b[axis] - a[axis]);
  }
  Vector onEdge(TriEdgeId edge, const Rational& t) const {
    const Vector a = triVertex(edges.ends[edge][0]);
    return a + t * (triVertex(edges.ends[edge][1]) - a);
  }

  std::array<Vector, 3> corners(TriangleId triangle) const {
    const auto t = input.verticesOf(triangle);
    return {triVertex(t[0]), triVertex(t[1]), triVertex(t[2])};
  }

 private:
  /// By the vertex's origin and one (on a tri-edge) or two (in a triangle) of the planes it claims to be on.
  Vector pointOf(VertexId v) const {
    if (vertices.isTriVertex(v)) return triVertex(v);
    const Slab& slab = vertices.slab(v);
    Vector p;
    if (vertices.isOnEdge(v)) {
      const auto& ends = edges.ends[vertices.triEdge(v)];
      for (int d = 0; d < 3; ++d) {
        if (onPlane(slab[d]) && input.point(ends[0])[d] != input.point(ends[1])[d])
          return onEdge(vertices.triEdge(v), parameter(vertices.triEdge(v), d, slab[d] / 2));
      }
      FAIL("a crossing without a plane");
    }
    for (int d = 0; d < 3; ++d) p[d] = onPlane(slab[d]) ? plane(d, slab[d] / 2) : Rational(0);
    if (!vertices.isInTriangle(v)) return p;
    for (int g = 0; g < 3; ++g) {
      if (onPlane(slab[(g + 1) % 3]) && onPlane(slab[(g + 2) % 3]) && meetLine(corners(vertices.triangle(v)), g, p)) return p;
    }
    FAIL("a vertex in a triangle without a grid line");
    return p;
  }
};

/// Runs `test` with cuts of all kinds of soup.
template <class Test>
void forCuts(int seeds, const Test& test) {
  for (int seed = 1; seed <= seeds; ++seed) {
    for (const auto make : {latticeSoup, roundedSoup, wideSoup}) {
      const Cut cut(make(uint64_t(seed)));
      test(cut);
    }
  }
}

/// Groups of vertices that may well tie: on one tri-edge, or in one triangle on one plane.
inline std::vector<std::vector<VertexId>> alignedVertices(const Cut& cut) {
  std::vector<std::vector<VertexId>> groups;
  for (const FaceId f : cut.faces.ids()) groups.push_back({cut.faces.loopsOf(f)[0].begin(), cut.faces.loopsOf(f)[0].end()});
  for (const TriEdgeId e : cut.edges.ends.ids()) {
    groups.push_back({cut.edges.ends[e].begin(), cut.edges.ends[e].end()});
    for (const VertexId v : cut.vertices.crossings(e)) {
      if (cut.vertices.isUsed(v)) groups.back().push_back(v);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const FaceEdge& first : cut.brick.faceEdges) {
      if (!onPlane(first.element[axis])) continue;
      groups.emplace_back();
      for (const FaceEdge& e : cut.brick.faceEdges) {
        if (e.element == first.element) groups.back().insert(groups.back().end(), {e.from, e.to});
      }
    }
  }
  return groups;
}

}  // namespace exact_vectors
