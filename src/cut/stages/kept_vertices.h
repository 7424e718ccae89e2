// Vertices of the result that lie where they did, with their positions in the cut before.
//
// In: KeptBricks, and the Numbers of both cuts. Out: KeptVertices: those on grid elements that only kept bricks have.
#pragma once

#include "cut/stages/numbers.h"

namespace mandoline::detail {

struct KeptVertices {
  std::vector<uint32_t> before;       ///< per vertex: its number before, or kUnused. Empty if none is kept
  std::span<const double> positions;  ///< before

  bool has(size_t vertex) const { return !before.empty() && before[vertex] != Numbers::kUnused; }
  /// Its coordinates, or null if it is not kept.
  const double* find(size_t vertex) const { return has(vertex) ? &positions[3 * size_t(before[vertex])] : nullptr; }
};

/// KeptVertices::before.
std::vector<uint32_t> findKeptVertices(const CutBricks& cut, const KeptBricks& kept, const Numbers& before, const Numbers& now);

}  // namespace mandoline::detail
