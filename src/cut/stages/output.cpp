#include "cut/stages/output.h"

#include <cmath>
#include <numeric>

#include "base/position_table.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// A part of something that is written by several threads.
struct Block {
  size_t begin, end;

  static constexpr size_t kSize = 8192;
  static size_t count(size_t n) { return (n + kSize - 1) / kSize; }
  static Block at(size_t block, size_t n) { return {block * kSize, std::min(n, (block + 1) * kSize)}; }
};

/// Where tri-cut-faces lie.
void writeTriFaces(const TriFaces& tri, Block block, CutMesh& out) {
  for (const FaceId f : Ids<FaceId>(block.begin, block.end)) {
    out.faceTriangle[f.number] = int32_t(tri.triangles[f].number);
    for (int d = 0; d < 3; ++d) {
      if (!onPlane(tri.elements[f][d])) continue;
      out.faceAxis[f.number] = int8_t(d);
      out.facePlane[f.number] = tri.elements[f][d] >> 1;
    }
  }
}

void writeTriLoops(const TriFaces& tri, const Numbers& numbers, Block block, CutMesh& out) {
  for (size_t i = block.begin; i < block.end; ++i) out.loopVertices[i] = numbers.vertices[tri.loops.items[i]];
}

/// Writes what belongs to bricks: pieces of grid-faces, which come after all tri-cut-faces, and cut-cells.
class BrickWriter {
 public:
  BrickWriter(const CutState& state, const Numbers& numbers, CutMesh& out)
      : state_(state),
        numbers_(numbers),
        out_(out),
        triFaces_(uint32_t(state.triFaces.size())),
        triLoops_(uint32_t(out.loopCount()) - numbers.total.loops),
        triLoopVertices_(uint32_t(state.triFaces.loops.items.size())) {}

  void write(BrickId brick) const {
    const BrickCut& cut = state_.cuts[brick];
    std::vector<BrickCounts> at = numbers_.rows[brick];  // where what comes next goes
    forOwnPieces(cut, [&](uint32_t row, uint32_t begin, uint32_t end) {
      for (uint32_t piece = begin; piece < end; ++piece) writePiece(cut, piece, at[row]);
    });
    uint32_t cell = 0;
    for (uint32_t row = 0; row < cut.rows.size(); ++row) {
      for (; cell < cut.rows[row].pastCell; ++cell) writeCell(brick, {cell}, at[row]);
    }
  }

 private:
  void writePiece(const BrickCut& cut, uint32_t piece, BrickCounts& at) const {
    const uint32_t f = triFaces_ + at.pieces++;
    const Slab& gridFace = cut.gridFaces[piece];
    const int axis = planeAxis(gridFace);
    out_.faceTriangle[f] = -1;
    out_.faceAxis[f] = int8_t(axis);
    out_.facePlane[f] = gridFace[size_t(axis)] >> 1;
    out_.faceLoopOffsets[f] = triLoops_ + at.loops;
    for (const auto loop : cut.loops.groups(cut.faceLoopOffsets[piece], cut.faceLoopOffsets[piece + 1])) {
      out_.loopOffsets[triLoops_ + at.loops++] = triLoopVertices_ + at.loopVertices;
      for (const VertexId v : loop) out_.loopVertices[triLoopVertices_ + at.loopVertices++] = numbers_.vertices[v];
    }
  }

  void writeCell(BrickId brick, CellId cell, BrickCounts& at) const {
    const BrickCut& cut = state_.cuts[brick];
    const uint32_t c = at.cells++;
    out_.cellHalfFaceOffsets[c] = at.halfFaces;
    for (const HalfFace h : cut.halfFaces[cell]) {
      const uint32_t face = h.face().number;
      const uint32_t f = face < triFaces_ ? face : triFaces_ + numbers_.pieces[brick][face - triFaces_];
      out_.cellHalfFaces[at.halfFaces++] = HalfFace({f}, h.side()).number;
    }
    const Slab gridCell = state_.bricks.boxes[brick].cellAt(cut.gridCells[cell]);
    for (size_t d = 0; d < 3; ++d) out_.cellGridCell[3 * size_t(c) + d] = gridCell[d] >> 1;
    out_.cellRegion[c] = state_.regions.ofComponents[brick][cut.components[cell]];
  }

  const CutState& state_;
  const Numbers& numbers_;
  CutMesh& out_;
  const uint32_t triFaces_, triLoops_, triLoopVertices_;
};

/// Makes room for faces and cells, and ends their offsets. Those of tri-cut-faces are moved.
void resize(TriFaces& tri, const BrickCounts& total, CutMesh& out) {
  const size_t triFaces = tri.size(), faces = triFaces + total.pieces;
  const uint32_t triLoops = uint32_t(tri.loops.size()), loops = triLoops + total.loops;
  const uint32_t loopVertices = uint32_t(tri.loops.items.size()) + total.loopVertices;
  out.faceTriangle.resize(faces);
  out.faceAxis.resize(faces, -1);
  out.facePlane.resize(faces);
  out.faceLoopOffsets = std::move(tri.faceLoopOffsets);
  for (uint32_t f = uint32_t(out.faceLoopOffsets.size()); f <= triFaces; ++f) out.faceLoopOffsets.push_back(f);  // one loop each
  out.faceLoopOffsets.resize(faces + 1, loops);
  out.loopOffsets = std::move(tri.loops.offsets);
  out.loopOffsets.resize(size_t(loops) + 1, loopVertices);
  out.loopVertices.resize(loopVertices);
  out.cellHalfFaceOffsets.resize(size_t(total.cells) + 1, total.halfFaces);
  out.cellHalfFaces.resize(total.halfFaces);
  out.cellGridCell.resize(3 * size_t(total.cells));
  out.cellRegion.resize(total.cells);
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

/// The vertices of the cut-mesh, in order.
std::vector<VertexId> listUsed(const Numbers& numbers) {
  std::vector<VertexId> used(numbers.vertexCount);
  for (const VertexId v : numbers.vertices.ids()) {
    if (numbers.vertices[v] != Numbers::kUnused) used[numbers.vertices[v]] = v;
  }
  return used;
}

/// Writes vertices, faces and cells, whose places are known.
void writeAll(const CutState& state, const Numbers& numbers, VertexWriter& vertexWriter, CutMesh& out, Run& run) {
  const TriFaces& tri = state.triFaces;
  const std::vector<VertexId> used = listUsed(numbers);
  vertexWriter.resize(used.size());
  const BrickWriter brickWriter(state, numbers, out);
  const size_t loopVertices = tri.loops.items.size();
  const size_t bricks = state.cuts.size(), faces = bricks + Block::count(tri.size()), loops = faces + Block::count(loopVertices);
  std::vector<uint32_t> tasks(loops + Block::count(used.size()));
  std::iota(tasks.begin(), tasks.end(), 0u);
  std::vector<Predicates> predicates(run.monitor.threads());
  runItems(tasks, run.monitor, [&](size_t thread, uint32_t task) {
    if (task < bricks) return brickWriter.write({task});
    if (task < faces) return writeTriFaces(tri, Block::at(task - bricks, tri.size()), out);
    if (task < loops) return writeTriLoops(tri, numbers, Block::at(task - faces, loopVertices), out);
    const Block block = Block::at(task - loops, used.size());
    for (size_t i = block.begin; i < block.end; ++i) vertexWriter.write(used[i], i, predicates[thread]);
  });
  for (const Predicates& p : predicates) run.count(p);
  vertexWriter.writeMade(used);
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
void writeParents(const Input& input, const TriFaces& faces, size_t all, CutMesh& out) {
  struct Parent {
    uint32_t triangle;
    int8_t sign;
  };
  out.faceParentOffsets.reserve(all + 1);
  out.faceParents.reserve(faces.size());
  out.faceParentSigns.reserve(faces.size());
  out.faceParentOffsets.push_back(0);
  const FaceParents parents(input, faces);
  std::vector<Parent> sorted;
  for (const FaceId f : faces.ids()) {
    sorted.clear();
    parents.forEach(f, [&](TriangleId t, bool sameWay) { sorted.push_back({t.number, int8_t(sameWay ? 1 : -1)}); });
    if (sorted.size() > 1) sortItems(sorted, [](const Parent& a, const Parent& b) { return a.triangle < b.triangle; });
    for (const Parent& p : sorted) {
      out.faceParents.push_back(p.triangle);
      out.faceParentSigns.push_back(p.sign);
    }
    out.faceParentOffsets.push_back(uint32_t(out.faceParents.size()));
  }
  out.faceParentOffsets.resize(all + 1, uint32_t(out.faceParents.size()));
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
  const Input& input = state.surface.input;
  const Numbers numbers = makeNumbers(state.cutSurface(), state.cuts);
  CutMesh out;
  out.grid = grid;
  resize(state.triFaces, numbers.total, out);
  VertexWriter writer(mesh, grid, state.surface, out);
  writeAll(state, numbers, writer, out, run);
  writeParents(input, state.triFaces, out.faceCount(), out);
  separate(out);

  out.rowRunOffsets = std::move(state.runs.rowOffsets);
  out.runBegin = std::move(state.runs.begin);
  out.runEnd = std::move(state.runs.end);
  Regions& regions = state.regions;
  out.runRegion = std::move(regions.runRegion);
  out.regionCount = regions.count;
  out.hasWinding = regions.hasWinding;
  out.regionWinding = std::move(regions.winding);
  out.regionPartWinding = std::move(regions.partWinding);
  out.regionParity = std::move(regions.parity);
  listParts(input.mesh->parts, out);
  out.triangleCount = uint32_t(input.mesh->triangles.size());
  listDropped(input, out, run.stats);
  return out;
}

}  // namespace mandoline::detail
