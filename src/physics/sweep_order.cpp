#include "physics/sweep_order.h"

#include <algorithm>
#include <atomic>

#include "base/threads.h"

namespace mandoline::physics {

void SweepOrder::setOrder() {
  const size_t blocks = lower_.size();
  std::vector<uint32_t> block, depth(blocks);  // per coupling of blocks: the higher one; per block: how many wait for each other before it
  uint32_t depths = 0;
  for (uint32_t b = 0; b < blocks; ++b) {
    for (const uint32_t lower : lower_[b]) {
      block.push_back(b);
      depth[b] = std::max(depth[b], depth[lower] + 1);
    }
    depths = std::max(depths, depth[b] + 1);
  }
  higher_ = detail::groupBy<uint32_t>(
      blocks, block.size(), [&](size_t i) { return size_t(lower_.items[i]); }, [&](size_t i) { return block[i]; });
  order_ = detail::groupBy<uint32_t>(
               depths, blocks, [&](size_t b) { return size_t(depth[b]); }, [](size_t b) { return uint32_t(b); })
               .items;
}

void SweepOrder::run(const detail::Csr<uint32_t>& waitsFor, bool isReversed, unsigned threads,
                     detail::FunctionRef<void(size_t, size_t)> f) const {
  const size_t started = threadsFor(nodes_, threads);
  if (started == 1) return f(0, nodes_);
  const size_t blocks = order_.size();
  std::vector<std::atomic<bool>> isDone(blocks);
  std::atomic<size_t> next{0};
  detail::runOnThreads(started, [&](size_t) {
    for (size_t k; (k = next++) < blocks;) {
      const uint32_t b = order_[isReversed ? blocks - 1 - k : k];
      for (const uint32_t before : waitsFor[b]) {
        while (!isDone[before].load(std::memory_order_acquire)) detail::yieldThread();
      }
      f(b * kBlock, std::min((b + 1) * kBlock, nodes_));
      isDone[b].store(true, std::memory_order_release);
    }
  });
}

}  // namespace mandoline::physics
