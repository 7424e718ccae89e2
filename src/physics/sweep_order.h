// Sweeps of Gauss-Seidel on all threads. Where nodes are coupled, that which comes first in the sweep is done first: so its result is that
// of one thread, to the bit. Threads take blocks in the order in which these become ready, so that none waits while there is one.
#pragma once

#include "base/csr.h"
#include "base/function_ref.h"
#include "physics/node_loops.h"

namespace mandoline::physics {

/// Blocks of nodes, each of which waits for those before it that it is coupled with.
class SweepOrder {
 public:
  SweepOrder() = default;
  /// `forLower(i, visit)` calls visit(j) for all j < i that node i is coupled with.
  template <class ForLower>
  SweepOrder(size_t nodes, const ForLower& forLower) : nodes_(nodes) {
    const size_t blocks = blockCount(nodes);
    std::vector<uint32_t> waits(blocks, ~uint32_t(0));  // per block: the last one that is known to wait for it
    for (uint32_t b = 0; b < blocks; ++b) {
      for (size_t i = b * kBlock; i < nodes && i < (b + 1) * kBlock; ++i) {
        forLower(i, [&](size_t j) {
          const size_t lower = j / kBlock;
          if (lower == b || waits[lower] == b) return;
          waits[lower] = b;
          lower_.items.push_back(uint32_t(lower));
        });
      }
      lower_.endGroup();
    }
    setHigher();
  }

  /// Runs f(begin, end), which must not throw, for ranges of nodes.
  void forwards(const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const { run({lower_, higher_}, team, f); }
  void backwards(const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const { run({higher_, lower_}, team, f); }

 private:
  /// Blocks that each one waits for, and those that wait for it.
  struct Sides {
    const detail::Csr<uint32_t>&before, &after;
  };
  void setHigher();
  void run(const Sides& sides, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const;

  size_t nodes_ = 0;
  detail::Csr<uint32_t> lower_, higher_;  // per block: those that it is coupled with
};

}  // namespace mandoline::physics
