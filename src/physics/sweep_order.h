// Sweeps of Gauss-Seidel on all threads, whose results are those of one thread, to the bit. Cells that follow each other touch, so blocks
// of them can't be done at once in the order of cells. Blocks have colours instead, those that are coupled different ones, and go by these.
#pragma once

#include "base/csr.h"
#include "base/function_ref.h"
#include "physics/node_loops.h"

namespace mandoline::physics {

/// The order of nodes in a sweep: by the colours of their blocks, and in a block as they are numbered. A block waits for those before it
/// that it is coupled with.
class SweepOrder {
 public:
  SweepOrder() = default;
  /// `forLower(i, visit)` calls visit(j) for all j < i that node i is coupled with.
  template <class ForLower>
  SweepOrder(size_t nodes, const ForLower& forLower) : nodes_(nodes) {
    const size_t blocks = blockCount(nodes);
    detail::Csr<uint32_t> lower;                        // per block: those of lower numbers that it is coupled with
    std::vector<uint32_t> waits(blocks, ~uint32_t(0));  // per block: the last one that is known to be coupled with it
    for (uint32_t b = 0; b < blocks; ++b) {
      for (size_t i = b * kBlock; i < nodes && i < (b + 1) * kBlock; ++i) {
        forLower(i, [&](size_t j) {
          const size_t other = j / kBlock;
          if (other == b || waits[other] == b) return;
          waits[other] = b;
          lower.items.push_back(uint32_t(other));
        });
      }
      lower.endGroup();
    }
    setColors(lower);
  }

  /// Whether a forward sweep comes to node i before node j.
  bool isBefore(size_t i, size_t j) const {
    const size_t a = i / kBlock, b = j / kBlock;
    return a == b ? i < j : place_[a] < place_[b];
  }

  /// Runs f(begin, end), which must not throw, for ranges of nodes.
  void forwards(const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const { run({before_, after_, false}, team, f); }
  void backwards(const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const { run({after_, before_, true}, team, f); }

 private:
  /// Blocks that each one waits for, and those that wait for it.
  struct Sides {
    const detail::Csr<uint32_t>&before, &after;
    bool isReversed;
  };
  void setColors(const detail::Csr<uint32_t>& lower);
  void run(const Sides& sides, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f) const;

  size_t nodes_ = 0;
  std::vector<uint32_t> order_, place_;   // blocks as a sweep takes them; where there a block is
  detail::Csr<uint32_t> before_, after_;  // per block: those that it is coupled with, on both sides of it in this order
};

}  // namespace mandoline::physics
