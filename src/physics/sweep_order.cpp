#include "physics/sweep_order.h"

#include <algorithm>
#include <atomic>

namespace mandoline::physics {

void SweepOrder::setHigher() {
  std::vector<uint32_t> higher;  // per coupling of blocks
  for (uint32_t b = 0; b < lower_.size(); ++b) higher.insert(higher.end(), lower_[b].size(), b);
  higher_ = detail::groupBy<uint32_t>(
      lower_.size(), higher.size(), [&](size_t i) { return size_t(lower_.items[i]); }, [&](size_t i) { return higher[i]; });
}

void SweepOrder::run(const Sides& sides, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const {
  const size_t threads = threadsFor(nodes_, team.size());
  if (threads == 1) return f(0, nodes_);
  constexpr uint32_t kNone = ~uint32_t(0);
  const size_t blocks = lower_.size();
  std::vector<std::atomic<uint32_t>> left(blocks), ready(blocks);  // per block: how many it still waits for; blocks that need not wait
  std::atomic<size_t> made{0}, taken{0};                           // of those
  for (uint32_t b = 0; b < blocks; ++b) left[b] = uint32_t(sides.before[b].size()), ready[b] = kNone;
  for (uint32_t b = 0; b < blocks; ++b) {
    if (left[b] == 0) ready[made++] = b;
  }
  team.run(threads, [&] {
    for (size_t k; (k = taken++) < blocks;) {
      uint32_t b;
      while ((b = ready[k].load(std::memory_order_acquire)) == kNone) detail::yieldThread();
      f(b * kBlock, std::min((b + 1) * kBlock, nodes_));
      for (const uint32_t after : sides.after[b]) {
        if (--left[after] == 0) ready[made++].store(after, std::memory_order_release);
      }
    }
  });
}

}  // namespace mandoline::physics
