#include "physics/multigrid_levels.h"

#include <algorithm>
#include <numeric>

#include "base/large_array.h"
#include "base/parallel.h"
#include "base/shared_sets.h"

namespace mandoline::physics {
namespace {

struct CoupledPair {
  uint32_t a, b;  // a > b
  double w;
};

/// Fills in the diagonal: `held` plus `mass` plus couplings.
void setDiagonal(Level& level, unsigned threads) {
  detail::makeLargeOnThreads(level.diagonal, level.held.size(), threads);
  detail::makeLargeOnThreads(level.inverse, level.held.size(), threads);
  forBlocks(level.count(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      double sum = level.held[i] + level.mass[i];
      level.forCouplings(i, [&](uint32_t, double w) { sum += w; });
      level.diagonal[i] = sum;
      level.inverse[i] = sum > 0 ? 1 / sum : 0;
    }
  });
}

/// `pairs` are in the order of a.
void setCouplings(Level& level, const std::vector<CoupledPair>& pairs, unsigned threads) {
  const size_t count = level.held.size(), n = pairs.size();
  const auto setRows = [&](Couplings& rows, bool isLower) {
    const auto rowOf = [&](const CoupledPair& pair) { return level.order.isBefore(pair.b, pair.a) == isLower ? pair.a : pair.b; };
    rows.offsets.assign(count + 1, 0);
    for (const CoupledPair& pair : pairs) ++rows.offsets[rowOf(pair)];
    detail::toOffsets(rows.offsets);
    detail::makeLargeOnThreads(rows.nodes, n, threads);
    detail::makeLargeOnThreads(rows.weights, n, threads);
    for (size_t i = 0; i < n; ++i) {
      const CoupledPair& pair = pairs[isLower ? i : n - 1 - i];
      const uint32_t row = rowOf(pair), at = rows.offsets[row]++;
      rows.nodes[at] = row == pair.a ? pair.b : pair.a;
      rows.weights[at] = pair.w;
    }
    detail::moveBack(rows.offsets);
  };
  setRows(level.lower, true);
  setRows(level.higher, false);
  setDiagonal(level, threads);
}

/// Fills in the couplings of a side: the matrix's negative entries.
template <class IsOnSide>
void takeEntries(const CsrMatrix& matrix, const IsOnSide& isOnSide, bool isReversed, unsigned threads, Couplings& rows) {
  const auto forEntries = [&](size_t i, const auto& f) {
    const auto begin = size_t(matrix.rowOffsets[i]), end = size_t(matrix.rowOffsets[i + 1]);
    for (size_t k = begin; k < end; ++k) {
      const size_t e = isReversed ? begin + end - 1 - k : k;
      if (isOnSide(size_t(matrix.entryColumns[e]), i) && -matrix.entryValues[e] > 0) f(e);
    }
  };
  rows.offsets.assign(matrix.rows() + 1, 0);
  forBlocks(matrix.rows(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) forEntries(i, [&](size_t) { ++rows.offsets[i]; });
  });
  const size_t count = detail::toOffsets(rows.offsets);
  detail::makeLargeOnThreads(rows.nodes, count, threads);
  detail::makeLargeOnThreads(rows.weights, count, threads);
  forBlocks(matrix.rows(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      size_t at = rows.offsets[i];
      forEntries(i, [&](size_t e) {
        rows.nodes[at] = uint32_t(matrix.entryColumns[e]);
        rows.weights[at++] = -matrix.entryValues[e];
      });
    }
  });
}

Level finestLevel(const CellComplex& cells, const OrderedMatrix& system, std::vector<double> held, std::vector<double> mass,
                  unsigned threads) {
  Level level;
  level.held = std::move(held);
  level.mass = std::move(mass);
  level.corner = cells.cellCorner;
  level.order = system.order;
  detail::reserveLarge(level.size, cells.cellCount());
  for (const uint8_t l : cells.cellLevel) level.size.push_back(double(uint32_t(1) << l));
  takeEntries(
      system.matrix, [&](size_t j, size_t i) { return level.order.isBefore(j, i); }, false, threads, level.lower);
  takeEntries(
      system.matrix, [&](size_t j, size_t i) { return level.order.isBefore(i, j); }, true, threads, level.higher);
  setDiagonal(level, threads);
  level.strength = level.diagonal;
  return level;
}

/// Finds the nodes of the next level: those that are coupled within blocks of 2^shift grid cells. Returns how many there are.
uint32_t joinNodes(Level& level, int shift, unsigned threads) {
  const auto sameBlock = [&](size_t i, size_t j) {
    for (size_t d = 0; d < 3; ++d) {
      if (level.corner[3 * i + d] >> shift != level.corner[3 * j + d] >> shift) return false;
    }
    return true;
  };
  detail::SharedSets sets(level.count());
  forBlocks(level.count(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      level.lower.forEach(i, [&](uint32_t j, double) {
        if (sameBlock(i, j)) sets.unite(uint32_t(i), j);
      });
    }
  });
  uint32_t count = 0;
  level.coarse.resize(level.count());
  for (uint32_t i = 0; i < level.count(); ++i) {
    const uint32_t first = sets.find(i);
    if (!level.isCoupled(i))
      level.coarse[i] = Level::none;
    else
      level.coarse[i] = first == i ? count++ : level.coarse[first];
  }
  return count;
}

/// The factor from a sum of couplings over the distance of fine blocks to that over the distance of larger ones. Never below a half, since
/// with smaller couplings the coarse level corrects by more than twice what is right; and only for levels that are visited twice, which
/// undoes such excess. On levels visited once it would add up from level to level.
double farther(const Level& fine, double fineSize, double size) { return fine.twice ? std::max(fineSize / size, 0.5) : 1; }

/// If a node's couplings are together this much weaker than those joined inside it, what comes through them is mostly rounding, which would
/// be taken for a large step. Such nodes keep their values, and hold their neighbours.
void holdStill(Level& level, std::vector<CoupledPair>& pairs) {
  constexpr double kWeakest = 1e-8;
  std::vector<double> total = level.held;
  for (uint32_t a = 0; a < total.size(); ++a) total[a] += level.mass[a];
  for (const auto& [a, b, w] : pairs) total[a] += w, total[b] += w;
  const auto isStill = [&](uint32_t a) { return total[a] < kWeakest * level.strength[a]; };
  for (const auto& [a, b, w] : pairs) {
    if (isStill(a)) level.held[b] += w;
    if (isStill(b)) level.held[a] += w;
  }
  for (uint32_t a = 0; a < level.held.size(); ++a) {
    if (isStill(a)) level.held[a] = level.mass[a] = 0;
  }
  std::erase_if(pairs, [&](const CoupledPair& pair) { return isStill(pair.a) || isStill(pair.b); });
}

/// How the nodes of the next level are coupled, in the order of a.
std::vector<CoupledPair> pairsOf(const Level& fine, const Level& level, unsigned threads) {
  const size_t count = level.held.size();
  struct Place {
    uint32_t a = ~0u, pair;  // that of a with b, among those of a
  };
  detail::Monitor monitor(threadsFor(count, threads));
  std::vector<std::vector<Place>> placesOfThreads(monitor.threads());  // per b
  std::vector<std::vector<CoupledPair>> parts(blockCount(count));
  std::vector<uint32_t> blocks(parts.size());
  std::iota(blocks.begin(), blocks.end(), 0u);
  detail::runItems(blocks, monitor, [&](size_t thread, uint32_t block) {
    std::vector<Place>& places = placesOfThreads[thread];
    places.resize(count);
    std::vector<CoupledPair>& pairs = parts[block];
    for (uint32_t a = uint32_t(block * kBlock); a < std::min(count, (block + 1) * kBlock); ++a) {
      const size_t first = pairs.size();
      for (const uint32_t i : fine.members[a]) {
        fine.forCouplings(i, [&](uint32_t j, double w) {
          const uint32_t b = fine.coarse[j];
          if (b >= a) return;
          if (places[b].a != a) places[b] = {a, uint32_t(pairs.size() - first)}, pairs.push_back({a, b, 0});
          pairs[first + places[b].pair].w += w * farther(fine, fine.size[i] + fine.size[j], level.size[a] + level.size[b]);
        });
      }
    }
  });
  std::vector<CoupledPair> pairs;
  size_t total = 0;
  for (const auto& part : parts) total += part.size();
  pairs.reserve(total);
  for (const auto& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

Level coarserLevel(const Level& fine, uint32_t count, int shift, unsigned threads) {
  Level level;
  level.held.resize(count);
  level.mass.resize(count);
  level.strength.resize(count);
  level.corner.resize(3 * size_t(count));
  level.size.assign(count, double(uint64_t(1) << shift));
  forBlocks(count, threads, [&](size_t begin, size_t end) {
    for (size_t a = begin; a < end; ++a) {
      for (const uint32_t i : fine.members[a]) {
        level.size[a] = std::max(level.size[a], fine.size[i]);
        level.strength[a] = std::max(level.strength[a], fine.strength[i]);
        level.held[a] += fine.held[i] * farther(fine, fine.size[i], level.size[a]);
        level.mass[a] += fine.mass[i];
        for (size_t d = 0; d < 3; ++d) level.corner[3 * a + d] = fine.corner[3 * i + d] >> shift << shift;
      }
    }
  });
  std::vector<CoupledPair> pairs = pairsOf(fine, level, threads);
  holdStill(level, pairs);
  size_t next = 0;  // pair
  level.order = SweepOrder(count, [&](size_t a, const auto& visit) {
    for (; next < pairs.size() && pairs[next].a == a; ++next) visit(pairs[next].b);
  });
  setCouplings(level, pairs, threads);
  return level;
}

/// Whether mass and what holds nodes outweigh couplings everywhere, so that smoothing alone solves the level.
bool isDominatedByMass(const Level& level) {
  bool hasMass = false;
  for (size_t i = 0; i < level.count(); ++i) {
    if (level.diagonal[i] > 2 * (level.mass[i] + level.held[i])) return false;
    hasMass |= level.mass[i] > 0;
  }
  return hasMass;
}

}  // namespace

std::vector<Level> multigridLevels(const CellComplex& cells, const OrderedMatrix& system, std::vector<double> held,
                                   std::vector<double> mass, unsigned threads) {
  std::vector<Level> levels;
  levels.push_back(finestLevel(cells, system, std::move(held), std::move(mass), threads));
  int32_t last = 0;
  for (const int32_t corner : cells.cellCorner) last = std::max(last, corner);
  for (int shift = 1; last >> (shift - 1) > 0 && !levels.back().lower.nodes.empty(); ++shift) {
    Level& fine = levels.back();
    if (isDominatedByMass(fine)) break;
    const uint32_t count = joinNodes(fine, shift, threads);
    if (count > fine.count() - fine.count() / 16 && last >> shift > 0) continue;  // too few join to be worth a level
    fine.twice = count <= fine.count() / 2;
    fine.members = detail::groupBy<uint32_t>(
        count + 1, fine.count(), [&](size_t i) { return size_t(std::min(fine.coarse[i], count)); }, [](size_t i) { return uint32_t(i); });
    levels.push_back(coarserLevel(fine, count, shift, threads));
  }
  levels.back().coarse.clear();
  return levels;
}

}  // namespace mandoline::physics
