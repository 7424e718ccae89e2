#include "cut/stages/write_vertices.h"

#include <numeric>

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

/// Writes vertices in a row, array by array.
class VertexWriter {
 public:
  using List = std::span<const VertexId>;

  VertexWriter(const MeshView& mesh, const Input& input, const KeptVertices& kept, bool onlyGeneral, CutMesh& out)
      : mesh_(mesh), input_(input), kept_(kept), onlyGeneral_(onlyGeneral), scale_(input.mesh->shift), out_(out) {}

  /// Vertices of the mesh and its edges, ascending. The first one becomes number i.
  void writeOnEdges(const CutVertices& vertices, List list, size_t i, Predicates& predicates) {
    const auto isOfMesh = [&](VertexId v) { return vertices.isTriVertex(v) && !input_.mesh->isMade(v); };
    const size_t count = size_t(std::partition_point(list.begin(), list.end(), isOfMesh) - list.begin());
    kept_.forOthers(i, i + count, [&](size_t first, size_t past) { writeOfMesh(vertices, partOf(list, i, first, past), first); });
    writeCoordinatesOfMesh(vertices, list.first(count), i);
    kept_.forOthers(i + count, i + list.size(), [&](size_t first, size_t past) {
      writeMade(vertices, partOf(list, i, first, past), first, predicates,
                [&](VertexId v) { return vertices.isOnEdge(v) ? endsOf(vertices.edges->line(vertices.triEdge(v))) : kNone; });
    });
  }
  /// Others.
  void writeOthers(const CutVertices& vertices, List list, size_t i, Predicates& predicates) {
    static_assert(int32_t(CutVertices::kNoTriangle.number) == -1);
    kept_.forOthers(i, i + list.size(), [&](size_t first, size_t past) {
      writeMade(vertices, partOf(list, i, first, past), first, predicates, [&](VertexId v) {
        return Parents{int32_t(vertices.triangle(v).number), -1};
      });
    });
  }
  /// Some of those that are kept, before others are written.
  void copyKept(std::span<const KeptVertices::Run> runs) {
    forVertexArrays([&](auto array, size_t stride) {
      const auto* from = (kept_.before->*array).data();
      auto* to = (out_.*array).data();
      for (const KeptVertices::Run& run : runs) std::copy_n(from + stride * run.before, stride * run.count, to + stride * run.first);
    });
  }

 private:
  using Parents = std::array<int32_t, 2>;
  static constexpr Parents kNone{-1, -1};

  static Parents endsOf(const Line& line) {
    if (line.ofPlanes) return kNone;
    return {int32_t(std::min(line.a, line.b)), int32_t(std::max(line.a, line.b))};
  }

  /// Those with numbers first .. past - 1 of a list that has numbers from i on.
  static List partOf(List list, size_t i, size_t first, size_t past) { return list.subspan(first - i, past - first); }

  /// All but coordinates.
  void writeOfMesh(const CutVertices& vertices, List list, size_t i) {
    writePlaces(vertices, list, i);
    for (const VertexId v : list) {
      out_.vertexTriVertex[i] = int32_t(v.number);
      writeParents(i++, {int32_t(v.number), int32_t(v.number)});
    }
  }
  /// Those of kept vertices, too: others may have become the same by scaling.
  void writeCoordinatesOfMesh(const CutVertices& vertices, List list, size_t i) {
    for (const VertexId v : list)
      writeCoordinates(vertices.slab(v), i++, [&](size_t d) { return mesh_.positions[3 * size_t(v.number) + d]; });
  }
  template <class ParentsOf>
  void writeMade(const CutVertices& vertices, List list, size_t i, Predicates& predicates, const ParentsOf& parentsOf) {
    writePlaces(vertices, list, i);
    std::fill_n(out_.vertexTriVertex.begin() + ptrdiff_t(i), list.size(), -1);
    for (const VertexId v : list) {
      writeParents(i, parentsOf(v));
      writePosition(vertices, v, i++, predicates);
    }
  }
  void writeParents(size_t i, const Parents& parents) {
    for (size_t k = 0; k < 2; ++k) out_.vertexParents[2 * i + k] = parents[k];
  }

  void writePlaces(const CutVertices& vertices, List list, size_t i) {
    int32_t* cells = out_.vertexCell.data() + 3 * i;
    uint8_t* const masks = out_.vertexMask.data() + i;
    for (size_t k = 0; k < list.size(); ++k) {
      const Slab slab = vertices.slab(list[k]);
      for (size_t d = 0; d < 3; ++d) *cells++ = slab[d] >> 1;
      masks[k] = uint8_t(7 - (slab[0] & 1) - 2 * (slab[1] & 1) - 4 * (slab[2] & 1));
    }
  }

  void writePosition(const CutVertices& vertices, VertexId v, size_t i, Predicates& predicates) {
    const Slab& slab = vertices.slab(v);
    if (planeCount(slab) == 3) return writeCoordinates(slab, i, [](size_t) { return 0; });
    const Point p = vertices.position(v, predicates, onlyGeneral_);
    writeCoordinates(slab, i, [&](size_t d) { return scale_.world(p[d]); });
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
  CutMesh& out_;
};

}  // namespace

void writeVertices(const MeshView& mesh, const CutState& state, const VerticesToWrite& vertices, CutMesh& out, Run& run) {
  const BricksHere& here = state.bricks.here;
  const Numbers& numbers = state.numbers;
  const std::span<const VertexId> surface = vertices.surface;
  VertexWriter writer(mesh, state.surface.input, vertices.kept, run.onlyGeneral, out);
  const std::span<const KeptVertices::Run> runs = vertices.kept.runs;
  std::vector<uint32_t> tasks(Block::count(runs.size()));
  std::iota(tasks.begin(), tasks.end(), 0u);
  runItems(tasks, run.monitor, [&](size_t, uint32_t task) { writer.copyKept(Block::of(runs, task)); });
  tasks.resize(here.size() + Block::count(surface.size()));
  std::iota(tasks.begin(), tasks.end(), here.first.number);
  const uint32_t before = numbers.surfaceVertices + numbers.before.vertices - uint32_t(surface.size());
  std::vector<Predicates> predicates(run.monitor.threads());
  runItems(tasks, run.monitor, [&](size_t thread, uint32_t task) {
    if (!here.has({task})) {
      const size_t block = task - here.past.number;
      return writer.writeOnEdges(state.surface.vertices, Block::of(surface, block), block * Block::kSize, predicates[thread]);
    }
    if (state.kept && state.kept->isInner({task})) return;  // all of them are kept
    const BrickCut& cut = state.cuts[{task}];
    forOwn(cut, &BrickRow::pastVertex, state.seams[{task}].vertices, [&](uint32_t, uint32_t first, uint32_t past) {
      const size_t number = numbers.vertex({task}, cut.lineVertices[first]) - before;
      writer.writeOthers(cut.vertices, cut.lineVertices.subspan(first, past - first), number, predicates[thread]);
    });
  });
  for (const Predicates& p : predicates) run.count(p);
}

}  // namespace mandoline::detail
