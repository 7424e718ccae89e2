#include "cut/stages/regions.h"

#include <string>

#include "base/disjoint_sets.h"

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

/// The runs of grid cells between those of the stencil, row by row.
void findRuns(const Input& input, const Stencil& stencil, Regions& regions, Monitor& monitor) {
  const size_t rows = size_t(input.cells(1)) * size_t(input.cells(2));
  regions.rowRunOffsets.assign(1, 0);
  regions.rowRunOffsets.reserve(rows + 1);
  size_t c = 0;
  const auto addRun = [&](int32_t begin, int32_t end) {
    if (begin >= end) return;
    regions.runBegin.push_back(begin);
    regions.runEnd.push_back(end);
  };
  for (int32_t k = 0; k < input.cells(2); ++k) {
    for (int32_t j = 0; j < input.cells(1); ++j) {
      int32_t from = 0;
      for (; c < stencil.cells.size() && stencil.cells[c].at(1) == j && stencil.cells[c].at(2) == k; ++c) {
        addRun(from, stencil.cells[c].at(0));
        from = stencil.cells[c].at(0) + 1;
      }
      addRun(from, input.cells(0));
      regions.rowRunOffsets.push_back(uint32_t(regions.runBegin.size()));
    }
    monitor.report(size_t(k), size_t(input.cells(2)));
  }
}

/// Joins runs that lie beside each other along y and z.
void uniteRuns(const Input& input, const Regions& regions, uint32_t firstRun, DisjointSets& nodes) {
  const auto uniteRows = [&](size_t r, size_t s) {
    for (uint32_t a = regions.rowRunOffsets[r], b = regions.rowRunOffsets[s];
         a < regions.rowRunOffsets[r + 1] && b < regions.rowRunOffsets[s + 1];) {
      if (std::max(regions.runBegin[a], regions.runBegin[b]) < std::min(regions.runEnd[a], regions.runEnd[b]))
        nodes.unite(firstRun + a, firstRun + b);
      regions.runEnd[a] < regions.runEnd[b] ? ++a : ++b;
    }
  };
  const size_t ny = size_t(input.cells(1)), rows = ny * size_t(input.cells(2));
  for (size_t r = 0; r < rows; ++r) {
    if (r % ny > 0) uniteRows(r - 1, r);
    if (r >= ny) uniteRows(r - ny, r);
  }
}

/// The run that holds an untouched grid cell.
uint32_t runAt(const Input& input, const Regions& regions, const Slab& cell) {
  const size_t row = size_t(cell[2] >> 1) * size_t(input.cells(1)) + size_t(cell[1] >> 1);
  const auto first = regions.runEnd.begin() + regions.rowRunOffsets[row], past = regions.runEnd.begin() + regions.rowRunOffsets[row + 1];
  return uint32_t(std::upper_bound(first, past, cell[0] >> 1) - regions.runEnd.begin());
}

/// Every piece of a grid-face joins what lies on its two sides.
void uniteAcrossGridFaces(const Input& input, const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces,
                          const std::vector<uint32_t>& owner, const Regions& regions, uint32_t firstRun, DisjointSets& nodes) {
  for (uint32_t g = 0; g < gridFaces.size(); ++g) {
    const uint32_t face = uint32_t(triFaces.size()) + g;
    const uint32_t below = owner[2 * face], above = owner[2 * face + 1];
    if (below != kNone && above != kNone) {
      nodes.unite(below, above);
      continue;
    }
    const Stencil::Face& place = stencil.faces[gridFaces.gridFaces[g]];
    Slab other = stencil.cells[place.cell].element;  // the first cell that has it, so the other side is the untouched one
    other[place.axis()] += place.side() == 1 ? 2 : -2;
    if (input.inGrid(other)) nodes.unite(below != kNone ? below : above, firstRun + runAt(input, regions, other));
  }
}

/// Whether every tri-edge is run through equally often in both directions.
bool isClosed(const Input& input, const TriEdges& edges) {
  std::vector<int32_t> net(edges.ends.size(), 0);
  for (uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (!input.kept(t)) continue;
    for (int side = 0; side < 3; ++side) edges.forSide(input, t, side, [&](uint32_t edge, bool forward) { net[edge] += forward ? 1 : -1; });
  }
  return std::all_of(net.begin(), net.end(), [](int32_t n) { return n == 0; });
}

/// Winding number of the surface about the point (x0 + e^3, y0 + e, z0 + e^2) for the grid's lowest corner (x0, y0, z0) and an e as small
/// as need be: the sign of crossings of the ray from there to -x.
int windingAtLowestCorner(const Input& input, Predicates& predicates) {
  const Point o = {input.planes[0][0], input.planes[1][0], input.planes[2][0]};
  int winding = 0;
  for (uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (!input.kept(t)) continue;
    const auto& v = input.triangles[t];
    const Slab &sa = input.slabs[v[0]], &sb = input.slabs[v[1]], &sc = input.slabs[v[2]];
    if (std::min({sa[0], sb[0], sc[0]}) > 0) continue;
    if (std::min({sa[1], sb[1], sc[1]}) > 0 || std::max({sa[1], sb[1], sc[1]}) <= 0) continue;
    if (std::min({sa[2], sb[2], sc[2]}) > 0 || std::max({sa[2], sb[2], sc[2]}) < 0) continue;
    const Point &a = input.points[v[0]], &b = input.points[v[1]], &c = input.points[v[2]];
    const auto sideOf = [&](const Point& p, const Point& q) {  // of the shifted point about p -> q, seen along -x
      const int side = predicates.orient2d(p[1], p[2], q[1], q[2], o[1], o[2]);
      if (side != 0) return side;
      const int byY = -signOf(q[2] - p[2]);
      return byY != 0 ? byY : signOf(q[1] - p[1]);
    };
    const int side = sideOf(a, b);
    if (side == 0 || side != sideOf(b, c) || side != sideOf(c, a)) continue;  // side is now the sign of the normal's x
    int above = predicates.orient3d(a.data(), b.data(), c.data(), o.data());
    if (above == 0) above = predicates.orient2d(a[2], a[0], b[2], b[0], c[2], c[0]);
    if (above == 0) above = predicates.orient2d(a[0], a[1], b[0], b[1], c[0], c[1]);
    if (above == 0) above = side;
    if (above == side) winding -= side;  // the point lies beyond the triangle along +x, so the ray meets it
  }
  return winding;
}

/// The node (cut-cell, or run from firstRun on) that holds the point of windingAtLowestCorner.
uint32_t nodeAtLowestCorner(const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces, const CutVertices& vertices,
                            const std::vector<uint32_t>& owner, uint32_t firstRun) {
  if (stencil.cells.empty() || stencil.cells[0].element != Slab{1, 1, 1}) return firstRun;
  // Its grid-face x = x0 holds the point's shadow right beside the y-axis: in the face with the directed edge from the corner along y.
  for (const uint32_t fromBelow : gridFaces.halfFaces[stencil.cells[0].faces[cellFace(0, 0)]]) {
    const uint32_t face = fromBelow / 2;
    const bool reversed = fromBelow & 1;  // a triangle's face whose normal is -x
    std::span<const uint32_t> loop;
    if (face < triFaces.size()) {
      loop = triFaces.loop(face);
    } else {
      const uint32_t l = gridFaces.faceLoopOffsets[face - triFaces.size()];
      loop = {gridFaces.loopVertices.data() + gridFaces.loopOffsets[l], gridFaces.loopOffsets[l + 1] - gridFaces.loopOffsets[l]};
    }
    for (size_t i = 0; i < loop.size(); ++i) {
      uint32_t u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
      if (reversed) std::swap(u, v);
      if (vertices.slabs[u] == Slab{0, 0, 0} && vertices.slabs[v][0] == 0 && vertices.slabs[v][2] == 0) return owner[fromBelow ^ 1];
    }
  }
  return firstRun;
}

/// Winding numbers relative to each other by a union-find with differences, then shifted by the exact one.
void findWinding(const TriFaces& triFaces, const CutCells& cells, const std::vector<uint32_t>& owner, uint32_t anchorRegion,
                 int anchorWinding, const CutVertices& vertices, Regions& regions) {
  std::vector<uint32_t> parent(regions.count);
  std::vector<int32_t> toParent(regions.count, 0);  // winding less the parent's
  for (uint32_t r = 0; r < regions.count; ++r) parent[r] = r;
  const auto find = [&](uint32_t r) {
    uint32_t root = r;
    int32_t sum = 0;
    for (; parent[root] != root; root = parent[root]) sum += toParent[root];
    for (uint32_t at = r; at != root;) {
      const uint32_t up = parent[at];
      const int32_t step = toParent[at];
      parent[at] = root;
      toParent[at] = sum;
      sum -= step;
      at = up;
    }
    return root;
  };
  for (uint32_t f = 0; f < triFaces.size(); ++f) {
    const uint32_t behind = owner[2 * f], before = owner[2 * f + 1];
    if (behind == kNone || before == kNone) continue;  // on the boundary of the grid
    const uint32_t r = regions.cellRegion[behind], s = regions.cellRegion[before], rootR = find(r), rootS = find(s);
    if (rootR != rootS) {  // winding of r is that of s, plus one
      parent[rootR] = rootS;
      toParent[rootR] = toParent[s] + 1 - toParent[r];
    } else if (toParent[r] != toParent[s] + 1) {
      int64_t other = -1;  // another triangle in the same grid cell
      for (const uint32_t h : cells.halfFaces[behind]) {
        if (h / 2 < triFaces.size() && triFaces.triangles[h / 2] != triFaces.triangles[f]) other = triFaces.triangles[h / 2];
      }
      vertices.failSelfIntersection(triFaces.triangles[f], other);
    }
  }
  const uint32_t root = find(anchorRegion);
  const int32_t shift = anchorWinding - toParent[anchorRegion];
  regions.winding.resize(regions.count);
  for (uint32_t r = 0; r < regions.count; ++r) regions.winding[r] = find(r) == root ? shift + toParent[r] : 0;
}

}  // namespace

Regions findRegions(const Input& input, const TriEdges& edges, const Stencil& stencil, const TriFaces& triFaces, const GridFaces& gridFaces,
                    const CutCells& cells, const CutVertices& vertices, CutStats& stats, Monitor& monitor) {
  Regions regions;
  findRuns(input, stencil, regions, monitor);
  const size_t cellCount = cells.stencilCells.size();
  const uint32_t firstRun = uint32_t(cellCount);
  std::vector<uint32_t> owner(2 * (triFaces.size() + gridFaces.size()), kNone);
  for (uint32_t c = 0; c < cellCount; ++c) {
    for (const uint32_t h : cells.halfFaces[c]) owner[h] = c;
  }
  DisjointSets nodes(cellCount + regions.runBegin.size());
  uniteRuns(input, regions, firstRun, nodes);
  uniteAcrossGridFaces(input, stencil, triFaces, gridFaces, owner, regions, firstRun, nodes);

  // Regions are numbered in the order in which their first grid cell comes.
  std::vector<uint32_t> regionOf(cellCount + regions.runBegin.size(), kNone);
  const auto label = [&](uint32_t node) {
    uint32_t& region = regionOf[nodes.find(node)];
    if (region == kNone) region = regions.count++;
    return region;
  };
  regions.cellRegion.resize(cellCount);
  regions.runRegion.resize(regions.runBegin.size());
  size_t c = 0;
  for (size_t row = 0; row + 1 < regions.rowRunOffsets.size(); ++row) {
    uint32_t run = regions.rowRunOffsets[row];
    const uint32_t past = regions.rowRunOffsets[row + 1];
    const auto inRow = [&] {
      return c < cellCount && size_t(stencil.cells[cells.stencilCells[c]].at(2)) * size_t(input.cells(1)) +
                                      size_t(stencil.cells[cells.stencilCells[c]].at(1)) ==
                                  row;
    };
    while (run < past || inRow()) {
      if (run < past && (!inRow() || regions.runBegin[run] < stencil.cells[cells.stencilCells[c]].at(0))) {
        regions.runRegion[run] = label(firstRun + run);
        ++run;
      } else {
        regions.cellRegion[c] = label(uint32_t(c));
        ++c;
      }
    }
  }

  regions.hasWinding = isClosed(input, edges);
  if (regions.hasWinding) {
    Predicates predicates;
    const uint32_t anchor = nodeAtLowestCorner(stencil, triFaces, gridFaces, vertices, owner, firstRun);
    const uint32_t anchorRegion = anchor < firstRun ? regions.cellRegion[anchor] : regions.runRegion[anchor - firstRun];
    findWinding(triFaces, cells, owner, anchorRegion, windingAtLowestCorner(input, predicates), vertices, regions);
    stats.exactFallbacks += predicates.fallbacks;
  }
  return regions;
}

}  // namespace mandoline::detail
