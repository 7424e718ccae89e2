#include "cut/brick_triangles.h"

#include "base/key_numbers.h"
#include "base/sort.h"
#include "cut/corner_winding.h"

namespace mandoline::detail {
namespace {

/// The slabs of a triangle's box.
struct SlabBox {
  Slab least, greatest;
};

template <class F>
void forKept(const Input& input, const F& f) {
  for (const TriangleId t : input.triangleIds()) {
    if (!input.kept(t)) continue;
    const auto v = input.verticesOf(t);
    const Slab &a = input.slabs[v[0]], &b = input.slabs[v[1]], &c = input.slabs[v[2]];
    SlabBox box;
    for (size_t d = 0; d < 3; ++d) {
      box.least[d] = std::min({a[d], b[d], c[d]});
      box.greatest[d] = std::max({a[d], b[d], c[d]});
    }
    f(t, box);
  }
}

/// Bricks first .. last along an axis; none if first > last.
struct BrickRange {
  int32_t first, last;
};

/// Calls f(key) for all bricks of a box of them.
template <class F>
void forKeys(const BrickGrid& bricks, const std::array<BrickRange, 3>& box, const F& f) {
  for (int32_t z = box[2].first; z <= box[2].last; ++z) {
    for (int32_t y = box[1].first; y <= box[1].last; ++y) {
      const uint64_t row = uint64_t(z) * uint64_t(bricks.counts[1]) + uint64_t(y);
      for (int32_t x = box[0].first; x <= box[0].last; ++x) f(row * uint64_t(bricks.counts[0]) + uint64_t(x));
    }
  }
}

/// Those with a margin that has a slab from least to greatest.
BrickRange touched(const BrickGrid& bricks, size_t axis, const SlabBox& box) {
  const int32_t last = bricks.cells[axis] - 1;
  if (box.greatest[axis] < 0 || box.least[axis] > 2 * last + 2) return {0, -1};
  const int32_t firstCell = ((box.least[axis] - 1) >> 1) - 1, lastCell = (box.greatest[axis] >> 1) + 1;
  return {std::max(firstCell, 0) >> bricks.shifts[axis], std::min(lastCell, last) >> bricks.shifts[axis]};
}

/// Those with a margin whose lowest plane has a slab from least to greatest. That of brick b is b << shift, less 1 unless the grid begins
/// there.
BrickRange begun(const BrickGrid& bricks, size_t axis, const SlabBox& box) {
  const int32_t least = box.least[axis], greatest = box.greatest[axis];
  if (greatest < 0) return {0, -1};
  const int shift = bricks.shifts[axis];
  const int32_t past = (1 << shift) - 1, last = ((greatest >> 1) + 1) >> shift;
  return {least <= 0 ? 0 : (((least + 1) >> 1) + 1 + past) >> shift, std::min(last, bricks.counts[axis] - 1)};
}

/// Groups what forAll(f) tells, in two rounds, as f(key, triangle).
template <class ForAll>
KeyedTriangles grouped(const ForAll& forAll) {
  KeyNumbers numbers;
  std::vector<uint32_t> counts;
  forAll([&](uint64_t key, TriangleId) {
    const uint32_t number = numbers.add(key);
    if (number == counts.size()) counts.push_back(0);
    ++counts[number];
  });
  std::vector<uint32_t> order(counts.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  sortItems(order, [&](uint32_t a, uint32_t b) { return numbers.keys[a] < numbers.keys[b]; });
  KeyedTriangles result;
  std::vector<size_t> next(counts.size());
  size_t total = 0;
  for (const uint32_t number : order) {
    result.keys.push_back(numbers.keys[number]);
    next[number] = total;
    total += counts[number];
    if (total > UINT32_MAX) throw Failure{{Status::meshTooLarge, -1, -1, "Bricks would share more than 2^32 triangles."}};
    result.triangles.offsets.push_back(uint32_t(total));
  }
  result.triangles.items.resize(total);
  forAll([&](uint64_t key, TriangleId t) { result.triangles.items[next[numbers.add(key)]++] = t.number; });
  return result;
}

}  // namespace

std::span<const uint32_t> KeyedTriangles::operator[](uint64_t key) const {
  const auto found = std::lower_bound(keys.begin(), keys.end(), key);
  if (found == keys.end() || *found != key) return {};
  return triangles[size_t(found - keys.begin())];
}

BrickBox withMargin(const BrickGrid& bricks, uint64_t key) {
  const BrickBox brick = bricks.boxOf(key);
  BrickBox box;
  for (size_t d = 0; d < 3; ++d) {
    box.first[d] = std::max(brick.first[d] - 1, 0);
    box.count[d] = std::min(brick.first[d] + brick.count[d] + 1, bricks.cells[d]) - box.first[d];
  }
  return box;
}

BrickTriangles findBrickTriangles(const Input& input, const BrickGrid& bricks) {
  BrickTriangles result;
  result.near = grouped([&](const auto& f) {
    forKept(input, [&](TriangleId t, const SlabBox& box) {
      forKeys(bricks, {touched(bricks, 0, box), touched(bricks, 1, box), touched(bricks, 2, box)}, [&](uint64_t key) { f(key, t); });
    });
  });
  if (countedOf(*input.mesh).empty()) return result;
  BrickGrid rows = bricks;
  rows.counts[0] = 1;
  result.below = grouped([&](const auto& f) {
    forKept(input, [&](TriangleId t, const SlabBox& box) {
      forKeys(rows, {BrickRange{0, 0}, begun(bricks, 1, box), begun(bricks, 2, box)}, [&](uint64_t row) { f(row, t); });
    });
  });
  return result;
}

std::vector<int32_t> windingAtBrick(const Input& input, const BrickGrid& bricks, const BrickTriangles& triangles, uint64_t key) {
  const BrickBox box = withMargin(bricks, key);
  Point corner;
  for (size_t d = 0; d < 3; ++d) corner[d] = input.planes[d][size_t(box.first[d])];
  Predicates predicates;
  return windingsBeside(corner, *input.mesh, triangles.below[key / uint64_t(bricks.counts[0])], predicates);
}

}  // namespace mandoline::detail
