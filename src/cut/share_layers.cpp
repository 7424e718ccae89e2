#include "cut/share_layers.h"

namespace mandoline::detail {
namespace {

SlabRange rangeOf(int32_t a, int32_t b, int32_t c) { return {std::min({a, b, c}), std::max({a, b, c})}; }

/// Twice the areas of a triangle seen along the axes, in quarters of a side of a grid cell; beyond the grid it ends at once.
uint64_t areaOf(const Slab& a, const Slab& b, const Slab& c) {
  uint64_t area = 0;
  for (size_t d = 0; d < 3; ++d) {
    const size_t p = (d + 1) % 3, q = (d + 2) % 3;
    area += uint64_t(std::abs(int64_t(b[p] - a[p]) * (c[q] - a[q]) - int64_t(b[q] - a[q]) * (c[p] - a[p])));
  }
  return area;
}

/// Where shares begin among layers, of which `before` has the work before each, and in all. Each gets as near as can be to an even part of
/// what those before it have left.
std::vector<int32_t> divided(const std::vector<uint64_t>& before, uint32_t count) {
  std::vector<int32_t> first{0};
  for (uint32_t share = 0; share + 1 < count; ++share) {
    const uint64_t done = before[size_t(first.back())], target = done + (before.back() - done) / (count - share);
    const auto next = std::lower_bound(before.begin() + first.back(), before.end(), target);
    const bool isNearerBelow = next != before.begin() + first.back() && target - next[-1] < *next - target;
    first.push_back(int32_t(next - before.begin()) - isNearerBelow);
  }
  first.push_back(int32_t(before.size()) - 1);
  return first;
}

}  // namespace

SlabRange slabsOf(const Input& input, TriangleId t, size_t axis) {
  const auto v = input.verticesOf(t);
  return rangeOf(input.slabs[v[0]][axis], input.slabs[v[1]][axis], input.slabs[v[2]][axis]);
}

LayerWork::LayerWork(const Input& input) : cells_{input.cells(0), input.cells(1), input.cells(2)}, changes_(size_t(cells_[2]) + 1, 0) {}

void LayerWork::add(const Slab& a, const Slab& b, const Slab& c) {
  uint64_t crossed = 0;  // planes
  SlabRange range{};     // along z at last
  for (size_t d = 0; d < 3; ++d) {
    range = rangeOf(a[d], b[d], c[d]);
    if (range.greatest < 0 || range.least > 2 * cells_[d]) return;
    crossed += uint64_t(range.greatest - range.least) / 2;
  }
  const int32_t layers = cells_[2];
  const int32_t first = std::clamp(range.least >> 1, 0, layers - 1), last = std::clamp((range.greatest - 1) >> 1, first, layers - 1);
  // A face of the triangle's own in each cell, and three more of the cell; a cell has an area of 8 such quarters.
  constexpr uint64_t kMost = uint64_t(1) << 31;  // so that sums of all stay within 64 bits
  const int64_t each = int64_t(std::min(kMost, (8 * (1 + crossed) + 4 * areaOf(a, b, c)) / uint64_t(last - first + 1)));
  changes_[size_t(first)] += each;
  changes_[size_t(last) + 1] -= each;
}

std::vector<uint64_t> LayerWork::perLayer() const {
  std::vector<uint64_t> work;
  int64_t now = 0;
  for (int32_t layer = 0; layer < cells_[2]; ++layer) work.push_back(uint64_t(now += changes_[size_t(layer)]));
  return work;
}

std::vector<uint64_t> workOfLayers(const Input& input) {
  LayerWork work(input);
  for (const TriangleId t : input.triangleIds()) {
    if (!input.kept(t)) continue;
    const auto v = input.verticesOf(t);
    work.add(input.slabs[v[0]], input.slabs[v[1]], input.slabs[v[2]]);
  }
  return work.perLayer();
}

/// Thinner bricks make shares more alike in work, but are more work: about so many percent.
ShareLayers::ShareLayers(const Input& input, const std::vector<uint64_t>& work, uint32_t count) {
  constexpr uint64_t kPercent[] = {125, 110, 103, 101, 100, 100};
  const std::array<int, 3> usual = BrickGrid::shiftsFor(input, count);
  uint64_t least = ~uint64_t(0);
  for (int shift = usual[2]; shift >= 0; --shift) {
    std::vector<uint64_t> before{0};
    for (size_t at = 0; at < work.size(); ++at) {
      if (at % (size_t(1) << shift) == 0) before.push_back(before.back());
      before.back() += work[at];
    }
    const std::vector<int32_t> first = divided(before, count);
    uint64_t most = 0;
    for (uint32_t share = 0; share < count; ++share) most = std::max(most, before[size_t(first[share + 1])] - before[size_t(first[share])]);
    if (most / 100 * kPercent[shift] >= least) continue;
    least = most / 100 * kPercent[shift];
    shifts_ = {usual[0], usual[1], shift};
    first_.clear();
    for (const int32_t layer : first) first_.push_back(std::min(layer << shift, input.cells(2)));
  }
}

bool isInLayers(const Input& input, TriangleId t, const CellLayers& layers) {
  const auto [least, greatest] = slabsOf(input, t, 2);
  return layers.first < layers.past && least <= 2 * layers.past && greatest >= 2 * layers.first;
}

void takeSurface(CutState& state) {
  const Input& input = state.surface.input;
  const Prepared& mesh = *input.mesh;
  SurfaceHere& here = state.surface.here;
  here.triangles.assign(mesh.triangles.size(), 0);
  here.edges.assign(mesh.edges.ends.size(), 0);
  for (const TriangleId t : input.triangleIds()) {
    if (!input.kept(t) || !isInLayers(input, t, *state.layersHere)) continue;
    here.triangles[t.number] = 1;
    mesh.edges.forTriangle(t, [&](TriEdgeId e) { here.edges[e.number] = 1; });
  }
}

}  // namespace mandoline::detail
