#include "cli/orders/speeds.h"

#include <algorithm>

#include "base/parallel.h"
#include "operators/measure/vector.h"
#include "physics/cell_velocities.h"
#include "physics/flow_field.h"

namespace mandoline::orders {
namespace {

Flow exactlyBounded(const CellComplex& cells, const Exact& exact) {
  PoissonProblem problem = problemOf(cells, exact, DualPoints::centres);
  SolveOptions options;
  options.balance = true;
  Flow flow;
  flow.phi = solvePoisson(cells, problem, options).phi;
  detail::Monitor monitor(options, 1);
  physics::fillVelocities(cells, problem, monitor, flow);
  return flow;
}

}  // namespace

Speeds speedsOf(const CellComplex& cells, const Exact& exact) {
  const Flow flow = exactlyBounded(cells, exact);
  Speeds speeds;
  double volume = 0;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    Point error = exact.gradient({cells.cellCentroid[3 * c], cells.cellCentroid[3 * c + 1], cells.cellCentroid[3 * c + 2]});
    for (size_t d = 0; d < 3; ++d) error[d] -= flow.cellVelocity[3 * c + d];
    speeds.meanError += measuring::length(error) * cells.cellVolume[c];
    volume += cells.cellVolume[c];
  }
  speeds.meanError /= volume;
  for (size_t h = 0; h < cells.faceCells.size(); ++h) {
    if (cells.faceTag[h / 2] != FaceTag::surface || cells.faceCells[h] < 0) continue;
    const auto velocity = physics::velocityIn(cells, flow, size_t(cells.faceCells[h]), &cells.faceCentroid[3 * (h / 2)]);
    speeds.largestOnSurface = std::max(speeds.largestOnSurface, measuring::length(velocity));
  }
  return speeds;
}

}  // namespace mandoline::orders
