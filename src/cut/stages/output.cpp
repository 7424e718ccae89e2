#include "cut/stages/output.h"

#include <cmath>

#include "base/position_table.h"

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

void writePlaces(const Stencil& stencil, const CutFaces& faces, CutMesh& out) {
  const size_t tri = faces.tri.size();
  out.faceTriangle.assign(faces.tri.triangles.begin(), faces.tri.triangles.end());
  out.faceTriangle.resize(faces.size(), -1);
  out.faceAxis.assign(faces.size(), -1);
  out.facePlane.assign(faces.size(), 0);
  for (size_t f = 0; f < tri; ++f) {
    for (int d = 0; d < 3; ++d) {
      if (!onPlane(faces.tri.elements[f][d])) continue;
      out.faceAxis[f] = int8_t(d);
      out.facePlane[f] = faces.tri.elements[f][d] >> 1;
    }
  }
  for (size_t g = 0; g < faces.grid.size(); ++g) {
    const Stencil::Face& place = stencil.faces[faces.grid.gridFaces[g]];
    out.faceAxis[tri + g] = int8_t(place.axis());
    out.facePlane[tri + g] = stencil.cells[place.cell].at(place.axis()) + place.side();
  }
}

void moveLoops(CutFaces& faces, CutMesh& out) {
  auto& [tri, grid] = faces;
  out.faceLoopOffsets.resize(tri.size() + 1);
  for (uint32_t f = 0; f <= tri.size(); ++f) out.faceLoopOffsets[f] = f;  // one loop each
  for (size_t g = 1; g < grid.faceLoopOffsets.size(); ++g) out.faceLoopOffsets.push_back(grid.faceLoopOffsets[g] + uint32_t(tri.size()));
  const uint32_t shift = uint32_t(tri.loopVertices.size());
  out.loopOffsets = std::move(tri.loopOffsets);
  for (size_t l = 1; l < grid.loopOffsets.size(); ++l) out.loopOffsets.push_back(grid.loopOffsets[l] + shift);
  out.loopVertices = std::move(tri.loopVertices);
  out.loopVertices.insert(out.loopVertices.end(), grid.loopVertices.begin(), grid.loopVertices.end());
}

/// Writes cut-vertices one by one.
class VertexWriter {
 public:
  /// `mesh` and `grid` are those of the user.
  VertexWriter(const MeshView& mesh, const Grid& grid, const Surface& surface, CutMesh& out)
      : mesh_(mesh), grid_(grid), input_(surface.input), vertices_(surface.vertices), out_(out) {}

  void resize(size_t count) {
    out_.positions.resize(3 * count);
    out_.vertexCell.resize(3 * count);
    out_.vertexMask.assign(count, 0);
    out_.vertexTriVertex.assign(count, -1);
    out_.vertexParents.assign(2 * count, -1);
  }

  /// Vertex v becomes number i.
  void write(uint32_t v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices_.slabs[v];
    const Point p = vertices_.position(v, predicates);
    for (int d = 0; d < 3; ++d) {
      out_.vertexCell[3 * i + d] = slab[d] >> 1;
      if (onPlane(slab[d])) out_.vertexMask[i] |= uint8_t(1 << d);
      // Coordinates that the input has are handed back as they are, even where scaling flushed them.
      out_.positions[3 * i + d] = onPlane(slab[d])           ? grid_.planes[d][size_t(slab[d] >> 1)]
                                  : vertices_.isTriVertex(v) ? mesh_.positions[3 * size_t(v) + d]
                                                             : input_.toWorld(p[d]);
    }
    writeParents(v, i);
  }

 private:
  void writeParents(uint32_t v, size_t i) {
    int32_t* parents = &out_.vertexParents[2 * i];
    if (vertices_.isTriVertex(v)) {
      out_.vertexTriVertex[i] = parents[0] = parents[1] = int32_t(v);
    } else if (vertices_.isOnEdge(v)) {
      parents[0] = int32_t((*vertices_.triEdges)[vertices_.triEdge(v)][0]);
      parents[1] = int32_t((*vertices_.triEdges)[vertices_.triEdge(v)][1]);
    } else if (vertices_.isInTriangle(v)) {
      parents[0] = int32_t(vertices_.triangle(v));
    }
  }

  const MeshView& mesh_;
  const Grid& grid_;
  const Input& input_;
  const CutVertices& vertices_;
  CutMesh& out_;
};

void writeVertices(const std::vector<uint32_t>& ids, VertexWriter& writer, Run& run) {
  std::vector<uint32_t> used;
  for (uint32_t v = 0; v < ids.size(); ++v) {
    if (ids[v] != kUnused) used.push_back(v);
  }
  writer.resize(used.size());
  const auto chunks = forChunks<Predicates>(used.size(), run.monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) writer.write(used[i], i, predicates);
  });
  for (const Predicates& p : chunks) run.count(p);
}

/// Moves made vertices that rounding put onto another one by a few units in the last place, so that no two have the same position.
/// Vertices on different grid elements never need it: see CutVertices::position.
void separate(CutMesh& out) {
  const uint32_t n = uint32_t(out.vertexMask.size());
  PositionTable table(n, [&](uint32_t v) { return &out.positions[3 * size_t(v)]; });
  for (uint32_t v = 0; v < n; ++v) {
    double* p = &out.positions[3 * size_t(v)];
    uint32_t* slot = &table.find(p);
    const Point original = {p[0], p[1], p[2]};
    for (int steps = 1; *slot != table.kFree && steps < 64; ++steps) {
      for (int way = 0; way < 6 && *slot != table.kFree; ++way) {
        const int d = way >> 1, c = out.vertexCell[3 * size_t(v) + d];
        if (out.vertexMask[v] >> d & 1 || out.vertexTriVertex[v] >= 0) continue;
        const double toward = out.grid.planes[d][size_t(c) + (way & 1)];
        double x = original[d];
        for (int i = 0; i < steps; ++i) x = std::nextafter(x, toward);
        if (x == toward) continue;
        std::copy(original.begin(), original.end(), p);
        p[d] = x;
        slot = &table.find(p);
      }
    }
    if (*slot == table.kFree) *slot = v;
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

CutMesh makeOutput(const MeshView& mesh, const Grid& grid, CutState& state, Run& run) {
  auto& [surface, stencil, faces, cells, regions] = state;
  CutMesh out;
  out.grid = grid;
  writePlaces(stencil, faces, out);
  moveLoops(faces, out);
  const std::vector<uint32_t> ids = numberVertices(surface.vertices.size(), out);
  for (uint32_t& v : out.loopVertices) v = ids[v];
  VertexWriter writer(mesh, grid, surface, out);
  writeVertices(ids, writer, run);
  separate(out);

  out.cellHalfFaceOffsets = std::move(cells.halfFaces.offsets);
  out.cellHalfFaces.reserve(cells.halfFaces.items.size());
  for (const HalfFace h : cells.halfFaces.items) out.cellHalfFaces.push_back(h.number);
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
  out.triangleCount = uint32_t(surface.input.triangles.size());
  listDropped(surface.input, out, run.stats);
  return out;
}

}  // namespace mandoline::detail
