#include "cut/share_counts.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "cut/share_summary.h"

namespace mandoline::detail {
namespace {

/// Layers of grid cells, those of whole bricks.
struct Window {
  CellLayers counted, cut;
};

std::vector<Window> windowsOf(const BrickGrid& grid, const std::vector<uint64_t>& work, uint64_t windowWork) {
  constexpr size_t kLeastLayers = 8;  // of bricks: two more are cut for each window
  std::vector<int32_t> planes{0};     // between layers of bricks
  while (planes.back() < grid.cells[2]) planes.push_back(grid.planeFrom(2, planes.back() + 1));
  const size_t last = planes.size() - 1;
  std::vector<Window> windows;
  for (size_t first = 0; first < last;) {
    size_t past = first;
    for (uint64_t sum = 0; past < last && (sum < windowWork || past - first < kLeastLayers); ++past) {
      for (int32_t layer = planes[past]; layer < planes[past + 1]; ++layer) sum += work[size_t(layer)];
    }
    windows.push_back({{planes[first], planes[past]}, {planes[first - std::min<size_t>(first, 1)], planes[std::min(past + 1, last)]}});
    first = past;
  }
  return windows;
}

bool isIn(const CellLayers& layers, int32_t layer) { return layer >= layers.first && layer < layers.past; }

/// Counts regions of all windows, one after the other.
class RegionCounter {
 public:
  /// So many more, those of a window. `below` and `above`: of all that has one in the layers that the window before and the next one have
  /// cut, too; in the order in which these tell it.
  void add(uint32_t regions, const std::vector<uint32_t>& below, const std::vector<uint32_t>& above) {
    constexpr uint32_t kNone = ~0u;
    DisjointSets sets(before_ + regions);
    count_ += regions;
    for (size_t i = 0; i < below.size(); ++i) {
      const uint32_t a = sets.find(open_[i]), b = sets.find(before_ + below[i]);
      if (a == b) continue;
      sets.unite(a, b);
      --count_;
    }
    std::vector<uint32_t> numbers(sets.size(), kNone);  // of those that may go on
    open_.clear();
    uint32_t next = 0;
    for (const uint32_t region : above) {
      uint32_t& number = numbers[sets.find(before_ + region)];
      if (number == kNone) number = next++;
      open_.push_back(number);
    }
    before_ = next;
  }
  uint64_t count() const { return count_; }

 private:
  std::vector<uint32_t> open_;  // as `above` of the last window
  uint32_t before_ = 0;         // how many these are
  uint64_t count_ = 0;
};

/// The process that has each layer of grid cells.
std::vector<uint32_t> ranksOf(const ShareLayers& shares, uint32_t count) {
  std::vector<uint32_t> ranks;
  for (uint32_t rank = 0; rank < count; ++rank) ranks.resize(size_t(shares.of(rank).past), rank);
  return ranks;
}

uint64_t bytesOfBrick(BrickCut& cut) {
  uint64_t bytes = bytesOf(cut.vertices.slabs, cut.vertices.parentTriangles);
  cut.forArrays([&](const auto& array, auto) { bytes += array.size() * sizeof(*array.begin()); });
  return bytes;
}

uint64_t bytesOfSeams(const BrickSeams& brick) {
  uint64_t bytes = 2 * bytesOf(brick.rows) + bytesOf(brick.joins);  // of the rows also where their numbers begin
  for (const SeamRanges* seams : {&brick.triFaces, &brick.pieces, &brick.halves, &brick.vertices})
    bytes += bytesOf(seams->own, seams->others);
  return bytes;
}

class ShareCounter {
 public:
  ShareCounter(const Input& input, const SharesToCount& shares) : shares_(shares), rankOf_(ranksOf(shares.layers, shares.count)) {
    state_.surface.input = input;
    state_.brickShifts = shares.layers.shifts();
    state_.shareBorders = shares.layers.borders();
    all_.ofRanks.resize(shares.count);
  }

  BricksLoads run(uint64_t windowWork, const RunOptions& options) {
    const BrickGrid grid(state_.surface.input, *state_.brickShifts, state_.shareBorders);
    const std::vector<Window> windows = windowsOf(grid, shares_.work, windowWork);
    const int count = int(windows.size());
    Monitor all(options, count * kGridStages);
    for (int w = 0; w < count; ++w) {
      const RunOptions part = all.part<RunOptions>(w * kGridStages, (count - 1 - w) * kGridStages);
      CutStats stats;
      Monitor monitor(part, kGridStages);
      Clock clock(stats, monitor);
      Run run{stats, monitor};
      if (w == 0) {
        clock.begin("triEdges");
        cutTriEdges(state_.surface, run, nullptr);
        isUsed_.assign(state_.surface.vertices.firstInTriangle.number, 0);
      }
      cutWindow(windows[size_t(w)].cut, clock, run);
      add(windows[size_t(w)].counted);
      const CellLayers &cut = windows[size_t(w)].cut, none{cut.first, cut.first};
      regions_.add(state_.regions.count, regionsIn(w > 0 ? CellLayers{cut.first, windows[size_t(w - 1)].cut.past} : none),
                   regionsIn(w + 1 < count ? CellLayers{windows[size_t(w + 1)].cut.first, cut.past} : none));
      freeWindow();
    }
    finish();
    return std::move(all_);
  }

 private:
  void cutWindow(const CellLayers& layers, Clock& clock, Run& run) {
    state_.layersHere = layers;
    takeSurface(state_);
    state_.surface.here.edges.clear();  // all are cut
    cutBricksHere(state_, clock, run);
    clock.begin("regions");
    join(layers, run);
  }

  /// As joinBricks() does, as if nothing were beyond the layers.
  void join(const CellLayers& layers, Run& run) {
    const Input& input = state_.surface.input;
    UntouchedRuns& runs = state_.runs;
    // With a layer on either side: seams look there, too, and all is untouched.
    const CellLayers more{std::max(layers.first - 1, 0), std::min(layers.past + 1, input.cells(2))};
    runs = findUntouchedRuns(input, state_.bricks, more, run.monitor);
    findSeams(state_.cut(), nullptr, state_.seams, run);
    const uint32_t begin = runs.rowOffsets[size_t(layers.first) * runs.ny], end = runs.rowOffsets[size_t(layers.past) * runs.ny];
    for (uint32_t& offset : runs.rowOffsets) offset = std::clamp(offset, begin, end);  // other runs are in no row any more
    for (BrickSeams& seams : state_.seams) {
      const auto isBeyond = [&](const SeamJoin& join) { return !isIn(layers, join.cell[2] >> 1); };
      seams.joins.erase(std::remove_if(seams.joins.begin(), seams.joins.end(), isBeyond), seams.joins.end());
    }
    state_.regions = findRegions(state_.cut());
  }

  /// Leaves the crossings of tri-edges.
  void freeWindow() {
    CutVertices& vertices = state_.surface.vertices;
    vertices.slabs.resize(vertices.firstInTriangle.number);
    vertices.parentTriangles.clear();
    state_.cuts = {};
    state_.seams = {};
    state_.regions = {};
  }

  void add(const CellLayers& layers) {
    const Bricks& bricks = state_.bricks;
    for (const BrickId b : bricks.ids()) {
      if (isIn(layers, bricks.boxes[b].first[2])) addBrick(b);
    }
    const UntouchedRuns& runs = state_.runs;
    const size_t ny = runs.ny;
    const uint64_t count = runs.rowOffsets[size_t(layers.past) * ny] - runs.rowOffsets[size_t(layers.first) * ny];
    all_.seamBytes += count * (sizeof runs.begin[0] + sizeof runs.end[0] + sizeof state_.regions.runRegion[0]);
    for (size_t v = 0; v < isUsed_.size(); ++v) isUsed_[v] |= state_.used[v].load(std::memory_order_relaxed);
    const CutVertices& vertices = state_.surface.vertices;
    for (VertexId v = vertices.firstInTriangle; v.number < vertices.size(); ++v.number) {
      if (isIn(layers, layerOf(v))) all_.surfaceBytes += sizeof(Slab);
    }
  }

  void addBrick(BrickId b) {
    const BrickBox& box = state_.bricks.boxes[b];
    const uint32_t rank = rankOf_[size_t(box.first[2])], above = uint32_t(cellFace(2, 1));
    BricksLoad& load = all_.ofRanks[rank];
    const BrickSeams& brick = state_.seams[b];
    BrickCut& cut = state_.cuts[b];
    for (const BrickCounts& row : brick.rows) load.counts.add(row);
    all_.seamBytes += bytesOfSeams(brick);
    load.summaryBytes += summaryBytes(state_, b);
    load.toldBytes += bytesOf(cut.rows, cut.boundaryFaces, cut.boundaryHalves, cut.boundaryLines, cut.openFaces, cut.steps);
    load.brickBytes += bytesOfBrick(cut);
    if (box.first[2] + box.count[2] < shares_.layers.of(rank).past) return;
    for (const BoundaryFace& face : cut.boundaryFaces) {
      if (face.index == above) load.facesAbove += face.triFaces.count + face.pieces.count;
    }
    for (const SeamRanges* seams : {&brick.triFaces, &brick.pieces}) {
      for (const SeamRange& own : seams->own) {
        if (own.key % 32 == above) load.seamFacesAbove += own.range.count;
      }
    }
  }

  /// Of the components of bricks and the runs in layers.
  std::vector<uint32_t> regionsIn(const CellLayers& layers) const {
    std::vector<uint32_t> regions;
    for (const BrickId b : state_.bricks.ids()) {
      const std::vector<uint32_t>& of = state_.regions.ofComponents[b];
      if (isIn(layers, state_.bricks.boxes[b].first[2])) regions.insert(regions.end(), of.begin(), of.end());
    }
    const auto runOf = [&](int32_t layer) {
      return state_.regions.runRegion.begin() + ptrdiff_t(state_.runs.rowOffsets[size_t(layer) * state_.runs.ny]);
    };
    regions.insert(regions.end(), runOf(layers.first), runOf(layers.past));
    return regions;
  }

  void finish() {
    const CutVertices& vertices = state_.surface.vertices;
    all_.seamBytes += bytesOf(state_.runs.rowOffsets);
    all_.surfaceBytes += bytesOf(vertices.slabs, vertices.parentEdges, vertices.crossingOffsets, isUsed_);
    all_.regions = regions_.count();
    for (VertexId v{0}; v.number < isUsed_.size(); ++v.number) {
      if (!isUsed_[v.number]) continue;
      BricksLoad& load = all_.ofRanks[rankOf_[size_t(layerOf(v))]];
      ++load.surfaceVertices;
      load.made += vertices.isImplicit(v);
    }
    addUsed();
  }

  /// Which vertices of the surface loops have, as summaries tell it.
  void addUsed() {
    constexpr uint64_t kWordBytes = 5;
    std::vector<uint32_t> last(shares_.count, ~0u);
    const auto add = [&](int32_t layer, uint32_t word) {
      const uint32_t rank = rankOf_[size_t(layer)];
      if (std::exchange(last[rank], word) != word) all_.ofRanks[rank].summaryBytes += kWordBytes;
    };
    for (VertexId v{0}; v.number < isUsed_.size(); ++v.number) {
      if (!isUsed_[v.number]) continue;
      const int32_t z = state_.surface.vertices.slab(v)[2];
      add(layerOf(v), v.number / 32);
      if (onPlane(z) && z > 0) add((z - 1) >> 1, v.number / 32);
    }
  }

  /// Vertices beyond the grid are in its outermost layers.
  int32_t layerOf(VertexId v) const { return std::clamp(state_.surface.vertices.slab(v)[2] >> 1, 0, state_.surface.input.cells(2) - 1); }

  const SharesToCount shares_;
  const std::vector<uint32_t> rankOf_;
  CutState state_;
  RegionCounter regions_;
  std::vector<uint8_t> isUsed_;  // per vertex of the mesh and its edges
  BricksLoads all_;
};

}  // namespace

BricksLoads countShares(const Input& input, const SharesToCount& shares, uint64_t windowWork, const RunOptions& options) {
  return ShareCounter(input, shares).run(windowWork, options);
}

}  // namespace mandoline::detail
