#include "physics/advection.h"

#include <algorithm>
#include <cmath>

namespace mandoline::physics {
namespace {

/// Of the differences ahead and behind: their mean, limited to twice each; 0 at an extremum.
double limited(double ahead, double behind) {
  if (ahead * behind <= 0) return 0;
  const double least = 2 * std::min(std::fabs(ahead), std::fabs(behind)), mean = (ahead + behind) / 2;
  return std::fabs(mean) <= least ? mean : std::copysign(least, mean);
}

}  // namespace

void addAdvection(const CellComplex& cells, const FlowCells& flowCells, const UnsteadyFlow& flow, const std::vector<double>& gradients,
                  std::vector<double>& result) {
  const std::vector<double>& u = flow.cellVelocity;
  for (const FlowFace& face : flowCells.faces()) {
    const double flux = flow.faceVelocity[face.face] * cells.faceArea[face.face];
    const size_t from = flux >= 0 ? 0 : 1;
    const double sign = from == 0 ? 1 : -1, share = from == 0 ? face.share : 1 - face.share;
    const size_t a = face.cells[from], b = face.cells[1 - from];
    for (size_t d = 0; d < 3; ++d) {
      const double *gradient = &gradients[9 * a + 3 * d], own = u[3 * a + d], other = u[3 * b + d], ahead = other - own;
      const double along = sign * (gradient[0] * face.step[0] + gradient[1] * face.step[1] + gradient[2] * face.step[2]);
      double value = own + share * limited(ahead, 2 * along - ahead);
      if (face.isSkewed) value += gradient[0] * face.skew[0] + gradient[1] * face.skew[1] + gradient[2] * face.skew[2];
      value = std::clamp(value, std::min(own, other), std::max(own, other));
      result[3 * face.cells[0] + d] -= flux * value;
      result[3 * face.cells[1] + d] += flux * value;
    }
  }
}

}  // namespace mandoline::physics
