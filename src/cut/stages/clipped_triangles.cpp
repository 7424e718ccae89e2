#include "cut/stages/clipped_triangles.h"

#include "base/prefetch.h"
#include "base/run_tasks.h"
#include "base/sort.h"
#include "cut/stages/dicer.h"

namespace mandoline::detail {
namespace {

constexpr size_t kMost = size_t(1) << 31;  // loop entries, vertices

[[noreturn]] void failTooLarge(int64_t element) {
  throw Failure{{Status::meshTooLarge, element, -1, "The cut-mesh would have more than 2^31 loop entries or vertices."}};
}

/// What one chunk of triangles makes. Ids of its own vertices count from those of the surface on.
struct ClippedChunk {
  ClippedTriangles clipped;
  std::vector<Slab> slabs;
  std::vector<TriangleId> parents;
  Predicates predicates;

  VertexId addVertex(const Slab& slab, TriangleId parent, const CutVertices& ofSurface) {
    slabs.push_back(slab);
    parents.push_back(parent);
    return {uint32_t(ofSurface.size() + slabs.size() - 1)};
  }
  /// To be called now and then while a triangle is diced, which may have millions of pieces; `entries`: of their loops.
  void watch(size_t entries, TriangleId triangle, const Surface& surface, Monitor& monitor) const {
    if (entries > kMost || surface.vertices.size() + slabs.size() > kMost) failTooLarge(triangle.number);
    monitor.report(triangle.number, surface.input.mesh->triangles.size());
  }
};

/// Clips triangles that others don't reach into.
class Clipper {
 public:
  Clipper(const Surface& surface, const BrickGrid& bricks, Run& run, ClippedChunk& chunk)
      : surface_(surface),
        input_(surface.input),
        vertices_(surface.vertices),
        bricks_(bricks),
        monitor_(run.monitor),
        chunk_(chunk),
        dicer_(input_, &bricks, *this) {
    dicer_.onlySweep = run.onlyGeneral;
  }
  Clipper(const Clipper&) = delete;
  ~Clipper() { chunk_.predicates.fallbacks += dicer_.predicates.fallbacks; }

  void clip(TriangleId triangle) {
    triangle_ = triangle;
    const auto t = input_.verticesOf(triangle);
    const Extent extent = Extent::of(input_.slabs[t[0]], input_.slabs[t[1]], input_.slabs[t[2]]);
    if (bricks_.isInsideOne(extent.least, extent.greatest)) return giveBrick(extent.least, ClippedTriangles::kWhole);
    bool isWhole = true, isBesideSeam = false;
    for (size_t d = 0; d < 3; ++d) {
      const int32_t least = extent.least[d], greatest = extent.greatest[d], end = 2 * bricks_.cells[d];
      if (greatest < 0 || least > end) return;
      isWhole &= least == greatest || (least >= 0 && greatest <= end && bricks_.isOneBrick(d, least | 1, greatest - 1));
      isBesideSeam |= bricks_.isBetween(d, least) || bricks_.isBetween(d, greatest);
    }
    if (!isWhole) {
      outlineOf(surface_, triangle, outline_);
      return dicer_.dice(triangle, outline_.all(), extent);
    }
    give(extent.element(), ClippedTriangles::kWhole);
    if (!isBesideSeam) return;
    outlineOf(surface_, triangle, outline_);
    noteSeamVertices(outline_.all());
  }

  // For the dicer.
  VertexId addVertex(const Slab& slab) { return chunk_.addVertex(slab, triangle_, vertices_); }
  void addHybridEdge(const FaceEdge& edge) {
    chunk_.clipped.hybridEdges.push_back(edge);
    chunk_.clipped.hybridTriangles.push_back(triangle_);
  }
  void addPiece(Polygon polygon, const Slab& element) {
    Csr<Corner>& pieces = chunk_.clipped.pieces;
    give(element, uint32_t(pieces.size()));
    pieces.items.insert(pieces.items.end(), polygon.begin(), polygon.end());
    pieces.endGroup();
    noteSeamVertices(polygon);
    if (pieces.size() % 1024 == 0) chunk_.watch(pieces.items.size(), triangle_, surface_, monitor_);
  }

 private:
  void give(const Slab& element, uint32_t piece) {
    bricks_.forBricks(element, [&](const Slab& cell) { giveBrick(cell, piece); });
  }
  /// The brick that has a cell, or an element that lies inside of it.
  void giveBrick(const Slab& cell, uint32_t piece) {
    if (bricks_.hasCell(cell)) chunk_.clipped.parts.push_back({bricks_.keyOf(cell), triangle_, piece});
  }
  void noteSeamVertices(Polygon polygon) {
    for (const Corner& c : polygon) {
      if (planeCount(c.slab) < 2 || !bricks_.isOnSeam(c.slab)) continue;
      chunk_.clipped.seamVertices.push_back(c.id);
      chunk_.clipped.seamTriangles.push_back(triangle_);
    }
  }

  const Surface& surface_;
  const Input& input_;
  const CutVertices& vertices_;
  const BrickGrid& bricks_;
  Monitor& monitor_;
  ClippedChunk& chunk_;
  TriangleId triangle_{0};
  CornerRow outline_;
  Dicer<Clipper> dicer_;
};

/// Dices triangles that others reach into by all planes.
class WholeDicer {
 public:
  WholeDicer(const Surface& surface, Monitor& monitor, ClippedChunk& chunk)
      : surface_(surface),
        input_(surface.input),
        vertices_(surface.vertices),
        monitor_(monitor),
        chunk_(chunk),
        dicer_(input_, nullptr, *this) {
    dicer_.onlySweep = true;  // loops begin where it begins
  }
  WholeDicer(const WholeDicer&) = delete;
  ~WholeDicer() { chunk_.predicates.fallbacks += dicer_.predicates.fallbacks; }

  /// False if others don't reach into the triangle.
  bool dice(TriangleId triangle) {
    if (!input_.mesh->hasIntersections()) return false;
    const Arrangement& arrangement = *input_.mesh->arrangement;
    if (!arrangement.isReachedInto(triangle.number)) return false;
    const auto vertices = arrangement.innerVertices[triangle.number];
    const bool overlaps = !arrangement.overlaps[triangle.number].empty();  // its faces are told apart by how they are connected
    triangle_ = triangle;
    onLines_.clear();
    const auto add = [&](VertexId v) {
      if (vertices_.isUsed(v) && planeCount(vertices_.slab(v)) > 1) onLines_.push_back({v, vertices_.slab(v)});
    };
    for (const uint32_t v : vertices) add({v});
    for (const TriEdgeId e : surface_.edges().innerOf(triangle)) {
      for (const VertexId v : vertices_.crossings(e)) add(v);
    }
    sortItems(onLines_, [](const Corner& a, const Corner& b) { return a.slab < b.slab; });
    outlineOf(surface_, triangle, outline_);
    dicer_.dice(triangle, outline_.all(), Extent::of(outline_.all()), overlaps);
    return true;
  }

  // For the dicer.
  VertexId addVertex(const Slab& slab) {
    const auto known = std::lower_bound(onLines_.begin(), onLines_.end(), slab, [](const Corner& c, const Slab& s) { return c.slab < s; });
    if (known != onLines_.end() && known->slab == slab) return known->id;
    return chunk_.addVertex(slab, triangle_, vertices_);
  }
  void addHybridEdge(const FaceEdge& edge) {
    chunk_.clipped.undivided.hybridEdges.push_back(edge);
    chunk_.clipped.undivided.hybridTriangles.push_back(triangle_);
  }
  void addPiece(Polygon polygon, const Slab& element) {
    TriFaces& faces = chunk_.clipped.undivided;
    for (const Corner& c : polygon) faces.loops.items.push_back(c.id);
    faces.loops.endGroup();
    faces.endFace(triangle_, element, false);
    if (faces.size() % 4096 == 0) chunk_.watch(faces.loops.items.size(), triangle_, surface_, monitor_);
  }

 private:
  const Surface& surface_;
  const Input& input_;
  const CutVertices& vertices_;
  Monitor& monitor_;
  ClippedChunk& chunk_;
  TriangleId triangle_{0};
  CornerRow outline_;
  std::vector<Corner> onLines_;  // vertices of the arrangement inside of the triangle that lie on grid lines, by slab
  Dicer<WholeDicer> dicer_;
};

template <class Item>
void appendItems(const std::vector<Item>& more, std::vector<Item>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Appends what all chunks made, each array on one thread.
class ChunkJoiner {
 public:
  ChunkJoiner(const std::vector<ClippedChunk>& chunks, VertexId firstInTriangle, ClippedTriangles& all)
      : chunks_(chunks), firstInTriangle_(firstInTriangle), all_(all) {}

  void run(Monitor& monitor) {
    const std::function<void()> tasks[] = {[&] { joinParts(); }, [&] { joinPieces(); }, [&] { joinEdges(); }, [&] { joinUndivided(); }};
    runTasks(tasks, monitor);
  }

 private:
  /// Makes room in one of the arrays for what all chunks have in it.
  template <class ArrayOf>
  void reserve(const ArrayOf& arrayOf) const {
    size_t count = 0;
    for (const ClippedChunk& chunk : chunks_) count += arrayOf(chunk.clipped).size();
    arrayOf(all_).reserve(count + 1);
  }
  /// Calls f(chunk, shifted) for all; shifted(v) is a vertex of a chunk's own, or one of the surface, among those of all.
  template <class F>
  void forEach(const F& f) const {
    uint32_t shift = 0;
    for (const ClippedChunk& chunk : chunks_) {
      f(chunk.clipped, [this, shift](VertexId v) { return v < firstInTriangle_ ? v : VertexId{v.number + shift}; });
      shift += uint32_t(chunk.slabs.size());
    }
  }

  void joinParts() {
    reserve([](auto& clipped) -> auto& { return clipped.parts; });
    uint32_t pieces = 0;
    for (const ClippedChunk& of : chunks_) {
      for (const auto& [brick, triangle, piece] : of.clipped.parts)
        all_.parts.push_back({brick, triangle, piece == ClippedTriangles::kWhole ? piece : piece + pieces});
      pieces += uint32_t(of.clipped.pieces.size());
    }
  }
  void joinPieces() {
    reserve([](auto& clipped) -> auto& { return clipped.pieces.offsets; });
    reserve([](auto& clipped) -> auto& { return clipped.pieces.items; });
    forEach([&](const ClippedTriangles& chunk, const auto& shifted) {
      all_.pieces.append(chunk.pieces, [&](const Corner& c) { return Corner{shifted(c.id), c.slab}; });
    });
  }
  void joinEdges() {
    reserve([](auto& clipped) -> auto& { return clipped.hybridEdges; });
    reserve([](auto& clipped) -> auto& { return clipped.hybridTriangles; });
    reserve([](auto& clipped) -> auto& { return clipped.seamVertices; });
    reserve([](auto& clipped) -> auto& { return clipped.seamTriangles; });
    forEach([&](const ClippedTriangles& chunk, const auto& shifted) {
      appendEdges(chunk.hybridEdges, shifted, all_.hybridEdges);
      appendItems(chunk.hybridTriangles, all_.hybridTriangles);
      for (const VertexId v : chunk.seamVertices) all_.seamVertices.push_back(shifted(v));
      appendItems(chunk.seamTriangles, all_.seamTriangles);
    });
  }
  void joinUndivided() {
    UndividedFaces& faces = all_.undivided;
    forEach([&](const ClippedTriangles& chunk, const auto& shifted) {
      const UndividedFaces& more = chunk.undivided;
      faces.loops.append(more.loops, shifted);
      faces.triangles.insert(faces.triangles.end(), more.triangles.begin(), more.triangles.end());
      faces.elements.insert(faces.elements.end(), more.elements.begin(), more.elements.end());
      appendItems(more.touchesLine, faces.touchesLine);
      appendEdges(more.hybridEdges, shifted, faces.hybridEdges);
      appendItems(more.hybridTriangles, faces.hybridTriangles);
    });
  }

  template <class Shifted>
  static void appendEdges(const std::vector<FaceEdge>& edges, const Shifted& shifted, std::vector<FaceEdge>& all) {
    for (const FaceEdge& e : edges) all.push_back({e.element, shifted(e.from), shifted(e.to)});
  }

  const std::vector<ClippedChunk>& chunks_;
  const VertexId firstInTriangle_;
  ClippedTriangles& all_;
};

}  // namespace

ClippedTriangles clipTriangles(Surface& surface, const BrickGrid& bricks, Run& run, KnownClips* known) {
  const Input& input = surface.input;
  CutVertices& vertices = surface.vertices;
  auto chunks = forChunks<ClippedChunk>(input.mesh->triangles.size(), run.monitor, [&](ClippedChunk& chunk, size_t begin, size_t end) {
    Clipper clipper(surface, bricks, run, chunk);
    WholeDicer dicer(surface, run.monitor, chunk);
    constexpr uint32_t kAhead = 16;  // triangles, whose corners are all over memory
    const TriangleId past{uint32_t(end)};
    for (TriangleId t{uint32_t(begin)}; t < past; ++t.number) {
      if (known && (t = known->pastKnown(t, past)) == past) break;
      if (t.number + kAhead < end) {
        for (const VertexId v : input.verticesOf({t.number + kAhead})) prefetch(&input.slabs[v]);
      }
      if (input.kept(t) && surface.here.has(t) && !dicer.dice(t)) clipper.clip(t);
    }
  });
  size_t entries = 0, made = vertices.size();
  for (const ClippedChunk& c : chunks) {
    entries += std::max(c.clipped.pieces.items.size(), c.clipped.undivided.loops.items.size());
    made += c.slabs.size();
    run.count(c.predicates);
  }
  if (entries > kMost || made > kMost) failTooLarge(-1);
  ClippedTriangles all;
  if (run.monitor.threads() == 1 || chunks.size() == 1) {
    all = std::move(chunks[0].clipped);
  } else {
    ChunkJoiner(chunks, vertices.firstInTriangle, all).run(run.monitor);
  }
  for (const ClippedChunk& c : chunks) {
    appendItems(c.slabs, vertices.slabs);
    appendItems(c.parents, vertices.parentTriangles);
  }
  if (known) known->addTo(all, vertices);
  return all;
}

}  // namespace mandoline::detail
