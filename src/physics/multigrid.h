// A multigrid preconditioner for Poisson systems: each coarser level joins the cells that lie in one block of twice the side and are
// connected inside it, so that no level couples the two sides of a sheet.
#pragma once

#include "physics/multigrid_levels.h"

namespace mandoline::physics {

class Multigrid {
 public:
  /// `levels`: multigridLevels().
  explicit Multigrid(std::vector<Level> levels);

  /// x = B r, where B is symmetric, positive definite and near the matrix's inverse. Nodes whose diagonal is zero get 0.
  void apply(const std::vector<double>& r, std::vector<double>& x, const detail::Team& team);

 private:
  struct Vectors {
    std::vector<double> x, r, firstX, secondR;
  };
  void cycle(size_t level, const std::vector<double>& r, std::vector<double>& x);
  void correct(size_t level, std::vector<double>& x);

  std::vector<Level> levels_;
  std::vector<Vectors> vectors_;        // per level
  const detail::Team* team_ = nullptr;  // while it is applied
};

}  // namespace mandoline::physics
