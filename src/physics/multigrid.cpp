#include "physics/multigrid.h"

#include <algorithm>

#include "base/disjoint_sets.h"

namespace mandoline::physics {
namespace {

struct CoupledPair {
  uint32_t a, b;
  double w;
};

/// `held` plus `mass` plus couplings.
void setDiagonal(Level& level) {
  level.diagonal = level.held;
  for (size_t i = 0; i < level.count(); ++i) {
    level.diagonal[i] += level.mass[i];
    for (const auto& [j, w] : level.couplings[i]) level.diagonal[i] += w;
  }
}

void setCouplings(Level& level, const std::vector<CoupledPair>& pairs) {
  const auto end = [&](size_t i) { return i % 2 ? pairs[i / 2].b : pairs[i / 2].a; };
  level.couplings = detail::groupBy<Level::Coupling>(
      level.held.size(), 2 * pairs.size(), [&](size_t i) { return size_t(end(i)); },
      [&](size_t i) {
        return Level::Coupling{end(i ^ 1), pairs[i / 2].w};
      });
  setDiagonal(level);
}

Level finestLevel(const CellComplex& cells, const CsrMatrix& matrix, std::vector<double> held, std::vector<double> mass) {
  Level level;
  level.held = std::move(held);
  level.mass = std::move(mass);
  level.corner = cells.cellCorner;
  for (const uint8_t l : cells.cellLevel) level.size.push_back(double(uint32_t(1) << l));
  for (size_t i = 0; i < matrix.rows(); ++i) {
    for (auto e = size_t(matrix.rowOffsets[i]); e < size_t(matrix.rowOffsets[i + 1]); ++e) {
      const auto j = uint32_t(matrix.entryColumns[e]);
      const double w = -matrix.entryValues[e];
      if (j != i && w > 0) level.couplings.items.push_back({j, w});
    }
    level.couplings.endGroup();
  }
  setDiagonal(level);
  level.strength = level.diagonal;
  return level;
}

/// Finds the nodes of the next level: those that are coupled within blocks of 2^shift grid cells. Returns how many there are.
uint32_t joinNodes(Level& level, int shift) {
  const auto sameBlock = [&](size_t i, size_t j) {
    for (size_t d = 0; d < 3; ++d) {
      if (level.corner[3 * i + d] >> shift != level.corner[3 * j + d] >> shift) return false;
    }
    return true;
  };
  detail::DisjointSets sets(level.count());
  for (uint32_t i = 0; i < level.count(); ++i) {
    for (const auto& [j, w] : level.couplings[i]) {
      if (j < i && sameBlock(i, j)) sets.unite(i, j);
    }
  }
  uint32_t count = 0;
  level.coarse.resize(level.count());
  for (uint32_t i = 0; i < level.count(); ++i) {
    const uint32_t first = sets.find(i);
    if (level.couplings[i].empty())
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

Level coarserLevel(const Level& fine, uint32_t count, int shift) {
  Level level;
  level.held.resize(count);
  level.mass.resize(count);
  level.strength.resize(count);
  level.corner.resize(3 * size_t(count));
  level.size.assign(count, double(uint64_t(1) << shift));
  for (size_t i = 0; i < fine.count(); ++i) {
    const uint32_t a = fine.coarse[i];
    if (a == Level::none) continue;
    level.size[a] = std::max(level.size[a], fine.size[i]);
    level.strength[a] = std::max(level.strength[a], fine.strength[i]);
    level.held[a] += fine.held[i] * farther(fine, fine.size[i], level.size[a]);
    level.mass[a] += fine.mass[i];
    for (size_t d = 0; d < 3; ++d) level.corner[3 * a + d] = fine.corner[3 * i + d] >> shift << shift;
  }
  const auto members = detail::groupBy<uint32_t>(
      count + 1, fine.count(), [&](size_t i) { return size_t(std::min(fine.coarse[i], count)); }, [](size_t i) { return uint32_t(i); });
  std::vector<CoupledPair> pairs;
  std::vector<size_t> at(count, ~size_t(0));  // place of a's pair with b
  for (uint32_t a = 0; a < count; ++a) {
    const size_t first = pairs.size();
    for (const uint32_t i : members[a]) {
      for (const auto& [j, w] : fine.couplings[i]) {
        const uint32_t b = fine.coarse[j];
        if (b >= a) continue;
        if (at[b] == ~size_t(0) || at[b] < first) at[b] = pairs.size(), pairs.push_back({a, b, 0});
        pairs[at[b]].w += w * farther(fine, fine.size[i] + fine.size[j], level.size[a] + level.size[b]);
      }
    }
  }
  holdStill(level, pairs);
  setCouplings(level, pairs);
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

/// One sweep of Gauss-Seidel.
template <bool forwards>
void smooth(const Level& level, const std::vector<double>& r, std::vector<double>& x) {
  const size_t n = level.count();
  for (size_t k = 0; k < n; ++k) {
    const size_t i = forwards ? k : n - 1 - k;
    double sum = r[i];
    for (const auto& [j, w] : level.couplings[i]) sum += w * x[j];
    x[i] = level.diagonal[i] > 0 ? sum / level.diagonal[i] : 0;
  }
}

double residual(const Level& level, const std::vector<double>& r, const std::vector<double>& x, size_t i) {
  double sum = r[i] - level.diagonal[i] * x[i];
  for (const auto& [j, w] : level.couplings[i]) sum += w * x[j];
  return sum;
}

}  // namespace

Multigrid::Multigrid(const CellComplex& cells, const CsrMatrix& matrix, std::vector<double> held, std::vector<double> mass) {
  levels_.push_back(finestLevel(cells, matrix, std::move(held), std::move(mass)));
  int32_t last = 0;
  for (const int32_t corner : cells.cellCorner) last = std::max(last, corner);
  for (int shift = 1; last >> (shift - 1) > 0 && !levels_.back().couplings.items.empty(); ++shift) {
    Level& fine = levels_.back();
    if (isDominatedByMass(fine)) break;
    const uint32_t count = joinNodes(fine, shift);
    if (count > fine.count() - fine.count() / 16 && last >> shift > 0) continue;  // too few join to be worth a level
    fine.twice = count <= fine.count() / 2;
    levels_.push_back(coarserLevel(fine, count, shift));
  }
  levels_.back().coarse.clear();
  for (const Level& level : levels_) {
    const std::vector<double> zeros(level.count());
    vectors_.push_back({zeros, zeros, zeros});
  }
}

void Multigrid::apply(const std::vector<double>& r, std::vector<double>& x) { cycle(0, r, x); }

void Multigrid::cycle(size_t l, const std::vector<double>& r, std::vector<double>& x) {
  const Level& level = levels_[l];
  std::fill(x.begin(), x.end(), 0.0);
  smooth<true>(level, r, x);
  if (l + 1 < levels_.size()) correct(l, r, x);
  smooth<false>(level, r, x);
}

void Multigrid::correct(size_t l, const std::vector<double>& r, std::vector<double>& x) {
  const Level &fine = levels_[l], &level = levels_[l + 1];
  Vectors& v = vectors_[l + 1];
  std::fill(v.r.begin(), v.r.end(), 0.0);
  for (size_t i = 0; i < fine.count(); ++i) {
    if (fine.coarse[i] != Level::none) v.r[fine.coarse[i]] += residual(fine, r, x, i);
  }
  cycle(l + 1, v.r, v.x);
  const auto add = [&] {
    for (size_t i = 0; i < fine.count(); ++i) {
      if (fine.coarse[i] != Level::none) x[i] += v.x[fine.coarse[i]];
    }
  };
  if (fine.twice && l + 2 < levels_.size()) {
    add();
    v.more.swap(v.r);
    for (size_t i = 0; i < level.count(); ++i) v.r[i] = residual(level, v.more, v.x, i);
    v.more.swap(v.r);
    cycle(l + 1, v.more, v.x);
  }
  add();
}

}  // namespace mandoline::physics
