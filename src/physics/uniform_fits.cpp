#include "physics/uniform_fits.h"

#include <algorithm>
#include <cmath>

#include "base/large_array.h"
#include "physics/node_loops.h"

namespace mandoline::physics {
namespace {

/// So much may steps between cells differ, relative to them and to where the cells are: little more than both are rounded.
constexpr double kRounding = 1e-11, kRoundingOfCentres = 1e-15;

double signOf(size_t side) { return side % 2 == 1 ? 1 : -1; }

/// Which node is beyond a neighbour: the six straight on come after the six neighbours, then the twelve across an edge of the cell.
size_t nodeBeyond(size_t side, size_t next) {
  if (side == next) return 6 + side;
  const size_t a = std::min(side, next), b = std::max(side, next);
  return 12 + 4 * (a / 2 + b / 2 - 1) + 2 * (a % 2) + b % 2;
}

}  // namespace

UniformFits::UniformFits(const FitSource& source, unsigned threads) : cells_(source.cells), source_(source) {
  findSteps();
  detail::makeLargeOnThreads(neighbors_, cells_.cellCount() - cells_.cutCells, threads);
  forBlocks(neighbors_.size(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) neighbors_[i] = neighborsOf(cells_.cutCells + i);
  });
  findWeights();
}

/// Those of the first octree cell that has neighbours of its size along all axes.
void UniformFits::findSteps() {
  for (size_t c = cells_.cutCells; c < cells_.cellCount(); ++c) {
    Point step{};
    for (const uint32_t h : cells_.halfFaces(c)) {
      const int32_t other = cells_.faceCells[h ^ 1];
      if (other < int32_t(cells_.cutCells) || cells_.cellLevel[size_t(other)] != cells_.cellLevel[c]) continue;
      for (size_t d = 0; d < 3; ++d) {
        const double along = std::fabs(cells_.cellCentre[3 * size_t(other) + d] - cells_.cellCentre[3 * c + d]);
        if (cells_.faceNormal[3 * (h / 2) + d] != 0) step[d] = std::ldexp(along, -cells_.cellLevel[c]);
      }
    }
    if (!(step[0] > 0 && step[1] > 0 && step[2] > 0)) continue;
    step_ = step;
    return;
  }
}

bool UniformFits::isStep(size_t cell, size_t other, size_t side) const {
  const double size = std::ldexp(1.0, cells_.cellLevel[cell]);
  for (size_t d = 0; d < 3; ++d) {
    const double step = d == side / 2 ? signOf(side) * size * step_[d] : 0;
    const double centre = cells_.cellCentre[3 * cell + d], difference = cells_.cellCentre[3 * other + d] - centre - step;
    if (!(std::fabs(difference) <= kRounding * size * step_[side / 2] + kRoundingOfCentres * std::fabs(centre))) return false;
  }
  return true;
}

UniformFits::Neighbors UniformFits::neighborsOf(size_t cell) const {
  Neighbors none, found;
  none.fill(kNone), found.fill(kNone);
  const auto edges = source_.edgesOfCells[cell];
  if (edges.size() != kSides) return none;
  for (const uint32_t e : edges) {
    const auto faces = source_.dual.faces[e];
    if (faces.size() != 1) return none;
    const uint32_t f = faces[0], upper = cells_.faceCells[2 * f] == int32_t(cell) ? 1 : 0;
    const auto other = uint32_t(cells_.faceCells[2 * f + upper]);
    const double* normal = &cells_.faceNormal[3 * f];
    const size_t axis = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2, side = 2 * axis + (normal[axis] > 0 ? upper : 1 - upper);
    if (other < cells_.cutCells || cells_.cellLevel[other] != cells_.cellLevel[cell] || !isStep(cell, other, side)) return none;
    found[side] = other;
  }
  return std::find(found.begin(), found.end(), kNone) == found.end() ? found : none;
}

bool UniformFits::isUniform(size_t cell) const {
  if (!isEven(cell)) return false;
  const Neighbors& around = neighbors_[cell - cells_.cutCells];
  return std::all_of(around.begin(), around.end(), [&](uint32_t other) { return isEven(other); });
}

std::vector<uint32_t> UniformFits::otherCells() const {
  std::vector<uint32_t> others;
  for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
    if (!isUniform(c)) others.push_back(c);
  }
  return others;
}

/// From the equations of a cell at the origin: its own dual edges and those of its neighbours.
void UniformFits::findWeights() {
  const double size = *std::max_element(step_.begin(), step_.end()), origin[3] = {0, 0, 0};
  if (!(size > 0)) return;
  struct Ends {
    size_t from, to;  // nodes; kNodes for the cell itself
  };
  std::vector<FitEquation> equations;
  std::vector<Ends> ends;
  std::vector<double> lengths;
  const auto add = [&](Point at, size_t side, Ends of) {
    const size_t axis = side / 2;
    FitDatum datum{at, {}, step_[axis], step_[(axis + 1) % 3] * step_[(axis + 2) % 3], {}};
    datum.direction[axis] = signOf(side);
    datum.point[axis] += signOf(side) * step_[axis] / 2;
    equations.push_back(equationOf(datum, origin, size, uint32_t(ends.size())));
    ends.push_back(of), lengths.push_back(datum.length);
  };
  for (size_t side = 0; side < kSides; ++side) {
    Point at{};
    add(at, side, {kNodes, side});
    at[side / 2] = signOf(side) * step_[side / 2];
    for (size_t next = 0; next < kSides; ++next) {
      if (next != (side ^ 1)) add(at, next, {side, nodeBeyond(side, next)});
    }
  }
  const FitFactors factors(equations);
  std::array<Row, kNodes + 1> weights{};
  for (const FitEquation& equation : equations) {
    Row right = equation.row;
    for (double& x : right) x *= equation.weight;
    const Row unknowns = factors.solve(right);
    const Ends& of = ends[equation.datum];
    for (size_t i = 0; i < right.size(); ++i) {
      weights[of.to][i] += unknowns[i] / lengths[equation.datum];
      weights[of.from][i] -= unknowns[i] / lengths[equation.datum];
      ofMean_[i] -= unknowns[i] * equation.along * size;
    }
  }
  std::copy(weights.begin(), weights.end() - 1, weights_.begin());
}

std::array<uint32_t, UniformFits::kNodes> UniformFits::nodesOf(size_t cell) const {
  std::array<uint32_t, kNodes> nodes;
  const Neighbors& around = neighbors_[cell - cells_.cutCells];
  for (size_t side = 0; side < kSides; ++side) {
    const Neighbors& beyond = neighbors_[around[side] - cells_.cutCells];
    nodes[side] = around[side];
    nodes[6 + side] = beyond[side];
    for (size_t next = 2 * (side / 2) + 2; next < kSides; ++next) nodes[nodeBeyond(side, next)] = beyond[next];
  }
  return nodes;
}

void UniformFits::fit(const std::vector<double>& phi, unsigned threads, CellFits& fits) const {
  const std::vector<double>& source = source_.problem.source;
  const double gridSize = *std::max_element(step_.begin(), step_.end());
  forBlocks(neighbors_.size(), threads, [&](size_t begin, size_t end) {
    for (size_t c = cells_.cutCells + begin; c < cells_.cutCells + end; ++c) {
      if (!isUniform(c)) continue;
      const std::array<uint32_t, kNodes> nodes = nodesOf(c);
      Row unknowns{};
      for (size_t k = 0; k < kNodes; ++k) {
        const double difference = phi[nodes[k]] - phi[c];
        for (size_t i = 0; i < unknowns.size(); ++i) unknowns[i] += weights_[k][i] * difference;
      }
      const double size = std::ldexp(1.0, cells_.cellLevel[c]), mean = source.empty() ? 0 : source[c] / 3;
      for (size_t i = 0; i < unknowns.size(); ++i) unknowns[i] = unknowns[i] / size + mean * size * ofMean_[i];
      fits.set(c, unknowns, size * gridSize, mean);
    }
  });
}

}  // namespace mandoline::physics
