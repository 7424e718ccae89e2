// Vertices of the result that lie where they did, with their positions in the cut before.
//
// In: KeptBricks, and the Numbers of both cuts. Out: KeptVertices: those on grid elements that only kept bricks have.
#pragma once

#include "cut/stages/numbers.h"

namespace mandoline::detail {

struct KeptVertices {
  /// Vertices with numbers in a row, now and before.
  struct Run {
    uint32_t first, before, count;

    uint32_t past() const { return first + count; }
  };
  std::vector<Run> runs;              ///< ascending, without common vertices. Empty if none is kept
  std::span<const double> positions;  ///< before

  /// Calls f(part of a run) for what is kept of a range of numbers.
  template <class F>
  void forKept(size_t first, size_t past, const F& f) const {
    auto run = std::upper_bound(runs.begin(), runs.end(), first, [](size_t at, const Run& r) { return at < r.past(); });
    for (; run != runs.end() && run->first < past; ++run) {
      const uint32_t begin = std::max(run->first, uint32_t(first)), end = uint32_t(std::min<size_t>(run->past(), past));
      f(Run{begin, run->before + (begin - run->first), end - begin});
    }
  }
  /// Calls f(first, past) for the parts of a range of numbers that are not kept.
  template <class F>
  void forOthers(size_t first, size_t past, const F& f) const {
    forKept(first, past, [&](const Run& run) {
      if (first < run.first) f(first, size_t(run.first));
      first = run.past();
    });
    if (first < past) f(first, past);
  }
};

/// Of the cut before: what is left of it once bricks and seams are kept.
struct VerticesBefore {
  const Bricks& bricks;
  const IdVector<BrickId, BrickSeams>& seams;
  const Numbers& numbers;
};

/// KeptVertices::runs.
std::vector<KeptVertices::Run> findKeptVertices(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut,
                                                const Numbers& numbers);

}  // namespace mandoline::detail
