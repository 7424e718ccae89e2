// The stencil and the regions: components of cut-cells and untouched grid cells.
//
// The runs of untouched grid cells are walked here as the format describes them, without the views of cut_mesh.h, which the cutter's side
// uses: a mistake in these would hide itself.
#include <algorithm>

#include "base/disjoint_sets.h"
#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

class StencilCheck {
 public:
  StencilCheck(const Context& context, const TriangleBins& bins) : x_(context), bins_(bins) {}

  Check run() {
    checkPartition();
    checkTouched();
    return stencil_.finish();
  }

 private:
  using Key = std::array<int32_t, 3>;  // of a grid cell

  uint32_t firstCell(size_t group) const { return x_.groups[group][0]; }
  Key keyOf(size_t group) const {
    const int32_t* g = x_.gridCellOf(firstCell(group));
    return {g[0], g[1], g[2]};
  }

  /// Each grid cell either has cut-cells or is in a run.
  void checkPartition() {
    int64_t count = int64_t(x_.groups.count());
    for (size_t r = 0; r < x_.cut.runBegin.size(); ++r) count += x_.cut.runEnd[r] - x_.cut.runBegin[r];
    for (size_t g = 0; g < x_.groups.count(); ++g) {
      const Key k = keyOf(g);
      if (x_.runAt(k[0], k[1], k[2]) >= 0) stencil_.violate("cell", firstCell(g), "lies in a grid cell that is also listed as untouched");
    }
    if (count != x_.cut.grid.cells(0) * x_.cut.grid.cells(1) * x_.cut.grid.cells(2)) {
      stencil_.violate("grid", 0, "has cells that are neither cut nor untouched, or both");
    }
  }

  /// Cut-cells only where the input touches the closed grid cell.
  void checkTouched() {
    for (size_t g = 0; g < x_.groups.count(); ++g) {
      if (!hasSurfaceVertex(g) && !isTouched(keyOf(g)))
        stencil_.violate("cell", firstCell(g), "lies in a grid cell that the surface does not touch");
    }
  }
  bool hasSurfaceVertex(size_t group) const {
    const auto onSurface = [&](uint32_t v) { return x_.cut.vertexParents[2 * size_t(v)] >= 0 || x_.madeIndex(v) >= 0; };
    bool found = false;
    for (const uint32_t c : x_.groups[group]) {
      if (found) break;
      for (const uint32_t h : x_.cut.halfFaces(c)) {
        for (const std::span<const uint32_t> loop : x_.cut.loops(h / 2)) found |= std::any_of(loop.begin(), loop.end(), onSurface);
      }
    }
    return found;
  }
  bool isTouched(const Key& gridCell) const {
    Vec3 low, high;
    for (int d = 0; d < 3; ++d) low[d] = x_.planes()[size_t(d)][gridCell[d]], high[d] = x_.planes()[size_t(d)][gridCell[d] + 1];
    const Vec3 size = x_.inRoundings(high, low), margin{{kTolerance, kTolerance, kTolerance}};
    bool touched = false;
    bins_.forTriangles(low, high, [&](uint32_t t) {
      if (touched) return;
      Polygon polygon;
      for (int i = 0; i < 3; ++i) polygon.push_back(x_.inRoundings(x_.corner(t, i), low));
      clipToBox(polygon, -1 * margin, size + margin);
      touched = !polygon.empty();
    });
    return touched;
  }

  const Context& x_;
  const TriangleBins& bins_;
  Tally stencil_{"stencil"};
};

/// Cut-cells, then runs, joined to components, which have to be the regions.
class ComponentCheck {
 public:
  explicit ComponentCheck(const Context& context)
      : x_(context), cells_(uint32_t(x_.cut.cellCount())), parts_(x_.cut.cellCount() + x_.cut.runBegin.size()) {}

  Check run() {
    joinThroughFaces();
    joinRuns();
    compare();
    return regions_.finish();
  }

 private:
  uint32_t regionOfPart(uint32_t part) const { return part < cells_ ? x_.cut.cellRegion[part] : x_.cut.runRegion[part - cells_]; }

  /// Joins parts that meet in a face that is no piece of a triangle. Estimates may divide there, and nothing else.
  void join(uint32_t part, uint32_t other) {
    const uint32_t region = regionOfPart(part), beyond = regionOfPart(other);
    if (x_.cut.regionInsideness.empty() || region == beyond) return parts_.unite(part, other);
    const auto differ = [&](const auto& numbers) { return !numbers.empty() && numbers[region] != numbers[beyond]; };
    if (differ(x_.cut.regionPartWinding) || differ(x_.cut.regionParity)) {
      regions_.violate("region", region, "has another winding number or parity than one that no triangle divides it from");
    }
    if (!differ(x_.cut.regionInsideness))
      regions_.violate("region", region, "has the same insideness as one that no triangle divides it from");
  }

  void joinThroughFaces() {
    for (size_t f = 0; f < x_.cut.faceCount(); ++f) {
      if (x_.cut.faceTriangle[f] >= 0) continue;
      const int32_t below = x_.owner[2 * f], above = x_.owner[2 * f + 1];
      if (below >= 0 && above >= 0) {
        join(uint32_t(below), uint32_t(above));
      } else if (below >= 0) {
        joinAcross(f, below, 1);
      } else if (above >= 0) {
        joinAcross(f, above, -1);
      }
    }
  }
  /// With the untouched grid cell one step along the face's axis, if there is one.
  void joinAcross(size_t face, int32_t cell, int step) {
    const int axis = x_.cut.faceAxis[face];
    const int32_t* g = x_.gridCellOf(size_t(cell));
    std::array<int64_t, 3> next{g[0], g[1], g[2]};
    next[size_t(axis)] += step;
    if (next[size_t(axis)] < 0 || next[size_t(axis)] >= x_.cut.grid.cells(axis)) return;
    const int64_t run = x_.runAt(next[0], next[1], next[2]);
    if (run >= 0) join(uint32_t(cell), cells_ + uint32_t(run));
  }

  void joinRuns() {
    const int64_t ny = x_.cut.grid.cells(1), nz = x_.cut.grid.cells(2);
    for (int64_t k = 0; k < nz; ++k) {
      for (int64_t j = 0; j < ny; ++j) {
        const int64_t row = k * ny + j;
        for (uint32_t r = x_.cut.rowRunOffsets[row]; r + 1 < x_.cut.rowRunOffsets[row + 1]; ++r) {
          if (x_.cut.runEnd[r] == x_.cut.runBegin[r + 1]) join(cells_ + r, cells_ + r + 1);
        }
        if (j + 1 < ny) joinRows(row, row + 1);
        if (k + 1 < nz) joinRows(row, row + ny);
      }
    }
  }
  void joinRows(int64_t row, int64_t other) {
    uint32_t r = x_.cut.rowRunOffsets[row], s = x_.cut.rowRunOffsets[other];
    while (r < x_.cut.rowRunOffsets[row + 1] && s < x_.cut.rowRunOffsets[other + 1]) {
      if (std::max(x_.cut.runBegin[r], x_.cut.runBegin[s]) < std::min(x_.cut.runEnd[r], x_.cut.runEnd[s])) join(cells_ + r, cells_ + s);
      ++(x_.cut.runEnd[r] < x_.cut.runEnd[s] ? r : s);
    }
  }

  void compare() {
    const uint32_t count = cells_ + uint32_t(x_.cut.runBegin.size());
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> regionOf(count, kNone), rootOf(x_.cut.regionCount, kNone);
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t root = parts_.find(i), region = regionOfPart(i);
      const char* kind = i < cells_ ? "cell" : "run";
      const uint32_t element = i < cells_ ? i : i - cells_;
      if (regionOf[root] == kNone) regionOf[root] = region;
      if (rootOf[region] == kNone) rootOf[region] = root;
      if (regionOf[root] != region) {
        regions_.violate(kind, element, "is connected to another region than its own");
      } else if (rootOf[region] != root) {
        regions_.violate(kind, element, "is not connected to the rest of its region");
      }
    }
    for (uint32_t r = 0; r < rootOf.size(); ++r) {
      if (rootOf[r] == kNone) regions_.violate("region", r, "is empty");
    }
  }

  const Context& x_;
  const uint32_t cells_;
  detail::DisjointSets parts_;
  Tally regions_{"regions"};
};

}  // namespace

RegionChecks checkRegions(const Context& context, const TriangleBins& bins) {
  return {StencilCheck(context, bins).run(), ComponentCheck(context).run()};
}

}  // namespace mandoline::validation
