#include "physics/node_loops.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace mandoline::physics {

unsigned threadsFor(size_t nodes, unsigned threads) {
  constexpr size_t kLeast = 4;  // blocks per thread
  return unsigned(std::clamp<size_t>(blockCount(nodes) / kLeast, 1, threads));
}

void forBlocks(size_t nodes, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) {
  const size_t blocks = blockCount(nodes);
  std::atomic<size_t> next{0};
  team.run(threadsFor(nodes, team.size()), [&](size_t) {
    for (size_t block; (block = next++) < blocks;) f(kBlock * block, std::min(kBlock * (block + 1), nodes));
  });
}

double sumOfBlocks(size_t nodes, const detail::Team& team, detail::FunctionRef<double(size_t, size_t)> f) {
  std::vector<double> sums(blockCount(nodes));
  forBlocks(nodes, team, [&](size_t begin, size_t end) { sums[begin / kBlock] = f(begin, end); });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

bool areFinite(std::span<const double> values, const detail::Team& team) {
  return sumOfBlocks(values.size(), team, [&](size_t begin, size_t end) {
           return std::all_of(values.begin() + ptrdiff_t(begin), values.begin() + ptrdiff_t(end), [](double x) { return std::isfinite(x); })
                      ? 0.0
                      : 1.0;
         }) == 0;
}

}  // namespace mandoline::physics
