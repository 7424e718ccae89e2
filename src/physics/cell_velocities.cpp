#include "physics/cell_velocities.h"

#include "physics/cell_edges.h"
#include "physics/cell_fits.h"

namespace mandoline::physics {

void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow) {
  const DualEdges dual = dualEdges(cells, problem.dualPoints, {}, monitor.threads());
  const detail::Csr<uint32_t> edgesOfCells = cellEdges(cells, dual, monitor.threads());
  const FitSource source{cells, dual, edgesOfCells, problem};
  const FitData data = fitData(source, nullptr, {}, monitor.threads());
  CellFits fits = fitAll(cells, {data, fitValues(source, data, flow.phi, monitor.threads()), problem.source}, monitor);
  flow.cellVelocity = std::move(fits.gradient);
  flow.cellGradient = std::move(fits.second);
}

}  // namespace mandoline::physics
