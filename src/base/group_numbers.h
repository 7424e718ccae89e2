// Groups of numbers, found on all threads.
#pragma once

#include "base/csr.h"
#include "base/parallel.h"

namespace mandoline::detail {

inline constexpr uint32_t kNoGroup = ~0u;

/// Groups the numbers below n by groupOf(number), which is asked twice, ascending in each group; those with kNoGroup are left out.
template <class GroupOf>
Csr<uint32_t> groupNumbers(size_t groups, size_t n, Monitor& monitor, const GroupOf& groupOf) {
  struct Chunk {
    size_t begin = 0, end = 0;
    std::vector<uint32_t> at;  // per group: how many there are, then where the next one goes
  };
  auto chunks = forChunks<Chunk>(n, monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    if (chunk.at.empty()) {
      chunk.begin = begin;
      chunk.at.resize(groups, 0);
    }
    chunk.end = end;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t group = groupOf(i);
      if (group != kNoGroup) ++chunk.at[group];
    }
  });
  Csr<uint32_t> result;
  result.offsets.resize(groups + 1);
  uint32_t total = 0;
  for (size_t group = 0; group < groups; ++group) {
    for (Chunk& chunk : chunks) {
      if (!chunk.at.empty()) total += std::exchange(chunk.at[group], total);
    }
    result.offsets[group + 1] = total;
  }
  result.items.resize(total);
  runChunks(
      chunks.size(), chunks.size(), monitor,
      [&](size_t c, size_t, size_t) {
        Chunk& chunk = chunks[c];
        for (size_t i = chunk.begin; i < chunk.end; ++i) {
          const uint32_t group = groupOf(i);
          if (group != kNoGroup) result.items[chunk.at[group]++] = uint32_t(i);
        }
      },
      1);
  return result;
}

}  // namespace mandoline::detail
