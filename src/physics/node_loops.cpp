#include "physics/node_loops.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/threads.h"

namespace mandoline::physics {

unsigned threadsFor(size_t nodes, unsigned threads) {
  constexpr size_t kLeast = 4;  // blocks per thread
  return unsigned(std::clamp<size_t>(blockCount(nodes) / kLeast, 1, threads));
}

void forBlocks(size_t nodes, unsigned threads, detail::FunctionRef<void(size_t, size_t)> f) {
  std::atomic<size_t> next{0};
  detail::runOnThreads(threadsFor(nodes, threads), [&](size_t) {
    for (size_t begin; (begin = kBlock * next++) < nodes;) f(begin, std::min(begin + kBlock, nodes));
  });
}

double sumOfBlocks(size_t nodes, unsigned threads, detail::FunctionRef<double(size_t, size_t)> f) {
  std::vector<double> sums(blockCount(nodes));
  forBlocks(nodes, threads, [&](size_t begin, size_t end) { sums[begin / kBlock] = f(begin, end); });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

}  // namespace mandoline::physics
