#include "cut/stages/output.h"

#include <cmath>
#include <numeric>

#include "base/large_array.h"
#include "base/position_table.h"
#include "base/run_tasks.h"
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

/// Writes what belongs to bricks: tri-cut-faces, pieces of grid-faces, which come after them, and cut-cells.
class BrickWriter {
 public:
  BrickWriter(const CutState& state, const Numbers& numbers, CutMesh& out) : state_(state), numbers_(numbers), out_(out) {}

  void write(BrickId brick) const {
    const BrickCut& cut = state_.cuts[brick];
    const BrickSeams& seams = state_.seams[brick];
    std::vector<BrickCounts> at = numbers_.rows[brick];  // where what comes next goes
    const FaceParents parents(state_.surface.input, cut.triangles, cut.otherParents);
    auto inPlane = cut.triFacesInPlane.begin();
    forOwn(cut, &BrickRow::pastTriFace, seams.triFaces, [&](uint32_t row, uint32_t first, uint32_t past) {
      for (uint32_t i = first; i < past; ++i) {
        const FaceId face = cut.triOrder[i];
        const uint32_t f = numbers_.faces[brick][face.number];
        out_.faceTriangle[f] = int32_t(cut.triangles[face].number);
        writeLoops(brick, face, f, at[row].triLoops, at[row].triLoopVertices);
        writeParents(parents, face, f, at[row].parents);
        while (inPlane != cut.triFacesInPlane.end() && inPlane->place < i) ++inPlane;  // that of another brick
        if (inPlane != cut.triFacesInPlane.end() && inPlane->place == i) writePlane(inPlane->plane, f);
      }
    });
    const BrickCounts& total = numbers_.total;
    forOwn(cut, &BrickRow::pastPiece, seams.pieces, [&](uint32_t row, uint32_t first, uint32_t past) {
      uint32_t loops = total.triLoops + at[row].loops, loopVertices = total.triLoopVertices + at[row].loopVertices;
      for (uint32_t i = first; i < past; ++i) {
        const FaceId face{uint32_t(cut.triangles.size()) + i};
        const uint32_t f = numbers_.faces[brick][face.number];
        writePlane(cut.pieces[i], f);
        writeLoops(brick, face, f, loops, loopVertices);
      }
      at[row].loops = loops - total.triLoops;
      at[row].loopVertices = loopVertices - total.triLoopVertices;
    });
    uint32_t cell = 0;
    for (uint32_t row = 0; row < cut.rows.size(); ++row) {
      for (; cell < cut.rows[row].pastCell; ++cell) writeCell(brick, {cell}, at[row]);
    }
  }

 private:
  void writePlane(const AxialPlane& plane, uint32_t f) const {
    out_.faceAxis[f] = int8_t(plane.axis);
    out_.facePlane[f] = plane.plane;
  }

  void writeLoops(BrickId brick, FaceId face, uint32_t f, uint32_t& loops, uint32_t& loopVertices) const {
    const VertexId firstOwn = state_.cuts[brick].vertices.firstOwn;
    const uint32_t *ofSurface = numbers_.ofSurface.data(), *ofBrick = numbers_.ofBrick[brick].data();
    out_.faceLoopOffsets[f] = loops;
    for (const auto loop : state_.cuts[brick].loopsOf(face)) {
      out_.loopOffsets[loops++] = loopVertices;
      uint32_t* to = &out_.loopVertices[loopVertices];
      loopVertices += uint32_t(loop.size());
      for (const VertexId v : loop) *to++ = v < firstOwn ? ofSurface[v.number] : ofBrick[v.number - firstOwn.number];
    }
  }

  /// The triangles that a face is a piece of, ascending.
  void writeParents(const FaceParents& parents, FaceId face, uint32_t f, uint32_t& at) const {
    const uint32_t first = at;
    out_.faceParentOffsets[f] = first;
    parents.forEach(face, [&](TriangleId t, bool sameWay) {
      uint32_t place = at++;
      for (; place > first && out_.faceParents[place - 1] > t.number; --place) {
        out_.faceParents[place] = out_.faceParents[place - 1];
        out_.faceParentSigns[place] = out_.faceParentSigns[place - 1];
      }
      out_.faceParents[place] = t.number;
      out_.faceParentSigns[place] = sameWay ? 1 : -1;
    });
  }

  void writeCell(BrickId brick, CellId cell, BrickCounts& at) const {
    const BrickCut& cut = state_.cuts[brick];
    const uint32_t c = at.cells++;
    out_.cellHalfFaceOffsets[c] = at.halfFaces;
    for (const HalfFace h : cut.halfFaces[cell]) {
      out_.cellHalfFaces[at.halfFaces++] = HalfFace({numbers_.faces[brick][h.face().number]}, h.side()).number;
    }
    const Slab gridCell = state_.bricks.boxes[brick].cellAt(cut.gridCells[cell]);
    for (size_t d = 0; d < 3; ++d) out_.cellGridCell[3 * size_t(c) + d] = gridCell[d] >> 1;
    out_.cellRegion[c] = state_.regions.ofComponents[brick][cut.components[cell]];
  }

  const CutState& state_;
  const Numbers& numbers_;
  CutMesh& out_;
};

/// Makes room for all, and ends offsets: each array on one thread, since the first touch of memory takes long.
void makeRoom(const Numbers& numbers, CutMesh& out, Monitor& monitor) {
  const BrickCounts& total = numbers.total;
  const size_t vertices = size_t(numbers.surfaceVertices) + total.vertices, faces = size_t(total.triFaces) + total.pieces,
               loops = size_t(total.triLoops) + total.loops;
  const uint32_t loopVertices = total.triLoopVertices + total.loopVertices;
  const std::function<void()> rooms[] = {
      [&] { makeLarge(out.loopVertices, loopVertices); },
      [&] { makeLarge(out.positions, 3 * vertices); },
      [&] { makeLarge(out.vertexCell, 3 * vertices); },
      [&] { makeLarge(out.vertexParents, 2 * vertices, -1); },
      [&] { makeLarge(out.cellHalfFaces, total.halfFaces); },
      [&] { makeLarge(out.loopOffsets, loops + 1, loopVertices); },
      [&] { makeLarge(out.faceLoopOffsets, faces + 1, uint32_t(loops)); },
      [&] { makeLarge(out.faceParentOffsets, faces + 1, total.parents); },
      [&] { makeLarge(out.faceTriangle, faces, -1); },
      [&] { makeLarge(out.facePlane, faces); },
      [&] { makeLarge(out.faceParents, total.parents); },
      [&] { makeLarge(out.vertexTriVertex, vertices, -1); },
      [&] { makeLarge(out.cellGridCell, 3 * size_t(total.cells)); },
      [&] { makeLarge(out.cellHalfFaceOffsets, size_t(total.cells) + 1, total.halfFaces); },
      [&] { makeLarge(out.cellRegion, total.cells); },
      [&] { makeLarge(out.faceAxis, faces, -1); },
      [&] { makeLarge(out.faceParentSigns, total.parents); },
      [&] { makeLarge(out.vertexMask, vertices); },
  };
  runTasks(rooms, monitor);
}

/// Writes cut-vertices one by one.
class VertexWriter {
 public:
  /// `mesh` and `grid` are those of the user.
  VertexWriter(const MeshView& mesh, const Grid& grid, const Input& input, CutMesh& out)
      : mesh_(mesh), grid_(grid), input_(input), scale_(input.mesh->shift), out_(out) {}

  /// Vertex v becomes number i.
  void write(const CutVertices& vertices, VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices.slab(v);
    const Point p = vertices.position(v, predicates);
    for (int d = 0; d < 3; ++d) {
      out_.vertexCell[3 * i + d] = slab[d] >> 1;
      if (onPlane(slab[d])) out_.vertexMask[i] |= uint8_t(1 << d);
      // Coordinates that the input has are handed back as they are, even where scaling flushed them.
      out_.positions[3 * i + d] = onPlane(slab[d])           ? grid_.planes[d][size_t(slab[d] >> 1)]
                                  : isTriVertex(vertices, v) ? mesh_.positions[3 * size_t(v.number) + d]
                                                             : scale_.world(p[d]);
    }
    writeParents(vertices, v, i);
  }

  /// Adds the vertices that triangles make by meeting; `used` are those of the mesh and its edges in the cut-mesh, in order.
  void writeMade(const CutVertices& vertices, const std::vector<VertexId>& used) {
    if (!input_.mesh->hasIntersections()) return;
    for (uint32_t i = 0; i < used.size(); ++i) {
      if (!vertices.isImplicit(used[i])) continue;
      out_.madeVertices.push_back(i);
      int32_t parents[4] = {-1, -1, -1, -1};
      MadeVertex kind = MadeVertex::trianglesPlane;
      if (vertices.isTriVertex(used[i])) {
        const PointKey& key = input_.mesh->arrangement->points.key(used[i].number);
        const int count = key.kind == PointKey::Kind::edgeEdge ? 4 : 3;
        for (int k = 0; k < count; ++k) parents[k] = int32_t(key.ids[size_t(k)]);
        kind = key.kind == PointKey::Kind::edgeEdge       ? MadeVertex::edgeEdge
               : key.kind == PointKey::Kind::edgeTriangle ? MadeVertex::edgeTriangle
                                                          : MadeVertex::triangles;
      } else {
        const Line line = vertices.edges->line(vertices.triEdge(used[i]));
        parents[0] = int32_t(std::min(line.a, line.b));
        parents[1] = int32_t(std::max(line.a, line.b));
      }
      out_.madeVertexKinds.push_back(uint8_t(kind));
      out_.madeVertexParents.insert(out_.madeVertexParents.end(), parents, parents + 4);
    }
  }

 private:
  bool isTriVertex(const CutVertices& vertices, VertexId v) const { return vertices.isTriVertex(v) && !input_.mesh->isMade(v); }

  void writeParents(const CutVertices& vertices, VertexId v, size_t i) {
    int32_t* parents = &out_.vertexParents[2 * i];
    if (isTriVertex(vertices, v)) {
      out_.vertexTriVertex[i] = parents[0] = parents[1] = int32_t(v.number);
    } else if (vertices.isOnEdge(v)) {
      const Line line = vertices.edges->line(vertices.triEdge(v));
      if (line.ofPlanes) return;
      parents[0] = int32_t(std::min(line.a, line.b));
      parents[1] = int32_t(std::max(line.a, line.b));
    } else if (vertices.isInTriangle(v)) {
      parents[0] = int32_t(vertices.triangle(v).number);
    }
  }

  const MeshView& mesh_;
  const Grid& grid_;
  const Input& input_;
  const Scale scale_;
  CutMesh& out_;
};

/// The vertices of the mesh and its edges in the cut-mesh, in order.
std::vector<VertexId> listUsed(const Numbers& numbers, VertexId firstInTriangle) {
  std::vector<VertexId> used;
  used.reserve(numbers.surfaceVertices);
  for (const VertexId v : Ids<VertexId>(VertexId{0}, firstInTriangle)) {
    if (numbers.ofSurface[v] != Numbers::kUnused) used.push_back(v);
  }
  return used;
}

/// Writes vertices, faces and cells, whose places are known.
void writeAll(const CutState& state, const Numbers& numbers, VertexWriter& vertexWriter, CutMesh& out, Run& run) {
  const CutVertices& vertices = state.surface.vertices;
  const std::vector<VertexId> used = listUsed(numbers, vertices.firstInTriangle);
  const BrickWriter brickWriter(state, numbers, out);
  const size_t bricks = state.cuts.size();
  std::vector<uint32_t> tasks(bricks + Block::count(used.size()));
  std::iota(tasks.begin(), tasks.end(), 0u);
  std::vector<Predicates> predicates(run.monitor.threads());
  runItems(tasks, run.monitor, [&](size_t thread, uint32_t task) {
    if (task >= bricks) {
      const Block block = Block::at(task - bricks, used.size());
      for (size_t i = block.begin; i < block.end; ++i) vertexWriter.write(vertices, used[i], i, predicates[thread]);
      return;
    }
    brickWriter.write({task});
    const BrickCut& cut = state.cuts[{task}];
    forOwn(cut, &BrickRow::pastVertex, state.seams[{task}].vertices, [&](uint32_t, uint32_t first, uint32_t past) {
      for (uint32_t i = first; i < past; ++i) {
        const VertexId v = cut.lineVertices[i];
        vertexWriter.write(cut.vertices, v, numbers.vertex({task}, v), predicates[thread]);
      }
    });
  });
  for (const Predicates& p : predicates) run.count(p);
  vertexWriter.writeMade(vertices, used);
}

/// Moves made vertices that rounding put onto another one by a few units in the last place, so that no two have the same position.
/// Vertices on different grid elements never need it: see CutVertices::position. At a grid vertex there is one; inside of a grid cell there
/// are those of the mesh alone, unless triangles meet.
void separate(CutMesh& out) {
  const uint32_t n = uint32_t(out.vertexMask.size());
  const uint8_t inCell = out.madeVertices.empty() ? 0 : 7;
  const auto isAlone = [&](uint8_t mask) { return mask == 7 || mask == inCell; };
  const auto alone = std::count_if(out.vertexMask.begin(), out.vertexMask.end(), isAlone);
  PositionTable table(n - size_t(alone), [&](uint32_t v) { return &out.positions[3 * size_t(v)]; });
  for (uint32_t v = 0; v < n; ++v) {
    if (isAlone(out.vertexMask[v])) continue;
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
  const Numbers numbers = makeNumbers(state.surface, state.cuts, state.seams, run);
  CutMesh out;
  out.grid = grid;
  makeRoom(numbers, out, run.monitor);
  VertexWriter writer(mesh, grid, input, out);
  writeAll(state, numbers, writer, out, run);
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
