// Sums over the cells of each component, on all threads.
#pragma once

#include "base/csr.h"
#include "mandoline/poisson.h"
#include "physics/node_loops.h"

namespace mandoline::physics {

/// The cells of each block in runs of one component.
class ComponentRuns {
 public:
  /// Cells one after the other.
  struct Run {
    uint32_t component, begin, end;
  };

  explicit ComponentRuns(const CellComponents& components);

  std::span<const Run> ofBlock(size_t block) const { return runs_[block]; }
  /// Per component the sum of f(begin, end) over its runs, in their order. f must not throw.
  std::vector<double> sums(const detail::Team& team, detail::FunctionRef<double(size_t, size_t)> f) const;

 private:
  uint32_t components_;
  size_t cells_;
  detail::Csr<Run> runs_;
};

}  // namespace mandoline::physics
