// Loops over the nodes of a system on all threads. Their blocks do not depend on how many threads there are, so neither do sums.
#pragma once

#include <cstddef>
#include <span>

#include "base/team.h"

namespace mandoline::physics {

inline constexpr size_t kBlock = 2048;  ///< nodes

inline size_t blockCount(size_t nodes) { return (nodes + kBlock - 1) / kBlock; }

/// How many threads are worth calling for so many nodes, at most `threads`, which is at least 1: to call one takes as long as some blocks.
unsigned threadsFor(size_t nodes, unsigned threads);

/// Runs f(begin, end), which must not throw, for each block of nodes.
void forBlocks(size_t nodes, const detail::Team& team, detail::FunctionRef<void(size_t, size_t)> f);

/// The sum of f(begin, end) over the blocks, added in their order.
double sumOfBlocks(size_t nodes, const detail::Team& team, detail::FunctionRef<double(size_t, size_t)> f);

bool areFinite(std::span<const double> values, const detail::Team& team);

}  // namespace mandoline::physics
