#include "cut/stages/write_vertices.h"

#include <algorithm>
#include <cmath>

#include "base/prefetch.h"

namespace mandoline::detail {
namespace {

/// A part of a list that is gone through by several threads.
struct Block {
  static constexpr size_t kSize = 8192;

  static size_t count(size_t n) { return (n + kSize - 1) / kSize; }
  template <class Item>
  static std::span<const Item> of(std::span<const Item> list, size_t block) {
    return list.subspan(block * kSize, std::min(kSize, list.size() - block * kSize));
  }
};

/// CutVertices::slab() of many vertices.
class SlabsOf {
 public:
  explicit SlabsOf(const CutVertices& vertices)
      : own_(vertices.slabs.data()), surface_(vertices.surface ? vertices.surface->slabs.data() : nullptr), firstOwn_(vertices.firstOwn) {}

  const Slab& operator[](VertexId v) const { return v < firstOwn_ ? surface_[v.number] : own_[v.number - firstOwn_.number]; }

 private:
  const Slab *const own_, *const surface_;
  const VertexId firstOwn_;
};

/// CutVertices::triangle() of many vertices.
class TrianglesOf {
 public:
  explicit TrianglesOf(const CutVertices& vertices)
      : own_(vertices.parentTriangles.data()),
        surface_(vertices.surface ? vertices.surface->parentTriangles.data() : nullptr),
        firstOwn_(vertices.firstOwn),
        firstInTriangle_(vertices.firstInTriangle.number),
        firstOfOwn_(std::max(vertices.firstInTriangle, vertices.firstOwn).number) {}

  TriangleId operator[](VertexId v) const { return v < firstOwn_ ? surface_[v.number - firstInTriangle_] : own_[v.number - firstOfOwn_]; }

 private:
  const TriangleId *const own_, *const surface_;
  const VertexId firstOwn_;
  const uint32_t firstInTriangle_, firstOfOwn_;
};

/// Writes vertices in a row, array by array.
class VertexWriter {
 public:
  using List = std::span<const VertexId>;

  VertexWriter(const MeshView& mesh, const Input& input, const KeptVertices& kept, bool onlyGeneral, CutMesh& out)
      : mesh_(mesh),
        input_(input),
        kept_(kept),
        onlyGeneral_(onlyGeneral),
        scale_(input.mesh->shift),
        isExact_(scale_.isWorldExact()),
        out_(out) {}

  /// Vertices of the mesh and its edges, ascending. The first one becomes number i.
  void writeOnEdges(const CutVertices& vertices, List list, size_t i, Predicates& predicates) {
    forNew(list, i, [&](List part, size_t at) { writePlaces(vertices, part, at); });
    const auto isOfMesh = [&](VertexId v) { return vertices.isTriVertex(v) && !input_.mesh->isMade(v); };
    const size_t count = size_t(std::partition_point(list.begin(), list.end(), isOfMesh) - list.begin());
    forNew(list.first(count), i, [&](List part, size_t at) { writeOfMesh(vertices, part, at); });
    if (kept_.areInPlace) writeZeros(vertices, list.first(count), i);
    list = list.subspan(count);
    i += count;
    const bool areBetweenTriVertices = vertices.edges->lines.empty() && (list.empty() || list.front() >= vertices.firstOnEdge);
    forNew(list, i,
           [&](List part, size_t at) { areBetweenTriVertices ? writeEnds(vertices, part, at) : writeEndsOfLines(vertices, part, at); });
    writePositions(vertices, list, i, predicates);
  }

  /// Others, without positions.
  void writeOthers(const CutVertices& vertices, List list, size_t i) {
    static_assert(int32_t(CutVertices::kNoTriangle.number) == -1);
    const TrianglesOf triangles(vertices);
    forNew(list, i, [&](List part, size_t at) {
      writePlaces(vertices, part, at);
      writeParents(part, at, [&](VertexId v) {
        const TriangleId triangle = triangles[v];
        if (triangle != CutVertices::kNoTriangle) prefetch(&input_.mesh->triangles[triangle.number]);  // for positions
        return Parents{int32_t(triangle.number), -1};
      });
    });
  }

  /// Of those that are not kept.
  void writePositions(const CutVertices& vertices, List list, size_t i, Predicates& predicates) {
    kept_.forOthers(i, i + list.size(), [&](size_t first, size_t past) {
      constexpr size_t kBatch = 32;
      for (size_t begin = first; begin < past; begin += kBatch) {
        const size_t end = std::min(past, begin + kBatch);
        prefetchPoints(begin, end);
        for (size_t at = begin; at < end; ++at) writePosition(vertices, list[at - i], at, predicates);
      }
    });
  }

 private:
  using Parents = std::array<int32_t, 2>;

  static Parents endsOf(const Line& line) {
    if (line.ofPlanes) return {-1, -1};
    return {int32_t(std::min(line.a, line.b)), int32_t(std::max(line.a, line.b))};
  }

  /// Calls f(part, number of its first) for what has to be written of a list whose first vertex becomes number i.
  template <class F>
  void forNew(List list, size_t i, const F& f) const {
    if (!kept_.areInPlace) return f(list, i);
    kept_.forOthers(i, i + list.size(), [&](size_t first, size_t past) { f(list.subspan(first - i, past - first), first); });
  }

  void writePlaces(const CutVertices& vertices, List list, size_t i) {
    int32_t* cells = out_.vertexCell.data() + 3 * i;
    uint8_t* masks = out_.vertexMask.data() + i;
    const SlabsOf slabs(vertices);
    constexpr size_t kAhead = 16;
    for (size_t k = 0; k < list.size(); ++k) {
      if (k + kAhead < list.size()) prefetch(&slabs[list[k + kAhead]]);
      const Slab& slab = slabs[list[k]];
      for (size_t d = 0; d < 3; ++d) *cells++ = slab[d] >> 1;
      *masks++ = uint8_t(7 - (slab[0] & 1) - 2 * (slab[1] & 1) - 4 * (slab[2] & 1));
    }
  }
  void writeOfMesh(const CutVertices& vertices, List list, size_t i) {
    int32_t* triVertices = out_.vertexTriVertex.data() + i;
    int32_t* parents = out_.vertexParents.data() + 2 * i;
    for (const VertexId v : list) {
      *triVertices++ = int32_t(v.number);
      for (int k = 0; k < 2; ++k) *parents++ = int32_t(v.number);
      writeCoordinatesOfMesh(vertices, v, i++);
    }
  }
  /// Coordinates of vertices that are kept: 0 may have become -0, which is the same once it is scaled.
  void writeZeros(const CutVertices& vertices, List list, size_t i) {
    kept_.forKept(i, i + list.size(), [&](const KeptRuns::Run& run) {
      for (size_t at = run.first; at < run.past(); ++at) {
        const Point& p = input_.mesh->point(list[at - i]);
        if (p[0] == 0 || p[1] == 0 || p[2] == 0) writeCoordinatesOfMesh(vertices, list[at - i], at);
      }
    });
  }
  void writeCoordinatesOfMesh(const CutVertices& vertices, VertexId v, size_t i) {
    writeCoordinates(vertices.slab(v), i, [&](size_t d) { return mesh_.positions[3 * size_t(v.number) + d]; });
  }
  /// Of vertices on tri-edges that run between vertices of the mesh.
  void writeEnds(const CutVertices& vertices, List list, size_t i) {
    const TriEdgeId* const edges = vertices.parentEdges.data();
    const std::array<VertexId, 2>* const ends = vertices.edges->ends.data();
    const uint32_t first = vertices.firstOnEdge.number;
    writeParents(list, i, [=](VertexId v) {
      const auto& [low, high] = ends[edges[v.number - first].number];
      return Parents{int32_t(low.number), int32_t(high.number)};
    });
  }
  void writeEndsOfLines(const CutVertices& vertices, List list, size_t i) {
    writeParents(list, i, [&](VertexId v) {
      return vertices.isOnEdge(v) ? endsOf(vertices.edges->line(vertices.triEdge(v))) : Parents{-1, -1};
    });
  }
  /// Of vertices that are not of the mesh. They are no tri-vertices, which is what the array says at first.
  template <class ParentsOf>
  void writeParents(List list, size_t i, const ParentsOf& parentsOf) {
    int32_t* parents = out_.vertexParents.data() + 2 * i;
    for (const VertexId v : list) {
      const Parents of = parentsOf(v);
      for (int k = 0; k < 2; ++k) *parents++ = of[size_t(k)];
    }
  }
  /// Of the parents of vertices first .. past - 1, on edges or in triangles: they are all over memory.
  void prefetchPoints(size_t first, size_t past) const {
    const Prepared& mesh = *input_.mesh;
    for (size_t i = first; i < past; ++i) {
      const int32_t *parents = out_.vertexParents.data() + 2 * i, a = parents[0], b = parents[1];
      if (a < 0) continue;
      if (b < 0) {
        for (const VertexId v : mesh.verticesOf(TriangleId{uint32_t(a)})) prefetch(&mesh.point(v));
      } else {
        prefetch(&mesh.point({uint32_t(a)}));
        prefetch(&mesh.point({uint32_t(b)}));
      }
    }
  }
  void writePosition(const CutVertices& vertices, VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices.slab(v);
    if (planeCount(slab) == 3) return writeCoordinates(slab, i, [](size_t) { return 0; });
    const Point p = vertices.position(v, predicates, onlyGeneral_);
    writeCoordinates(slab, i, [&](size_t d) { return isExact_ ? scale_.world(p[d]) : inSlab(scale_.world(p[d]), slab[d], d); });
  }
  /// A coordinate that scaling may have rounded onto one of the planes around it, between them again.
  double inSlab(double x, int32_t slab, size_t d) const {
    const double low = out_.grid.planes[d][size_t(slab >> 1)], high = out_.grid.planes[d][size_t(slab >> 1) + 1];
    if (x <= low) return std::min(std::nextafter(low, high), high);
    return x >= high ? std::max(std::nextafter(high, low), low) : x;
  }
  /// Coordinates that the input has are handed back as they are, even where scaling flushed them; `coordinate(axis)`: others.
  template <class Coordinate>
  void writeCoordinates(const Slab& slab, size_t i, const Coordinate& coordinate) {
    double* position = out_.positions.data() + 3 * i;
    for (size_t d = 0; d < 3; ++d) position[d] = onPlane(slab[d]) ? out_.grid.planes[d][size_t(slab[d] >> 1)] : coordinate(d);
  }

  const MeshView& mesh_;
  const Input& input_;
  const KeptVertices& kept_;
  const bool onlyGeneral_;  // without the quick ways to positions
  const Scale scale_;
  const bool isExact_;  // whether scaling back rounds nothing
  CutMesh& out_;
};

void copyPositions(const KeptVertices& kept, Monitor& monitor, CutMesh& out) {
  if (kept.runs.empty() || kept.areInPlace) return;
  const auto copy = [&](const KeptVertices::Run& run) {
    std::copy_n(kept.positions.data() + 3 * size_t(run.before), 3 * size_t(run.count), out.positions.data() + 3 * size_t(run.first));
  };
  const size_t count = out.vertexCount();
  runChunks(
      count, chunkCount(count, monitor, Block::kSize), monitor, [&](size_t, size_t begin, size_t end) { kept.forKept(begin, end, copy); },
      Block::kSize);
}

}  // namespace

void writeVertices(const MeshView& mesh, const CutState& state, const VerticesToWrite& vertices, CutMesh& out, Run& run) {
  const BricksHere& here = state.bricks.here;
  const Numbers& numbers = state.numbers;
  const std::span<const VertexId> surface = vertices.surface;
  VertexWriter writer(mesh, state.surface.input, vertices.kept, run.onlyGeneral, out);
  copyPositions(vertices.kept, run.monitor, out);
  std::vector<uint32_t> tasks = here.numbers(run.monitor.threads());
  for (size_t block = 0; block < Block::count(surface.size()); ++block) tasks.push_back(here.past.number + uint32_t(block));
  const uint32_t before = numbers.surfaceVertices + numbers.before.vertices - uint32_t(surface.size());
  std::vector<Predicates> predicates(run.monitor.threads());
  runItems(tasks, run.monitor, [&](size_t thread, uint32_t task) {
    if (!here.has({task})) {
      const size_t block = task - here.past.number;
      return writer.writeOnEdges(state.surface.vertices, Block::of(surface, block), block * Block::kSize, predicates[thread]);
    }
    const bool areKept = state.kept && state.kept->isInner({task});
    if (areKept && vertices.kept.areInPlace) return;
    const BrickCut& cut = state.cuts[{task}];
    forOwn(cut, &BrickRow::pastVertex, state.seams[{task}].vertices, [&](uint32_t, uint32_t first, uint32_t past) {
      const size_t number = numbers.vertex({task}, cut.lineVertices[first]) - before;
      const auto list = cut.lineVertices.subspan(first, past - first);
      writer.writeOthers(cut.vertices, list, number);
      if (!areKept) writer.writePositions(cut.vertices, list, number, predicates[thread]);
    });
  });
  for (const Predicates& p : predicates) run.count(p);
}

}  // namespace mandoline::detail
