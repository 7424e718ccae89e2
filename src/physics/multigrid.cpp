#include "physics/multigrid.h"

namespace mandoline::physics {

Multigrid::Multigrid(std::vector<Level> levels) : levels_(std::move(levels)) {
  for (size_t l = 0; l < levels_.size(); ++l) {
    Vectors& v = vectors_.emplace_back();
    if (l == 0) continue;
    v.x.resize(levels_[l].count());
    v.r.resize(levels_[l].count());
    if (!levels_[l - 1].twice) continue;
    v.firstX.resize(levels_[l].count());
    v.secondR.resize(levels_[l].count());
  }
}

void Multigrid::apply(const std::vector<double>& r, std::vector<double>& x, const detail::Team& team) {
  team_ = &team;
  cycle(0, r, x);
}

/// Gauss-Seidel forwards from zero, where only lower nodes have values yet; and backwards.
void Multigrid::cycle(size_t l, const std::vector<double>& r, std::vector<double>& x) {
  const Level& level = levels_[l];
  level.order.forwards(*team_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) x[i] = level.inverse[i] * level.lower.addTo(r[i], i, x);
  });
  if (l + 1 < levels_.size()) correct(l, x);
  level.order.backwards(*team_, [&](size_t begin, size_t end) {
    for (size_t i = end; i-- > begin;) x[i] = level.inverse[i] * level.higher.addTo(level.lower.addTo(r[i], i, x), i, x);
  });
}

/// Adds the correction of the next level to what the first sweep has made. Of that the residual is what higher nodes add.
void Multigrid::correct(size_t l, std::vector<double>& x) {
  const Level &fine = levels_[l], &level = levels_[l + 1];
  Vectors& v = vectors_[l + 1];
  const bool isTwice = fine.twice && l + 2 < levels_.size();
  forBlocks(level.count(), *team_, [&](size_t begin, size_t end) {
    for (size_t a = begin; a < end; ++a) {
      v.r[a] = 0;
      for (const uint32_t i : fine.members[a]) v.r[a] += fine.higher.addTo(0, i, x);
    }
  });
  cycle(l + 1, v.r, v.x);
  if (isTwice) {
    v.firstX.swap(v.x);
    forBlocks(level.count(), *team_, [&](size_t begin, size_t end) {
      for (size_t a = begin; a < end; ++a) {
        const double sum = v.r[a] - level.diagonal[a] * v.firstX[a];
        v.secondR[a] = level.higher.addTo(level.lower.addTo(sum, a, v.firstX), a, v.firstX);
      }
    });
    cycle(l + 1, v.secondR, v.x);
  }
  forBlocks(fine.count(), *team_, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t a = fine.coarse[i];
      if (a != Level::none) x[i] += isTwice ? v.firstX[a] + v.x[a] : v.x[a];
    }
  });
}

}  // namespace mandoline::physics
