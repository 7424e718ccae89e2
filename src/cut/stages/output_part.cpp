#include "cut/stages/output_part.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/large_array.h"
#include "base/position_table.h"
#include "base/run_tasks.h"
#include "base/sort.h"
#include "cut/stages/write_brick.h"

namespace mandoline::detail {
namespace {

/// A part of something that is written by several threads.
struct Block {
  size_t begin, end;

  static constexpr size_t kSize = 8192;
  static size_t count(size_t n) { return (n + kSize - 1) / kSize; }
  static Block at(size_t block, size_t n) { return {block * kSize, std::min(n, (block + 1) * kSize)}; }
};

/// Makes room for all, in the memory that another cut-mesh's arrays have, and ends offsets: each array on one thread, since the first touch
/// of memory takes long.
void makeRoom(const Numbers& numbers, size_t surfaceVertices, CutMesh spare, CutMesh& out, Monitor& monitor) {
  const BrickCounts& total = numbers.here;
  const size_t vertices = surfaceVertices + total.vertices, faces = size_t(total.triFaces) + total.pieces,
               loops = size_t(total.triLoops) + total.loops;
  const uint32_t loopVertices = total.triLoopVertices + total.loopVertices;
  const auto make = [&](auto array, size_t count) {  // all of which is written to
    auto& items = out.*array = std::move(spare.*array);
    if (items.capacity() < count) items.clear();
    reserveLarge(items, count);
    items.resize(count);
  };
  const auto fill = [&](auto array, size_t count, auto item) {
    auto& items = out.*array = std::move(spare.*array);
    items.clear();
    makeLarge(items, count, item);
  };
  const auto makeOffsets = [&](auto array, size_t count, uint32_t end) {
    make(array, count + 1);
    (out.*array).back() = end;
  };
  const std::function<void()> rooms[] = {
      [&] { make(&CutMesh::loopVertices, loopVertices); },
      [&] { make(&CutMesh::positions, 3 * vertices); },
      [&] { make(&CutMesh::vertexCell, 3 * vertices); },
      [&] { fill(&CutMesh::vertexParents, 2 * vertices, -1); },
      [&] { make(&CutMesh::cellHalfFaces, total.halfFaces); },
      [&] { makeOffsets(&CutMesh::loopOffsets, loops, loopVertices); },
      [&] { makeOffsets(&CutMesh::faceLoopOffsets, faces, uint32_t(loops)); },
      [&] { fill(&CutMesh::faceParentOffsets, faces + 1, total.parents); },
      [&] { fill(&CutMesh::faceTriangle, faces, -1); },
      [&] { fill(&CutMesh::facePlane, faces, 0); },
      [&] { make(&CutMesh::faceParents, total.parents); },
      [&] { fill(&CutMesh::vertexTriVertex, vertices, -1); },
      [&] { make(&CutMesh::cellGridCell, 3 * size_t(total.cells)); },
      [&] { makeOffsets(&CutMesh::cellHalfFaceOffsets, total.cells, total.halfFaces); },
      [&] { make(&CutMesh::cellRegion, total.cells); },
      [&] { fill(&CutMesh::faceAxis, faces, int8_t(-1)); },
      [&] { make(&CutMesh::faceParentSigns, total.parents); },
      [&] { fill(&CutMesh::vertexMask, vertices, uint8_t(0)); },
  };
  runTasks(rooms, monitor);
}

/// Writes cut-vertices one by one.
class VertexWriter {
 public:
  /// `mesh` and `grid` are those of the user.
  VertexWriter(const MeshView& mesh, const Grid& grid, const Input& input, const KeptVertices& kept, CutMesh& out)
      : mesh_(mesh), grid_(grid), input_(input), kept_(kept), scale_(input.mesh->shift), out_(out) {}

  /// Vertex v becomes number i.
  void write(const CutVertices& vertices, VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices.slab(v);
    for (int d = 0; d < 3; ++d) {
      out_.vertexCell[3 * i + d] = slab[d] >> 1;
      if (onPlane(slab[d])) out_.vertexMask[i] |= uint8_t(1 << d);
    }
    writePosition(vertices, v, i, predicates);
    writeParents(vertices, v, i);
  }

  CutMesh& out() const { return out_; }

 private:
  /// Coordinates that the input has are handed back as they are, even where scaling flushed them.
  void writePosition(const CutVertices& vertices, VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices.slab(v);
    double* position = &out_.positions[3 * i];
    const bool isOfMesh = isTriVertex(vertices, v);
    const double* before = isOfMesh ? nullptr : kept_.find(i);
    if (before) {
      std::copy_n(before, 3, position);
      return;
    }
    const Point p = isOfMesh ? Point() : vertices.position(v, predicates);
    for (size_t d = 0; d < 3; ++d) {
      position[d] = onPlane(slab[d]) ? grid_.planes[d][size_t(slab[d] >> 1)]
                    : isOfMesh       ? mesh_.positions[3 * size_t(v.number) + d]
                                     : scale_.world(p[d]);
    }
  }
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
  const KeptVertices& kept_;
  const Scale scale_;
  CutMesh& out_;
};

/// Those of the vertices of the mesh and its edges that lie in the layers that are cut here.
std::vector<VertexId> onLayers(const BricksHere& here, const CutVertices& vertices, const std::vector<VertexId>& used) {
  std::vector<VertexId> on;
  on.reserve(used.size());
  for (const VertexId v : used) {
    const int32_t z = vertices.slab(v)[2];
    if (z >= 2 * here.firstLayer && z <= 2 * here.pastLayer) on.push_back(v);
  }
  return on;
}

/// Their numbers, where no share before has them.
std::vector<uint32_t> numbersOf(const std::vector<VertexId>& surface, const CutState& state, const Numbers& numbers) {
  const int32_t first = state.bricks.here.firstLayer;
  std::vector<uint32_t> list;
  list.reserve(surface.size());
  for (const VertexId v : surface) {
    const bool isOthers = first > 0 && state.surface.vertices.slab(v)[2] == 2 * first;
    list.push_back(isOthers ? Numbers::kUnused : numbers.ofSurface[v]);
  }
  return list;
}

/// Writes vertices, of which those of `surface` come first, faces and cells, whose places are known.
void writeAll(const CutState& state, const Numbers& numbers, const std::vector<VertexId>& surface, VertexWriter& vertexWriter, Run& run) {
  const BricksHere& here = state.bricks.here;
  std::vector<uint32_t> tasks(here.size() + Block::count(surface.size()));
  std::iota(tasks.begin(), tasks.end(), here.first.number);
  const uint32_t before = numbers.surfaceVertices + numbers.before.vertices - uint32_t(surface.size());
  std::vector<Predicates> predicates(run.monitor.threads());
  runItems(tasks, run.monitor, [&](size_t thread, uint32_t task) {
    if (!here.has({task})) {
      const Block block = Block::at(task - here.past.number, surface.size());
      for (size_t i = block.begin; i < block.end; ++i) vertexWriter.write(state.surface.vertices, surface[i], i, predicates[thread]);
      return;
    }
    writeBrick(state, {task}, vertexWriter.out());
    const BrickCut& cut = state.cuts[{task}];
    forOwn(cut, &BrickRow::pastVertex, state.seams[{task}].vertices, [&](uint32_t, uint32_t first, uint32_t past) {
      for (uint32_t i = first; i < past; ++i) {
        const VertexId v = cut.lineVertices[i];
        vertexWriter.write(cut.vertices, v, numbers.vertex({task}, v) - before, predicates[thread]);
      }
    });
  });
  for (const Predicates& p : predicates) run.count(p);
}

/// Moves made vertices that rounding put onto another one by a few units in the last place, so that no two have the same position.
/// Vertices on different grid elements never need it: see CutVertices::position. At a grid vertex there is one; inside of a grid cell there
/// are those of the mesh alone, unless triangles meet. Kept vertices have been moved before.
void separate(CutMesh& out, const KeptVertices& kept, bool doTrianglesMeet) {
  const uint8_t inCell = doTrianglesMeet ? 7 : 0;
  std::vector<uint32_t> mayMeet;
  for (uint32_t v = 0; v < out.vertexMask.size(); ++v) {
    if (out.vertexMask[v] != 7 && out.vertexMask[v] != inCell && !kept.find(v)) mayMeet.push_back(v);
  }
  PositionTable table(mayMeet.size(), [&](uint32_t v) { return &out.positions[3 * size_t(v)]; });
  for (const uint32_t v : mayMeet) {
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

}  // namespace

std::vector<VertexId> listUsed(const UsedVertices& used) {
  std::vector<VertexId> list;
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (used[v].load(std::memory_order_relaxed)) list.push_back({v});
  }
  return list;
}

CutPart makePart(const MeshView& mesh, const Grid& grid, CutState& state, Run& run) {
  const Input& input = state.surface.input;
  state.numbers = makeNumbers(state.cut(), state.used, run);
  const Numbers& numbers = state.numbers;
  KeptVertices kept;
  if (!state.kept.before.empty())
    kept = {findKeptVertices(state.cut(), state.kept, state.before->numbers, numbers), state.before->positions};
  CutPart part;
  CutMesh& out = part.cutMesh;
  out.grid = grid;
  const std::vector<VertexId> used = listUsed(state.used);
  const std::vector<VertexId> surface = onLayers(state.bricks.here, state.surface.vertices, used);
  if (state.bricks.here.isShare) part.firstVertices = numbersOf(surface, state, numbers);
  makeRoom(numbers, surface.size(), std::exchange(state.spare, {}), out, run.monitor);
  VertexWriter writer(mesh, grid, input, kept, out);
  writeAll(state, numbers, surface, writer, run);
  const auto isMade = [&](VertexId v) { return state.surface.vertices.isImplicit(v); };
  separate(out, kept, input.mesh->hasIntersections() && std::any_of(used.begin(), used.end(), isMade));
  part.triFaces = numbers.here.triFaces;
  return part;
}

}  // namespace mandoline::detail
