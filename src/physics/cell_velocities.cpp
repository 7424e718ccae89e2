#include "physics/cell_velocities.h"

#include "physics/cell_fits.h"

namespace mandoline::physics {

void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow) {
  const DualEdges dual = dualEdges(cells, problem.dualPoints);
  const FitData data = fitData(cells, dual, problem);
  CellFits fits = fitAll(cells, {data, fitValues(cells, dual, problem, data, flow.phi), problem.source}, monitor);
  flow.cellVelocity = std::move(fits.gradient);
  flow.cellGradient = std::move(fits.second);
}

}  // namespace mandoline::physics
