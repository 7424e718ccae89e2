#include "base/sort.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

namespace mandoline::detail {

namespace {

using IsBefore = FunctionRef<bool(uint32_t, uint32_t)>;

/// Sorts each run of that many numbers, by insertion.
void sortRuns(std::vector<uint32_t>& order, size_t run, IsBefore isBefore) {
  for (size_t begin = 0; begin < order.size(); begin += run) {
    for (size_t i = begin + 1; i < std::min(begin + run, order.size()); ++i) {
      const uint32_t moved = order[i];
      size_t j = i;
      for (; j > begin && isBefore(moved, order[j - 1]); --j) order[j] = order[j - 1];
      order[j] = moved;
    }
  }
}

/// Merges sorted runs of that many numbers in pairs.
void mergeRuns(const std::vector<uint32_t>& order, size_t run, std::vector<uint32_t>& merged, IsBefore isBefore) {
  const auto at = [&](size_t i) { return order.begin() + std::ptrdiff_t(std::min(i, order.size())); };
  auto out = merged.begin();
  for (size_t begin = 0; begin < order.size(); begin += 2 * run) {
    auto a = at(begin), b = at(begin + run);
    const auto pastA = b, pastB = at(begin + 2 * run);
    const bool inOrder = a == pastA || b == pastB || !isBefore(*b, *(pastA - 1));
    while (!inOrder && a != pastA && b != pastB) *out++ = isBefore(*b, *a) ? *b++ : *a++;
    out = std::copy(a, pastA, out);
    out = std::copy(b, pastB, out);
  }
}

}  // namespace

void sortMany(void* items, size_t count, size_t itemSize, FunctionRef<bool(const void*, const void*)> isBefore) {
  constexpr size_t kRun = 8;
  std::byte* const bytes = static_cast<std::byte*>(items);
  const auto comesBefore = [&](uint32_t a, uint32_t b) { return isBefore(bytes + a * itemSize, bytes + b * itemSize); };
  std::vector<uint32_t> order(count), merged(count);
  std::iota(order.begin(), order.end(), 0u);
  sortRuns(order, kRun, comesBefore);
  for (size_t run = kRun; run < count; run *= 2) {
    mergeRuns(order, run, merged, comesBefore);
    order.swap(merged);
  }
  const std::unique_ptr<std::byte[]> sorted(new std::byte[count * itemSize]);
  for (size_t i = 0; i < count; ++i) std::memcpy(sorted.get() + i * itemSize, bytes + order[i] * itemSize, itemSize);
  std::memcpy(items, sorted.get(), count * itemSize);
}

}  // namespace mandoline::detail
