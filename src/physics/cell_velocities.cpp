#include "physics/cell_velocities.h"

#include <algorithm>

#include "physics/cell_edges.h"
#include "physics/cubic_fits.h"
#include "physics/uniform_fits.h"

namespace mandoline::physics {

void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow) {
  const DualEdges dual = dualEdges(cells, problem.dualPoints, {}, monitor.threads());
  fillVelocities({cells, dual, cellEdges(cells, dual, monitor.threads()), problem}, monitor, flow);
}

void fillVelocities(const FitSource& source, detail::Monitor& monitor, Flow& flow) {
  const unsigned threads = monitor.threads();
  CellFits fits(source.cells.cellCount(), threads);
  const UniformFits uniform(source, threads);
  const std::vector<uint32_t> others = uniform.otherCells();
  const FitData data = fitData(source, &others, {}, threads);
  const std::vector<double> values = fitValues(source, data, flow.phi, threads);
  const std::vector<uint32_t> cubic = cubicCells(source, others, true);
  std::vector<uint32_t> square;
  std::set_difference(others.begin(), others.end(), cubic.begin(), cubic.end(), std::back_inserter(square));
  fitCells(source.cells, square, {data, values, source.problem.source}, monitor, fits);
  CubicFitter(source, data, cubic, false, monitor).fit({data, values, source.problem.source}, monitor, fits);
  uniform.fit(flow.phi, threads, fits);
  flow.cellVelocity = std::move(fits.gradient);
  flow.cellGradient = std::move(fits.second);
}

}  // namespace mandoline::physics
