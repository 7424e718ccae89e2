// The means of phi over components in which no condition holds it. They are no progress, and the rounding of large ones would drown it.
#pragma once

#include "base/csr.h"
#include "base/team.h"
#include "mandoline/poisson.h"

namespace mandoline::physics {

class FreeMeans {
 public:
  /// `held`: per component, whether phi is held.
  FreeMeans(const CellComplex& cells, const CellComponents& components, const std::vector<char>& held);

  /// Takes the means, weighted by volume, out of z. Returns the product of r and what is left.
  double takeOut(const std::vector<double>& r, std::vector<double>& z, const detail::Team& team) const;

 private:
  /// Cells one after the other, of one component and one block.
  struct Run {
    uint32_t component, begin, end;
  };
  std::vector<double> meansOf(const std::vector<double>& z, const detail::Team& team) const;

  const CellComplex& cells_;
  detail::Csr<Run> runs_;       // per block
  std::vector<double> volume_;  // per component, 0 where phi is held
};

}  // namespace mandoline::physics
