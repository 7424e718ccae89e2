#include "cut/stages/output.h"

#include <cmath>
#include <cstring>

namespace mandoline::detail {
namespace {

constexpr uint32_t kUnused = ~0u;

/// New ids of the vertices that loops use, in the order of the old ones.
std::vector<uint32_t> numberVertices(size_t count, const CutMesh& out) {
  std::vector<uint32_t> ids(count, kUnused);
  for (const uint32_t v : out.loopVertices) ids[v] = 0;
  uint32_t next = 0;
  for (uint32_t& id : ids) {
    if (id != kUnused) id = next++;
  }
  return ids;
}

void writeFaces(const Stencil& stencil, TriFaces& triFaces, GridFaces& gridFaces, CutMesh& out) {
  const size_t tri = triFaces.size(), all = tri + gridFaces.size();
  out.faceTriangle.assign(triFaces.triangles.begin(), triFaces.triangles.end());
  out.faceTriangle.resize(all, -1);
  out.faceAxis.assign(all, -1);
  out.facePlane.assign(all, 0);
  for (size_t f = 0; f < tri; ++f) {
    for (int d = 0; d < 3; ++d) {
      if (!onPlane(triFaces.elements[f][d])) continue;
      out.faceAxis[f] = int8_t(d);
      out.facePlane[f] = triFaces.elements[f][d] >> 1;
    }
  }
  for (size_t g = 0; g < gridFaces.size(); ++g) {
    const Stencil::Face& place = stencil.faces[gridFaces.gridFaces[g]];
    out.faceAxis[tri + g] = int8_t(place.axis());
    out.facePlane[tri + g] = stencil.cells[place.cell].at(place.axis()) + place.side();
  }
  out.faceLoopOffsets.resize(tri + 1);
  for (uint32_t f = 0; f <= tri; ++f) out.faceLoopOffsets[f] = f;  // one loop each
  for (size_t g = 1; g < gridFaces.faceLoopOffsets.size(); ++g) out.faceLoopOffsets.push_back(gridFaces.faceLoopOffsets[g] + uint32_t(tri));
  const uint32_t shift = uint32_t(triFaces.loopVertices.size());
  out.loopOffsets = std::move(triFaces.loopOffsets);
  for (size_t l = 1; l < gridFaces.loopOffsets.size(); ++l) out.loopOffsets.push_back(gridFaces.loopOffsets[l] + shift);
  out.loopVertices = std::move(triFaces.loopVertices);
  out.loopVertices.insert(out.loopVertices.end(), gridFaces.loopVertices.begin(), gridFaces.loopVertices.end());
}

void writeVertices(const MeshView& mesh, const Grid& grid, const Input& input, const CutVertices& vertices,
                   const std::vector<uint32_t>& ids, CutMesh& out, CutStats& stats, Monitor& monitor) {
  std::vector<uint32_t> used;
  for (uint32_t v = 0; v < ids.size(); ++v) {
    if (ids[v] != kUnused) used.push_back(v);
  }
  out.positions.resize(3 * used.size());
  out.vertexCell.resize(3 * used.size());
  out.vertexMask.assign(used.size(), 0);
  out.vertexTriVertex.assign(used.size(), -1);
  out.vertexParents.assign(2 * used.size(), -1);
  const auto chunks = forChunks<Predicates>(used.size(), monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t v = used[i];
      const Slab& slab = vertices.slabs[v];
      const Point p = vertices.position(v, predicates);
      for (int d = 0; d < 3; ++d) {
        out.vertexCell[3 * i + d] = slab[d] >> 1;
        if (onPlane(slab[d])) out.vertexMask[i] |= uint8_t(1 << d);
        // Coordinates that the input has are handed back as they are, even where scaling flushed them.
        out.positions[3 * i + d] = onPlane(slab[d])          ? grid.planes[d][size_t(slab[d] >> 1)]
                                   : vertices.isTriVertex(v) ? mesh.positions[3 * size_t(v) + d]
                                                             : input.toWorld(p[d]);
      }
      int32_t* parents = &out.vertexParents[2 * i];
      if (vertices.isTriVertex(v)) {
        out.vertexTriVertex[i] = parents[0] = parents[1] = int32_t(v);
      } else if (vertices.isOnEdge(v)) {
        parents[0] = int32_t((*vertices.triEdges)[vertices.parent(v)][0]);
        parents[1] = int32_t((*vertices.triEdges)[vertices.parent(v)][1]);
      } else if (vertices.isInTriangle(v)) {
        parents[0] = int32_t(vertices.parent(v));
      }
    }
  });
  for (const Predicates& p : chunks) stats.exactFallbacks += p.fallbacks;
}

/// Moves made vertices that rounding put onto another one by a few units in the last place, so that no two have the same position.
/// Vertices on different grid elements never need it: see CutVertices::position.
void separate(CutMesh& out) {
  const size_t n = out.vertexMask.size();
  size_t size = 16;
  while (size < 2 * n) size *= 2;
  std::vector<uint32_t> table(size, kUnused);
  const auto find = [&](const double* p) -> uint32_t& {  // the slot that has a vertex at p, or is free for one
    uint64_t bits[3];
    for (int d = 0; d < 3; ++d) {
      const double x = p[d] + 0.0;
      std::memcpy(&bits[d], &x, sizeof x);
    }
    uint64_t hash = (bits[0] * 0x9e3779b97f4a7c15u) ^ (bits[1] * 0xbf58476d1ce4e5b9u) ^ (bits[2] * 0x94d049bb133111ebu);
    hash ^= hash >> 32;
    for (size_t slot = hash & (size - 1);; slot = (slot + 1) & (size - 1)) {
      const uint32_t v = table[slot];
      if (v == kUnused || std::equal(p, p + 3, &out.positions[3 * size_t(v)])) return table[slot];
    }
  };
  for (uint32_t v = 0; v < n; ++v) {
    double* p = &out.positions[3 * size_t(v)];
    uint32_t* slot = &find(p);
    const Point original = {p[0], p[1], p[2]};
    for (int steps = 1; *slot != kUnused && steps < 64; ++steps) {
      for (int way = 0; way < 6 && *slot != kUnused; ++way) {
        const int d = way >> 1, c = out.vertexCell[3 * size_t(v) + d];
        if (out.vertexMask[v] >> d & 1 || out.vertexTriVertex[v] >= 0) continue;
        const double toward = out.grid.planes[d][size_t(c) + (way & 1)];
        double x = original[d];
        for (int i = 0; i < steps; ++i) x = std::nextafter(x, toward);
        if (x == toward) continue;
        std::copy(original.begin(), original.end(), p);
        p[d] = x;
        slot = &find(p);
      }
    }
    if (*slot == kUnused) *slot = v;
  }
}

/// Triangles without a face: those dropped before, and those outside of the grid.
void listDropped(const Input& input, CutMesh& out, CutStats& stats) {
  std::vector<uint8_t> has(input.triangles.size(), 0);
  for (const int32_t t : out.faceTriangle) {
    if (t >= 0) has[size_t(t)] = 1;
  }
  for (uint32_t t = 0; t < has.size(); ++t) {
    if (has[t]) continue;
    out.droppedTriangles.push_back(t);
    if (input.kept(t)) ++stats.outsideTriangles;
  }
}

}  // namespace

CutMesh makeOutput(const MeshView& mesh, const Grid& grid, const Input& input, const Stencil& stencil, TriFaces&& triFaces,
                   GridFaces&& gridFaces, CutCells&& cells, Regions&& regions, const CutVertices& vertices, CutStats& stats,
                   Monitor& monitor) {
  CutMesh out;
  out.grid = grid;
  writeFaces(stencil, triFaces, gridFaces, out);
  const std::vector<uint32_t> ids = numberVertices(vertices.size(), out);
  for (uint32_t& v : out.loopVertices) v = ids[v];
  writeVertices(mesh, grid, input, vertices, ids, out, stats, monitor);
  separate(out);

  out.cellHalfFaceOffsets = std::move(cells.halfFaces.offsets);
  out.cellHalfFaces = std::move(cells.halfFaces.items);
  for (const uint32_t c : cells.stencilCells) {
    for (int d = 0; d < 3; ++d) out.cellGridCell.push_back(stencil.cells[c].at(d));
  }
  out.cellRegion = std::move(regions.cellRegion);
  out.rowRunOffsets = std::move(regions.rowRunOffsets);
  out.runBegin = std::move(regions.runBegin);
  out.runEnd = std::move(regions.runEnd);
  out.runRegion = std::move(regions.runRegion);
  out.regionCount = regions.count;
  out.hasWinding = regions.hasWinding;
  out.regionWinding = std::move(regions.winding);
  out.triangleCount = uint32_t(input.triangles.size());
  listDropped(input, out, stats);
  return out;
}

}  // namespace mandoline::detail
