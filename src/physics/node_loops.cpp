#include "physics/node_loops.h"

#include <algorithm>
#include <vector>

#include "base/threads.h"

namespace mandoline::physics {

unsigned threadsFor(size_t nodes, unsigned threads) {
  constexpr size_t kLeast = 4;  // blocks per thread
  return unsigned(std::clamp<size_t>(blockCount(nodes) / kLeast, 1, threads));
}

void forBlocks(size_t nodes, unsigned threads, detail::FunctionRef<void(size_t, size_t)> f) {
  detail::runOnParts(blockCount(nodes), threadsFor(nodes, threads),
                     [&](size_t block) { f(kBlock * block, std::min(kBlock * (block + 1), nodes)); });
}

double sumOfBlocks(size_t nodes, unsigned threads, detail::FunctionRef<double(size_t, size_t)> f) {
  std::vector<double> sums(blockCount(nodes));
  forBlocks(nodes, threads, [&](size_t begin, size_t end) { sums[begin / kBlock] = f(begin, end); });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

}  // namespace mandoline::physics
