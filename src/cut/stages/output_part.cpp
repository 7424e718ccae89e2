#include "cut/stages/output_part.h"

#include <functional>
#include <utility>

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "base/sort.h"
#include "cut/stages/separate.h"
#include "cut/stages/write_brick.h"
#include "cut/stages/write_vertices.h"

namespace mandoline::detail {
namespace {

/// The arrays of a result, in the memory that those of another cut-mesh have; `kept`: of that one, or null. Memory for what is written next
/// is got at once, that of each array on one thread, from what this one has freed if there is such; offsets are ended.
class Rooms {
 public:
  Rooms(const Numbers& numbers, CutMesh spare, const KeptArrays* kept, CutMesh& out, Monitor& monitor)
      : total_(numbers.here),
        faces_(size_t(total_.triFaces) + total_.pieces),
        loops_(size_t(total_.triLoops) + total_.loops),
        spare_(std::move(spare)),
        kept_(kept),
        out_(out),
        monitor_(monitor) {}

  /// Frees one kind of what bricks have, on several threads beside what comes next.
  void free(std::vector<BrickMemory>& memory, Arena BrickMemory::*kind) {
    for (BrickMemory& of : memory) {
      if (monitor_.threads() == 1) {
        of.*kind = {};
      } else {
        tasks_.push_back([&of, kind] { of.*kind = {}; });
      }
    }
  }
  void run() { runTasks(std::exchange(tasks_, {}), monitor_); }

  void makeForCells() {
    if (kept_) return kept_->placeCells(arrays());
    const size_t cells = total_.cells;
    make(&CutMesh::cellHalfFaces, total_.halfFaces);
    make(&CutMesh::cellGridCell, 3 * cells);
    makeOffsets(&CutMesh::cellHalfFaceOffsets, cells, total_.halfFaces);
    make(&CutMesh::cellRegion, cells);
    run();
  }
  void makeForFaces() {
    if (kept_) return kept_->placeFaces(arrays());
    const uint32_t loopVertices = total_.triLoopVertices + total_.loopVertices;
    make(&CutMesh::loopVertices, loopVertices);
    makeOffsets(&CutMesh::loopOffsets, loops_, loopVertices);
    makeOffsets(&CutMesh::faceLoopOffsets, faces_, uint32_t(loops_));
    makeForPieces(&CutMesh::faceParentOffsets, 1, total_.parents);
    makeForPieces(&CutMesh::faceTriangle, 0, -1);
    makeForTriFaces(&CutMesh::facePlane, 0);
    make(&CutMesh::faceParents, total_.parents);
    makeForTriFaces(&CutMesh::faceAxis, int8_t(-1));
    makeFilled(&CutMesh::faceParentSigns, total_.parents, int8_t(1));
    run();
  }
  void makeForVertices(size_t surfaceVertices) {
    const size_t vertices = surfaceVertices + total_.vertices;
    if (kept_) return kept_->placeVertices(arrays(), vertices);
    make(&CutMesh::positions, 3 * vertices);
    make(&CutMesh::vertexCell, 3 * vertices);
    make(&CutMesh::vertexParents, 2 * vertices);
    makeFilled(&CutMesh::vertexTriVertex, vertices, -1);
    make(&CutMesh::vertexMask, vertices);
    run();
  }

 private:
  KeptArrays::Arrays arrays() { return {spare_, out_, monitor_}; }

  /// Of an array all of which is written to; `fill(array)` begins that.
  template <class Item, class Fill>
  void make(std::vector<Item> CutMesh::*array, size_t count, const Fill& fill) {
    std::vector<Item>& items = out_.*array = std::move(spare_.*array);
    tasks_.push_back([&items, count, fill] {
      if (items.capacity() < count) {
        items.clear();
        reserveUntouched(items, count);
      }
      resizeInRoom(items, count);
      fill(items);
    });
  }
  template <class Item>
  void make(std::vector<Item> CutMesh::*array, size_t count) {
    make(array, count, [](std::vector<Item>&) {});
  }
  /// Of one in which most have the same.
  template <class Item>
  void makeFilled(std::vector<Item> CutMesh::*array, size_t count, Item item) {
    make(array, count, [item](std::vector<Item>& items) { std::fill(items.begin(), items.end(), item); });
  }
  /// Of one in which all tri-cut-faces have the same.
  template <class Item>
  void makeForTriFaces(std::vector<Item> CutMesh::*array, Item item) {
    make(array, faces_, [this, item](std::vector<Item>& items) { std::fill_n(items.begin(), total_.triFaces, item); });
  }
  /// Of one in which all pieces of grid-faces have the same, and `more` after them.
  template <class Item>
  void makeForPieces(std::vector<Item> CutMesh::*array, size_t more, Item item) {
    make(array, faces_ + more, [this, item](std::vector<Item>& items) { std::fill(items.begin() + total_.triFaces, items.end(), item); });
  }
  void makeOffsets(std::vector<uint32_t> CutMesh::*array, size_t count, uint32_t end) {
    make(array, count + 1, [end](std::vector<uint32_t>& items) { items.back() = end; });
  }

  const BrickCounts& total_;
  const size_t faces_, loops_;
  CutMesh spare_;
  const KeptArrays* const kept_;
  CutMesh& out_;
  Monitor& monitor_;
  std::vector<std::function<void()>> tasks_;
};

/// Leaves of vertices of the mesh and its edges those in the layers that are cut here. Gives their numbers, where no share before has them.
std::vector<uint32_t> keepOnLayers(const CutState& state, const Numbers& numbers, std::vector<VertexId>& surface) {
  const auto& [first, past] = state.bricks.grid.here;
  std::vector<uint32_t> list(surface.size());
  size_t count = 0;
  for (const VertexId v : surface) {
    const int32_t z = state.surface.vertices.slab(v)[2];
    const bool isOthers = first > 0 && z == 2 * first;
    surface[count] = v;
    list[count] = isOthers ? Numbers::kUnused : numbers.ofSurface[v];
    count += first < past && z >= 2 * first && z <= 2 * past;
  }
  surface.resize(count);
  list.resize(count);
  return list;
}

/// The vertices that triangles make by meeting. `surface`: those that are written, which have the numbers `ids`, or numbers in order.
void listMade(const CutState& state, const std::vector<VertexId>& surface, const std::vector<uint32_t>& ids, CutMesh& out) {
  const Prepared& mesh = *state.surface.input.mesh;
  if (!mesh.hasIntersections()) return;
  const CutVertices& vertices = state.surface.vertices;
  for (uint32_t i = 0; i < surface.size(); ++i) {
    const VertexId v = surface[i];
    const uint32_t id = ids.empty() ? i : ids[i];
    if (!vertices.isImplicit(v) || id == Numbers::kUnused) continue;
    out.madeVertices.push_back(id);
    int32_t parents[4] = {-1, -1, -1, -1};
    MadeVertex kind = MadeVertex::trianglesPlane;
    if (vertices.isTriVertex(v)) {
      const PointKey& key = mesh.arrangement->points.key(v.number);
      const int count = key.kind == PointKey::Kind::edgeEdge ? 4 : 3;
      for (int k = 0; k < count; ++k) parents[k] = int32_t(key.ids[size_t(k)]);
      kind = key.kind == PointKey::Kind::edgeEdge       ? MadeVertex::edgeEdge
             : key.kind == PointKey::Kind::edgeTriangle ? MadeVertex::edgeTriangle
                                                        : MadeVertex::triangles;
    } else {
      const Line line = vertices.edges->line(vertices.triEdge(v));
      parents[0] = int32_t(std::min(line.a, line.b));
      parents[1] = int32_t(std::max(line.a, line.b));
    }
    out.madeVertexKinds.push_back(uint8_t(kind));
    out.madeVertexParents.insert(out.madeVertexParents.end(), parents, parents + 4);
  }
}

}  // namespace

WholeTriangles::WholeTriangles(const Prepared& mesh) : count(uint32_t(mesh.triangles.size())) {
  for (uint32_t t = 0; t < count; ++t) {
    if (!mesh.kept(size_t(t))) dropped.push_back(t);
  }
  open.reserve(size_t(std::count(mesh.parts.kinds.begin(), mesh.parts.kinds.end(), PartKind::open)));
  for (uint32_t t = 0; t < mesh.parts.kinds.size(); ++t) {
    if (mesh.parts.kinds[t] == PartKind::parity) parity.push_back(t);
    if (mesh.parts.kinds[t] == PartKind::open) open.push_back(t);
  }
}

std::vector<VertexId> listUsed(const UsedVertices& used) {
  std::vector<VertexId> list(used.size());
  size_t count = 0;
  for (uint32_t v = 0; v < used.size(); ++v) {
    list[count] = {v};
    count += used[v].load(std::memory_order_relaxed);
  }
  list.resize(count);
  return list;
}

CutPart makePart(const MeshView& mesh, const Grid& grid, CutState& state, Run& run) {
  const Input& input = state.surface.input;
  const std::vector<uint32_t> bricks = state.bricks.here.numbers(run.monitor.threads());
  KeptArrays* const keptArrays = state.keeping ? state.keeping->arrays() : nullptr;
  state.numbers = makeNumbers(state.cut(), keptArrays ? keptArrays->bricksToNumber(state) : BricksToNumber{bricks, bricks}, state.used,
                              state.surfaceNumbers ? &*state.surfaceNumbers : nullptr, run);
  const Numbers& numbers = state.numbers;
  const KeptVertices kept = state.keeping ? state.keeping->vertices() : KeptVertices();
  CutPart part;
  CutMesh& out = part.cutMesh;
  out.grid = grid;
  std::vector<VertexId> surface = listUsed(state.used);
  const auto isMade = [&](VertexId v) { return state.surface.vertices.isImplicit(v); };
  const bool haveMade = input.mesh->hasIntersections() && std::any_of(surface.begin(), surface.end(), isMade);
  if (state.bricks.here.isShare) part.firstVertices = keepOnLayers(state, numbers, surface);

  // One kind after the other, so that what the bricks have of it need not last as long as all of the result.
  constexpr size_t kMuch = size_t(1) << 30, kLargePages = size_t(1) << 20;
  const bool isMuch = state.cuts.bytes() > kMuch;
  if (state.cuts.bytes() >= kLargePages) makeRoomInHeap();
  Rooms rooms(numbers, std::exchange(state.spare, {}), keptArrays, out, run.monitor);
  const auto drop = [&](Arena BrickMemory::*kind) {
    if (state.isNeededAgain) return;
    rooms.free(state.cuts.memory, kind);
    if (!isMuch) return;
    rooms.run();
    giveBackFreed();
  };
  drop(&BrickMemory::seams);
  const auto isKept = [&](uint32_t b) { return keptArrays && state.kept->isInner({b}); };
  rooms.makeForCells();
  runItems(bricks, run.monitor, [&](size_t, uint32_t b) {
    if (!isKept(b)) writeCells(state, {b}, out);
    writeRegions(state, {b}, out);
  });
  drop(&BrickMemory::cells);
  rooms.makeForFaces();
  runItems(bricks, run.monitor, [&](size_t, uint32_t b) {
    if (!isKept(b)) writeFaces(state, {b}, out);
  });
  if (!state.isNeededAgain) state.numbers.faces = {};
  drop(&BrickMemory::faces);
  rooms.makeForVertices(surface.size());
  writeVertices(mesh, state, {surface, kept}, out, run);
  listMade(state, surface, part.firstVertices, out);
  if (!state.isNeededAgain) {
    state.cuts = {};
    state.numbers.ofBrick = {};
    if (isMuch) giveBackFreed();
  }

  separate(kept, haveMade, out, run.monitor);
  part.triFaces = numbers.here.triFaces;
  return part;
}

}  // namespace mandoline::detail
