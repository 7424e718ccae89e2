#include "cut/share_layers.h"

namespace mandoline::detail {
namespace {

SlabRange rangeOf(int32_t a, int32_t b, int32_t c) { return {std::min(a, std::min(b, c)), std::max(a, std::max(b, c))}; }

/// Twice the areas of a triangle seen along the axes, in quarters of a side of a grid cell; beyond the grid it ends at once.
uint64_t areaOf(const Slab& a, const Slab& b, const Slab& c) {
  uint64_t area = 0;
  for (size_t d = 0; d < 3; ++d) {
    const size_t p = (d + 1) % 3, q = (d + 2) % 3;
    area += uint64_t(std::abs(int64_t(b[p] - a[p]) * (c[q] - a[q]) - int64_t(b[q] - a[q]) * (c[p] - a[p])));
  }
  return area;
}

/// How much others have in the inside of a triangle, if they reach into it.
std::optional<size_t> innerOf(const Prepared& mesh, TriangleId t) {
  if (!mesh.hasIntersections()) return {};
  const Arrangement& arrangement = *mesh.arrangement;
  if (!arrangement.isReachedInto(t.number)) return {};
  return arrangement.innerVertices[t.number].size() + arrangement.innerEdges[t.number].size();
}

/// Divides layers among shares. `before`: the work before each layer, and in all.
class Division {
 public:
  Division(const std::vector<uint64_t>& before, uint32_t count) : before_(before), count_(count), most_(leastMost()) {}

  /// Where shares begin, and the last ends: each border as near as can be to an even part of the work, where no share has more than the
  /// busiest has to.
  std::vector<size_t> borders() const {
    std::vector<size_t> earliest(count_ + 1);
    earliest[count_] = layers();
    for (uint32_t share = count_; share-- > 0;) earliest[share] = firstBefore(earliest[share + 1]);
    std::vector<size_t> borders{0};
    for (uint32_t share = 1; share < count_; ++share) {
      const size_t least = std::max(borders.back(), earliest[share]);
      borders.push_back(std::clamp(nearest(evenPart(share)), least, lastAfter(borders.back(), most_)));
    }
    borders.push_back(layers());
    return borders;
  }

 private:
  size_t layers() const { return before_.size() - 1; }

  /// The least work with which the busiest share can do.
  uint64_t leastMost() const {
    uint64_t least = 0, enough = before_.back();
    while (least < enough) {
      const uint64_t most = least + (enough - least) / 2;
      if (isEnough(most))
        enough = most;
      else
        least = most + 1;
    }
    return enough;
  }
  bool isEnough(uint64_t most) const {
    size_t at = 0;
    for (uint32_t share = 0; share < count_ && at < layers(); ++share) {
      const size_t next = lastAfter(at, most);
      if (next == at) return false;
      at = next;
    }
    return at == layers();
  }
  /// Up to where a share can go that begins at a layer.
  size_t lastAfter(size_t first, uint64_t most) const {
    return size_t(std::upper_bound(before_.begin() + ptrdiff_t(first), before_.end(), before_[first] + most) - before_.begin()) - 1;
  }
  /// Where one can begin that ends at a layer.
  size_t firstBefore(size_t past) const {
    const uint64_t least = before_[past] - std::min(before_[past], most_);
    return size_t(std::lower_bound(before_.begin(), before_.end(), least) - before_.begin());
  }
  /// How much work so many shares have where all have the same.
  uint64_t evenPart(uint64_t shares) const { return before_.back() / count_ * shares + before_.back() % count_ * shares / count_; }
  size_t nearest(uint64_t work) const {
    const auto at = std::lower_bound(before_.begin(), before_.end(), work);
    const bool isNearerBelow = at != before_.begin() && work - at[-1] < *at - work;
    return size_t(at - before_.begin()) - size_t(isNearerBelow);
  }

  const std::vector<uint64_t>& before_;
  const uint32_t count_;
  const uint64_t most_;
};

}  // namespace

SlabRange slabsOf(const Input& input, TriangleId t, size_t axis) {
  const auto v = input.verticesOf(t);
  return rangeOf(input.slabs[v[0]][axis], input.slabs[v[1]][axis], input.slabs[v[2]][axis]);
}

LayerWork::LayerWork(const Input& input) : cells_{input.cells(0), input.cells(1), input.cells(2)}, changes_(size_t(cells_[2]) + 1, 0) {}

void LayerWork::add(const Slab& a, const Slab& b, const Slab& c, std::optional<size_t> inner) {
  uint64_t crossed = 0;  // planes
  SlabRange range{};     // along z at last
  for (size_t d = 0; d < 3; ++d) {
    range = rangeOf(a[d], b[d], c[d]);
    if (range.greatest < 0 || range.least > 2 * cells_[d]) return;
    crossed += uint64_t(range.greatest - range.least) / 2;
  }
  const int32_t layers = cells_[2];
  const int32_t first = std::clamp(range.least >> 1, 0, layers - 1), last = std::clamp((range.greatest - 1) >> 1, first, layers - 1);
  // A face of the triangle's own in each cell, and what five more are of the cell; a cell has an area of 8 such quarters. As measured, a
  // triangle that others reach into is as much work as several, as is each thing in its inside.
  constexpr uint64_t kFace = 8, kArea = 6, kReached = 6, kInner = 16 * kFace;
  constexpr uint64_t kMost = uint64_t(1) << 31;  // so that sums of all stay within 64 bits
  const uint64_t own = kFace * (1 + crossed) + kArea * areaOf(a, b, c);
  const uint64_t work = inner ? kReached * own + kInner * *inner : own;
  const int64_t each = int64_t(std::min(kMost, first == last ? work : work / uint64_t(last - first + 1)));
  changes_[size_t(first)] += each;
  changes_[size_t(last) + 1] -= each;
}

std::vector<uint64_t> LayerWork::perLayer() const {
  std::vector<uint64_t> work;
  int64_t now = 0;
  for (int32_t layer = 0; layer < cells_[2]; ++layer) work.push_back(uint64_t(now += changes_[size_t(layer)]));
  return work;
}

std::vector<uint64_t> workOfLayers(const Input& input, uint32_t every) {
  LayerWork work(input);
  const size_t triangles = input.mesh->triangles.size();
  for (size_t i = 0; i < triangles; i += every) {
    const TriangleId t{uint32_t(i)};
    if (!input.kept(t)) continue;
    const auto v = input.verticesOf(t);
    work.add(input.slabs[v[0]], input.slabs[v[1]], input.slabs[v[2]], innerOf(*input.mesh, t));
  }
  return work.perLayer();
}

ShareLayers::ShareLayers(const Input& input, const std::vector<uint64_t>& work, uint32_t count)
    : shifts_(BrickGrid::shiftsFor(input, count)) {
  std::vector<uint64_t> before{0};
  for (const uint64_t ofLayer : work) before.push_back(before.back() + ofLayer);
  for (const size_t border : Division(before, count).borders()) first_.push_back(int32_t(border));
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
