// The means of phi over components in which no condition holds it. They are no progress, and the rounding of large ones would drown it.
#pragma once

#include "physics/component_runs.h"

namespace mandoline::physics {

class FreeMeans {
 public:
  /// `held`: per component, whether phi is held.
  FreeMeans(const CellComplex& cells, const ComponentRuns& runs, const std::vector<char>& held, const detail::Team& team);

  /// Takes the means, weighted by volume, out of z. Returns the product of r and what is left.
  double takeOut(const std::vector<double>& r, std::vector<double>& z, const detail::Team& team) const;

 private:
  std::vector<double> meansOf(const std::vector<double>& z, const detail::Team& team) const;

  const CellComplex& cells_;
  const ComponentRuns& runs_;
  std::vector<double> volume_;  // per component, 0 where phi is held
};

}  // namespace mandoline::physics
