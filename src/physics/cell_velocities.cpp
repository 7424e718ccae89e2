#include "physics/cell_velocities.h"

#include <algorithm>
#include <iterator>

#include "physics/cell_edges.h"
#include "physics/uniform_fits.h"

namespace mandoline::physics {
namespace {

/// Both ascending.
std::vector<uint32_t> without(const std::vector<uint32_t>& cells, const std::vector<uint32_t>& others) {
  std::vector<uint32_t> left;
  std::set_difference(cells.begin(), cells.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

}  // namespace

void fillVelocities(const CellComplex& cells, const PoissonProblem& problem, detail::Monitor& monitor, Flow& flow) {
  const DualEdges dual = dualEdges(cells, problem.dualPoints, {}, monitor.threads());
  fillVelocities({cells, dual, cellEdges(cells, dual, monitor.threads()), problem}, nullptr, monitor, flow);
}

void fillVelocities(const FitSource& source, CellFitter* fitter, detail::Monitor& monitor, Flow& flow) {
  const unsigned threads = monitor.threads();
  const UniformFits uniform(source, threads);
  const std::vector<uint32_t> others = uniform.otherCells(), allCubic = cubicCells(source, others, true);
  std::vector<uint32_t> square = without(others, allCubic), cubic = allCubic;
  if (fitter) {
    fitter->fit(fitValues(source, fitter->data(), flow.phi, threads), source.problem.source, monitor);
    square = without(square, fitter->square()), cubic = without(cubic, fitter->cubic());
  }
  CellFits fits = fitter ? fitter->take() : CellFits(source.cells.cellCount(), threads);
  fits.third.clear(), fits.thirdOf.clear();  // velocities do without
  std::vector<uint32_t> left;
  std::set_union(square.begin(), square.end(), cubic.begin(), cubic.end(), std::back_inserter(left));
  const FitData data = fitData(source, &left, {}, threads);
  const std::vector<double> values = fitValues(source, data, flow.phi, threads);
  const CellFits::Known known{source.cells, data, values, source.problem.source};
  fitCells(square, known, monitor, fits);
  CubicFitter(source, data, cubic, false, monitor).fit(known, monitor, fits);
  uniform.fit(flow.phi, threads, fits);
  flow.cellVelocity = std::move(fits.gradient);
  flow.cellGradient = std::move(fits.second);
}

}  // namespace mandoline::physics
