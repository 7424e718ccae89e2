#include "cut/stages/output.h"

#include <cmath>

#include "base/position_table.h"
#include "base/sort.h"
#include "cut/stages/face_parents.h"

namespace mandoline::detail {
namespace {

constexpr uint32_t kUnused = ~0u;
using NewIds = IdVector<VertexId, uint32_t>;  ///< numbers in the cut-mesh, or kUnused

/// Numbers the vertices that loops use, in the order of their ids.
NewIds numberVertices(size_t count, const CutFaces& faces) {
  NewIds newIds(count, kUnused);
  for (const VertexId v : faces.tri.loops.items) newIds[v] = 0;
  for (const VertexId v : faces.grid.loops.items) newIds[v] = 0;
  uint32_t next = 0;
  for (uint32_t& id : newIds) {
    if (id != kUnused) id = next++;
  }
  return newIds;
}

void writePlaces(const Stencil& stencil, const CutFaces& faces, CutMesh& out) {
  out.faceTriangle.assign(faces.size(), -1);
  out.faceAxis.assign(faces.size(), -1);
  out.facePlane.assign(faces.size(), 0);
  for (const FaceId f : faces.tri.ids()) {
    out.faceTriangle[f.number] = int32_t(faces.tri.triangles[f].number);
    for (int d = 0; d < 3; ++d) {
      if (!onPlane(faces.tri.elements[f][d])) continue;
      out.faceAxis[f.number] = int8_t(d);
      out.facePlane[f.number] = faces.tri.elements[f][d] >> 1;
    }
  }
  for (size_t piece = 0; piece < faces.grid.size(); ++piece) {
    const Stencil::Face& place = stencil.faces[faces.grid.gridFaces[piece]];
    const FaceId f = faces.ofPiece(piece);
    out.faceAxis[f.number] = int8_t(place.axis());
    out.facePlane[f.number] = stencil.cells[place.cell].at(place.axis()) + place.side();
  }
}

void moveLoops(CutFaces& faces, const NewIds& newIds, CutMesh& out) {
  auto& [tri, grid] = faces;
  out.faceLoopOffsets.resize(tri.size() + 1);
  for (uint32_t f = 0; f <= tri.size(); ++f) out.faceLoopOffsets[f] = tri.faceLoopOffsets.empty() ? f : tri.faceLoopOffsets[f];
  appendOffsets(out.faceLoopOffsets, grid.faceLoopOffsets);
  out.loopOffsets = std::move(tri.loops.offsets);
  appendOffsets(out.loopOffsets, grid.loops.offsets);
  out.loopVertices.reserve(tri.loops.items.size() + grid.loops.items.size());
  for (const VertexId v : tri.loops.items) out.loopVertices.push_back(newIds[v]);
  for (const VertexId v : grid.loops.items) out.loopVertices.push_back(newIds[v]);
}

/// Writes cut-vertices one by one.
class VertexWriter {
 public:
  /// `mesh` and `grid` are those of the user.
  VertexWriter(const MeshView& mesh, const Grid& grid, const Surface& surface, CutMesh& out)
      : mesh_(mesh), grid_(grid), input_(surface.input), vertices_(surface.vertices), scale_(surface.input.mesh->shift), out_(out) {}

  void resize(size_t count) {
    out_.positions.resize(3 * count);
    out_.vertexCell.resize(3 * count);
    out_.vertexMask.assign(count, 0);
    out_.vertexTriVertex.assign(count, -1);
    out_.vertexParents.assign(2 * count, -1);
  }

  /// Vertex v becomes number i.
  void write(VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices_.slabs[v];
    const Point p = vertices_.position(v, predicates);
    for (int d = 0; d < 3; ++d) {
      out_.vertexCell[3 * i + d] = slab[d] >> 1;
      if (onPlane(slab[d])) out_.vertexMask[i] |= uint8_t(1 << d);
      // Coordinates that the input has are handed back as they are, even where scaling flushed them.
      out_.positions[3 * i + d] = onPlane(slab[d]) ? grid_.planes[d][size_t(slab[d] >> 1)]
                                  : isTriVertex(v) ? mesh_.positions[3 * size_t(v.number) + d]
                                                   : scale_.world(p[d]);
    }
    writeParents(v, i);
  }

  /// Adds the vertices that triangles make by meeting; `used` are those of the cut-mesh, in order.
  void writeMade(const std::vector<VertexId>& used) {
    if (!input_.mesh->hasIntersections()) return;
    for (uint32_t i = 0; i < used.size(); ++i) {
      if (!vertices_.isImplicit(used[i])) continue;
      out_.madeVertices.push_back(i);
      int32_t parents[4] = {-1, -1, -1, -1};
      MadeVertex kind = MadeVertex::trianglesPlane;
      if (vertices_.isTriVertex(used[i])) {
        const PointKey& key = input_.mesh->arrangement->points.key(used[i].number);
        const int count = key.kind == PointKey::Kind::edgeEdge ? 4 : 3;
        for (int k = 0; k < count; ++k) parents[k] = int32_t(key.ids[size_t(k)]);
        kind = key.kind == PointKey::Kind::edgeEdge       ? MadeVertex::edgeEdge
               : key.kind == PointKey::Kind::edgeTriangle ? MadeVertex::edgeTriangle
                                                          : MadeVertex::triangles;
      } else {
        const Line line = vertices_.edges->line(vertices_.triEdge(used[i]));
        parents[0] = int32_t(std::min(line.a, line.b));
        parents[1] = int32_t(std::max(line.a, line.b));
      }
      out_.madeVertexKinds.push_back(uint8_t(kind));
      out_.madeVertexParents.insert(out_.madeVertexParents.end(), parents, parents + 4);
    }
  }

 private:
  bool isTriVertex(VertexId v) const { return vertices_.isTriVertex(v) && !input_.mesh->isMade(v); }

  void writeParents(VertexId v, size_t i) {
    int32_t* parents = &out_.vertexParents[2 * i];
    if (isTriVertex(v)) {
      out_.vertexTriVertex[i] = parents[0] = parents[1] = int32_t(v.number);
    } else if (vertices_.isOnEdge(v)) {
      const Line line = vertices_.edges->line(vertices_.triEdge(v));
      if (line.ofPlanes) return;
      parents[0] = int32_t(std::min(line.a, line.b));
      parents[1] = int32_t(std::max(line.a, line.b));
    } else if (vertices_.isInTriangle(v)) {
      parents[0] = int32_t(vertices_.triangle(v).number);
    }
  }

  const MeshView& mesh_;
  const Grid& grid_;
  const Input& input_;
  const CutVertices& vertices_;
  const Scale scale_;
  CutMesh& out_;
};

void writeVertices(const NewIds& newIds, VertexWriter& writer, Run& run) {
  std::vector<VertexId> used;
  for (const VertexId v : newIds.ids()) {
    if (newIds[v] != kUnused) used.push_back(v);
  }
  writer.resize(used.size());
  const auto chunks = forChunks<Predicates>(used.size(), run.monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) writer.write(used[i], i, predicates);
  });
  for (const Predicates& p : chunks) run.count(p);
  writer.writeMade(used);
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

/// The triangles that each face is a piece of, ascending.
void writeParents(const Input& input, const CutFaces& faces, CutMesh& out) {
  struct Parent {
    uint32_t triangle;
    int8_t sign;
  };
  out.faceParentOffsets.reserve(faces.size() + 1);
  out.faceParents.reserve(faces.tri.size());
  out.faceParentSigns.reserve(faces.tri.size());
  out.faceParentOffsets.push_back(0);
  FaceParents parents(input, faces.tri);
  std::vector<Parent> sorted;
  for (const FaceId f : faces.tri.ids()) {
    sorted.clear();
    parents.forEach(f, [&](TriangleId t, bool sameWay) { sorted.push_back({t.number, int8_t(sameWay ? 1 : -1)}); });
    if (sorted.size() > 1) sortItems(sorted, [](const Parent& a, const Parent& b) { return a.triangle < b.triangle; });
    for (const Parent& p : sorted) {
      out.faceParents.push_back(p.triangle);
      out.faceParentSigns.push_back(p.sign);
    }
    out.faceParentOffsets.push_back(uint32_t(out.faceParents.size()));
  }
  out.faceParentOffsets.resize(faces.size() + 1, uint32_t(out.faceParents.size()));
}

/// Triangles without a face: those dropped before, and those outside of the grid.
void listDropped(const Input& input, CutMesh& out, CutStats& stats) {
  std::vector<uint8_t> has(input.mesh->triangles.size(), 0);
  for (const uint32_t t : out.faceParents) has[t] = 1;
  for (uint32_t t = 0; t < has.size(); ++t) {
    if (has[t]) continue;
    out.droppedTriangles.push_back(t);
    if (input.mesh->kept(t)) ++stats.outsideTriangles;
  }
}

/// Triangles of parts without winding numbers.
void listParts(const Parts& parts, CutMesh& out) {
  for (uint32_t t = 0; t < parts.kinds.size(); ++t) {
    if (parts.kinds[t] == PartKind::parity) out.parityTriangles.push_back(t);
    if (parts.kinds[t] == PartKind::open) out.openTriangles.push_back(t);
  }
}

}  // namespace

CutMesh makeOutput(const MeshView& mesh, const Grid& grid, CutState& state, Run& run) {
  auto& [surface, stencil, faces, cells, regions] = state;
  CutMesh out;
  out.grid = grid;
  writePlaces(stencil, faces, out);
  writeParents(surface.input, faces, out);
  const NewIds newIds = numberVertices(surface.vertices.size(), faces);
  moveLoops(faces, newIds, out);
  VertexWriter writer(mesh, grid, surface, out);
  writeVertices(newIds, writer, run);
  separate(out);

  out.cellHalfFaceOffsets = std::move(cells.halfFaces.offsets);
  out.cellHalfFaces.reserve(cells.halfFaces.items.size());
  for (const HalfFace h : cells.halfFaces.items) out.cellHalfFaces.push_back(h.number);
  for (const GridCellId c : cells.gridCells) {
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
  out.regionPartWinding = std::move(regions.partWinding);
  out.regionParity = std::move(regions.parity);
  listParts(surface.input.mesh->parts, out);
  out.triangleCount = uint32_t(surface.input.mesh->triangles.size());
  listDropped(surface.input, out, run.stats);
  return out;
}

}  // namespace mandoline::detail
