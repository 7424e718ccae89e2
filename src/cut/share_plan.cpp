#include "cut/share_plan.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/double_double.h"
#include "cut/driver.h"
#include "cut/share_counts.h"
#include "mesh/run_call.h"

namespace mandoline::detail {

namespace {

uint64_t bytesOfPrepared(const Prepared& mesh) {
  uint64_t bytes = bytesOf(mesh.points, mesh.triangles, mesh.states, mesh.parts.kinds);
  if (mesh.edges.unpaired) bytes += bytesOf(*mesh.edges.unpaired);
  return bytes + bytesOf(mesh.edges.ends, mesh.edges.sideEdges, mesh.edges.lines, mesh.edges.stitched.items, mesh.edges.inner.items);
}

}  // namespace

/// How much of a surface reaches into layers.
class Reach {
 public:
  explicit Reach(const Input& input) {
    begun_.resize(2 * size_t(input.cells(2)) + 4, 0);
    ended_ = begun_;
    for (const TriangleId t : input.triangleIds()) {
      if (!input.kept(t)) continue;
      const auto [least, greatest] = slabsOf(input, t, 2);
      ++begun_[size_t(least + 2)];
      ++ended_[size_t(greatest + 2)];
    }
    for (std::vector<uint64_t>* counts : {&begun_, &ended_}) std::partial_sum(counts->begin(), counts->end(), counts->begin());
  }

  /// The fraction of the triangles.
  double of(const CellLayers& layers) const {
    if (layers.first == layers.past || begun_.back() == 0) return 0;
    return double(between(2 * layers.first, 2 * layers.past)) / double(begun_.back());
  }
  /// The fraction that is prepared for layers: the lowest and the highest ones have what lies outside of the grid, too.
  double prepared(const CellLayers& layers) const {
    if (layers.first == layers.past || begun_.back() == 0) return 0;
    const int32_t last = int32_t(begun_.size()) - 3;  // above the grid
    const int32_t least = layers.first == 0 ? -1 : 2 * layers.first, greatest = 2 * layers.past + 1 == last ? last : 2 * layers.past;
    return double(between(least, greatest)) / double(begun_.back());
  }
  /// How many triangles reach to a plane.
  uint64_t to(int32_t plane) const { return between(2 * plane, 2 * plane); }

 private:
  uint64_t between(int32_t least, int32_t greatest) const { return begun_[size_t(greatest + 2)] - ended_[size_t(least + 1)]; }

  std::vector<uint64_t> begun_, ended_;  // at which slabs from -2 on, or before
};

namespace {

// Per triangle, as measured: beside the prepared mesh in the process that inspects the mesh meanwhile and in others; and of what has been
// freed when a piece is measured.
constexpr uint64_t kInspectingBytes = 68, kPreparingBytes = 48, kFreedBytes = 20;

constexpr uint64_t kSeamFaceBytes = 235;  // of a message: a face in a plane, with its share of the vertices there

constexpr uint64_t kMadeBytes = 24;  // of a message

uint64_t facesOf(const BrickCounts& counts) { return uint64_t(counts.triFaces) + counts.pieces; }

/// What a process has of its layers while it writes its part of the output, and while it makes the piece of that or measures the piece.
struct LayerMemory {
  uint64_t writing, measuring;
};
LayerMemory memoryOf(const BricksLoad& load) {
  const BrickCounts& n = load.counts;
  const uint64_t cells = n.cells, faces = facesOf(n), vertices = n.vertices + load.surfaceVertices;
  const uint64_t loops = uint64_t(n.triLoops) + n.loops, loopVertices = uint64_t(n.triLoopVertices) + n.loopVertices;
  const uint64_t output = 4 * n.halfFaces + 20 * cells + 17 * faces + 4 * (loops + loopVertices) + 5 * n.parents + 49 * vertices;
  const uint64_t ids = 8 * cells + 12 * (faces + vertices), numbers = 4 * (faces + vertices);
  const uint64_t measures = 32 * cells + 56 * faces + 48 * vertices;
  return {load.brickBytes + numbers + output, output + ids + std::max(output, measures)};
}

/// Whether processes that have such a mesh each prepare only what they cut: see mesh_band.h.
bool isPreparedInShares(const Prepared& mesh) {
  if (mesh.counts.zeroAreaTriangles + mesh.counts.flushedCoordinates > 0 || !mesh.duplicates.empty() || mesh.hasIntersections())
    return false;
  if (mesh.closed) return true;
  std::vector<uint8_t> uses(mesh.edges.ends.size(), 0);
  bool haveAtMostTwo = true;
  for (const TriangleId t : mesh.triangleIds()) mesh.edges.forTriangle(t, [&](TriEdgeId e) { haveAtMostTwo &= uses[e.number]++ < 2; });
  return haveAtMostTwo;
}

}  // namespace

struct SharePlanner::Data {
  Data(PreparedMesh mesh_, Grid grid_, const RunOptions& options) : mesh(std::move(mesh_), grid_, options), grid(std::move(grid_)) {
    CutStats stats;
    Monitor monitor(options, kGridStages);
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    CutState state;
    beginCut(mesh.prepared(), grid, state, clock, run);
    input = std::move(state.surface.input);
    work = workOfLayers(input);
    reach.emplace(input);
    isInShares = !mesh.isPreparedAgain() && isPreparedInShares(mesh.prepared());
  }

  std::vector<ShareLoad> loads(uint32_t ranks, const RunOptions& options, uint64_t windowWork) {
    const ShareLayers shares(input, work, ranks);
    const BricksLoads all = countShares(input, {shares, ranks, work}, windowWork, options);
    const std::vector<BricksLoad>& sums = all.ofRanks;
    uint64_t summaries = 0;
    for (const BricksLoad& sum : sums) summaries += sum.summaryBytes + sum.toldBytes;
    std::vector<ShareLoad> loads(ranks);
    uint64_t seamBelow = 0;
    for (uint32_t rank = 0; rank < ranks; ++rank) {
      const BricksLoad& sum = sums[rank];
      const bool hasLayers = shares.first(rank) < shares.first(rank + 1);
      ShareLoad& load = loads[rank];
      load.work = std::accumulate(work.begin() + shares.first(rank), work.begin() + shares.first(rank + 1), uint64_t(0));
      load.cutCells = sum.counts.cells;
      load.faces = facesOf(sum.counts);
      load.seamFaces = hasLayers ? seamBelow + sum.seamFacesAbove : 0;
      if (ranks > 1) load.sliceBytes = sliceSent(ranks);
      if (ranks > 1) load.bytesSent = sentBy(rank, ranks, sum, hasLayers ? seamBelow : 0, all) + sentPreparing(ranks, shares.of(rank));
      load.memoryBytes = std::max(memoryPreparing(rank, ranks, shares.of(rank)), memoryOf(ranks, shares.of(rank), sum, all, summaries));
      if (hasLayers) seamBelow = sum.seamFacesAbove;
    }
    return loads;
  }

  uint64_t bytesOfView() const { return bytesOf(mesh.view().positions, mesh.view().triangles); }
  uint64_t memoryPreparing(uint32_t rank, uint32_t ranks, const CellLayers& layers) const {
    constexpr uint64_t kVertexBytes = 1;  // of all vertices: how many crossings begin there
    const bool isShare = isInShares && ranks > 1;
    const uint64_t each = rank == 0 && !isShare ? kInspectingBytes : kPreparingBytes;
    const uint64_t whole = bytesOfPrepared(mesh.prepared()) + each * mesh.view().triangleCount();
    if (!isShare) return bytesOfView() + whole;
    // The slice, with its triangles' vertices, and what is sent; then what comes from others.
    const uint64_t slice = 3 * bytesOfView() / ranks, known = kVertexBytes * mesh.view().vertexCount();
    return known + std::max(slice, uint64_t(reach->prepared(layers) * double(whole + bytesOfView())));
  }
  /// Once the output is written, a process has its part, and what it keeps of the user's mesh.
  uint64_t memoryOf(uint32_t ranks, const CellLayers& layers, const BricksLoad& sum, const BricksLoads& all, uint64_t summaries) const {
    const uint64_t made = bytesOfPrepared(mesh.prepared()) + bytesOf(input.slabs) + all.surfaceBytes;
    const uint64_t excerpt = ranks == 1 ? made : uint64_t(reach->of(layers) * double(made));
    const auto [writing, measuring] = detail::memoryOf(sum);
    const uint64_t cutting = excerpt + all.seamBytes + summaries + writing, freed = kFreedBytes * mesh.view().triangleCount();
    const uint64_t view = ranks == 1 ? bytesOfView() : uint64_t(reach->of(layers) * double(bytesOfView()));
    return view + std::max(cutting, measuring + freed);
  }

  uint64_t sentBy(uint32_t rank, uint32_t ranks, const BricksLoad& sum, uint64_t seamBelow, const BricksLoads& all) const {
    const uint64_t others = ranks - 1, numbers = 11 * sizeof(uint64_t) * ranks, sums = all.regions * sizeof(DoubleDouble);
    uint64_t bytes = others * sum.summaryBytes + numbers + mesh.view().triangleCount() / 8;
    bytes += 2 * sums * (rank + 1 < ranks ? 1 : others);
    bytes += others * kMadeBytes * sum.made;
    return bytes + kSeamFaceBytes * sum.facesAbove + 2 * sizeof(uint64_t) * seamBelow;
  }

  /// Each process gives the triangles of its slice to those who cut them, and of meshes that are prepared as a whole the slice to all.
  uint64_t sliceSent(uint32_t ranks) const {
    constexpr uint64_t kTriangleBytes = 16, kVertexBytes = 64;  // as measured: vertices are asked for, and in several parts
    const uint64_t slice = (kTriangleBytes * mesh.view().triangleCount() + kVertexBytes * mesh.view().vertexCount()) / ranks;
    return slice * (ranks - 1) / ranks + (isInShares ? 0 : bytesOfView() * (ranks - 1) / ranks);
  }

  /// Which vertices are referenced; how many crossings each begins, and of meshes with parts which triangles are of which; the sets of
  /// triangles, those that others have, too, and the open tri-edges.
  uint64_t sentPreparing(uint32_t ranks, const CellLayers& layers) const {
    const Prepared& prepared = mesh.prepared();
    uint64_t bytes = mesh.view().vertexCount() / 8;
    if (!isInShares) return bytes;
    bytes += mesh.view().vertexCount() + work.size() * sizeof(uint64_t);
    if (prepared.closed) return bytes;
    const PartCounts& parts = prepared.parts.counts;
    bytes += uint64_t((parts.parity > 0) + (parts.open > 0)) * mesh.view().triangleCount() / 8;
    if (layers.first == layers.past) return bytes;
    uint64_t shared = 0;
    for (const int32_t plane : {layers.first, layers.past}) shared += plane > 0 && plane < input.cells(2) ? reach->to(plane) : 0;
    const uint64_t told = uint64_t(parts.winding) + parts.parity + parts.open + parts.openEdges;  // sets of triangles, and edges
    return bytes + (ranks - 1) * 2 * sizeof(uint32_t) * (shared + uint64_t(reach->prepared(layers) * double(told)));
  }

  PreparedForGrid mesh;
  Grid grid;
  Input input;
  bool isInShares = false;     // prepared so by several processes
  std::vector<uint64_t> work;  // of layers of grid cells
  std::optional<Reach> reach;
};

SharePlanner::SharePlanner(PreparedMesh mesh, Grid grid, const RunOptions& options) {
  runCall("cut", [&] { data_ = std::make_shared<Data>(std::move(mesh), std::move(grid), options); });
}

std::vector<ShareLoad> SharePlanner::loads(uint32_t ranks, const RunOptions& options, uint64_t windowWork) {
  return runCall("cut", [&] { return data_->loads(ranks, options, windowWork); });
}

}  // namespace mandoline::detail
