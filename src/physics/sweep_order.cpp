#include "physics/sweep_order.h"

#include <algorithm>
#include <atomic>

namespace mandoline::physics {

static constexpr uint32_t kNone = ~uint32_t(0);

/// Each block gets the first colour that none of those has which it is coupled with.
void SweepOrder::setColors(const detail::Csr<uint32_t>& lower) {
  const size_t blocks = lower.size();
  std::vector<uint32_t> colors(blocks), taken;  // `taken`: per colour, the last block that can't have it
  for (uint32_t b = 0; b < blocks; ++b) {
    for (const uint32_t other : lower[b]) taken[colors[other]] = b;
    colors[b] = uint32_t(std::find_if(taken.begin(), taken.end(), [&](uint32_t last) { return last != b; }) - taken.begin());
    if (colors[b] == taken.size()) taken.push_back(kNone);
  }
  const auto block = [](size_t b) { return uint32_t(b); };
  order_ = detail::groupBy<uint32_t>(
               taken.size(), blocks, [&](size_t b) { return size_t(colors[b]); }, block)
               .items;
  place_.resize(blocks);
  for (uint32_t k = 0; k < blocks; ++k) place_[order_[k]] = k;
  struct Coupling {
    uint32_t before, after;
  };
  std::vector<Coupling> couplings;
  for (uint32_t b = 0; b < blocks; ++b) {
    for (const uint32_t other : lower[b]) couplings.push_back(place_[other] < place_[b] ? Coupling{other, b} : Coupling{b, other});
  }
  before_ = detail::groupBy<uint32_t>(
      blocks, couplings.size(), [&](size_t i) { return size_t(couplings[i].after); }, [&](size_t i) { return couplings[i].before; });
  after_ = detail::groupBy<uint32_t>(
      blocks, couplings.size(), [&](size_t i) { return size_t(couplings[i].before); }, [&](size_t i) { return couplings[i].after; });
}

void SweepOrder::run(const Sides& sides, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const {
  const size_t threads = threadsFor(nodes_, team.size()), blocks = order_.size();
  const auto at = [&](size_t k) { return order_[sides.isReversed ? blocks - 1 - k : k]; };
  const auto visit = [&](size_t b) { f(b * kBlock, std::min((b + 1) * kBlock, nodes_)); };
  if (threads == 1) {
    for (size_t k = 0; k < blocks; ++k) visit(at(k));
    return;
  }
  std::vector<std::atomic<uint32_t>> left(blocks), ready(blocks);  // per block: how many it still waits for; blocks that need not wait
  std::atomic<size_t> made{0}, taken{0};                           // of those
  for (uint32_t b = 0; b < blocks; ++b) left[b] = uint32_t(sides.before[b].size()), ready[b] = kNone;
  for (size_t k = 0; k < blocks; ++k) {
    if (sides.before[at(k)].empty()) ready[made++] = at(k);
  }
  team.run(threads, [&](size_t) {
    for (size_t k; (k = taken++) < blocks;) {
      uint32_t b;
      while ((b = ready[k].load(std::memory_order_acquire)) == kNone) detail::yieldThread();
      visit(b);
      for (const uint32_t after : sides.after[b]) {
        if (--left[after] == 0) ready[made++].store(after, std::memory_order_release);
      }
    }
  });
}

}  // namespace mandoline::physics
