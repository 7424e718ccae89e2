#include <algorithm>
#include <cmath>
#include <string>

#include "operators/require_cut_mesh.h"
#include "physics/dual_edges.h"
#include "physics/poisson_problem.h"
#include "physics/sparse.h"

namespace mandoline {
namespace physics {

/// Centroids and normals come from products of four lengths, which have to fit into doubles.
static void requireLengths(const CellComplex& cells) {
  constexpr double kSmallest = 1e-70, kLargest = 1e70;
  double size = 0;
  for (size_t i = 3; i < cells.positions.size(); ++i) size = std::max(size, std::fabs(cells.positions[i] - cells.positions[i % 3]));
  if (size == 0 || (size >= kSmallest && size <= kLargest)) return;
  operators::refuse("The cells must be between 1e-70 and 1e70 in size, the range in which doubles can compute on them.");
}

void requireProblem(const CellComplex& cells, const PoissonProblem& problem) {
  requireLengths(cells);
  const Boundary& boundary = problem.boundary;
  requireBoundary(boundary, cells);
  const size_t count = boundary.halfFaces.size(), expected = boundaryOf(cells).halfFaces.size();
  if (count != expected) {
    operators::refuse("The boundary has " + std::to_string(count) + " half-faces, that of these cells has " + std::to_string(expected) +
                      ".");
  }
  for (size_t b = 0; b < boundary.value.size(); ++b) {
    if (!std::isfinite(boundary.value[b]))
      operators::refuse("The value of half-face " + std::to_string(boundary.halfFaces[b]) + " is not finite.", boundary.halfFaces[b]);
  }
  if (!problem.source.empty() && problem.source.size() != cells.cellCount())
    operators::refuse("There are " + std::to_string(cells.cellCount()) + " cells, but another number of sources.");
  for (size_t c = 0; c < problem.source.size(); ++c) {
    if (!std::isfinite(problem.source[c])) operators::refuse("The source of cell " + std::to_string(c) + " is not finite.", int64_t(c));
  }
}

std::vector<double> dirichletCoefficients(const CellComplex& cells, const PoissonProblem& problem) {
  const Boundary& boundary = problem.boundary;
  std::vector<double> coefficients(boundary.halfFaces.size());
  for (size_t b = 0; b < coefficients.size(); ++b) {
    const size_t h = boundary.halfFaces[b], f = h / 2, c = size_t(cells.faceCells[h]);
    const double area = cells.faceArea[f];
    if (boundary.condition[b] != Condition::dirichlet || !(area > 0)) continue;
    const bool onSurface = cells.faceTag[f] == FaceTag::surface;
    const std::vector<double>& points = pointsOf(cells, onSurface ? DualPoints::centroids : problem.dualPoints);
    double along = 0, square = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double difference = cells.faceCentroid[3 * f + d] - points[3 * c + d];
      along += (h % 2 == 0 ? 1 : -1) * cells.faceNormal[3 * f + d] * difference;
      square += difference * difference;
    }
    // The last one keeps slivers, whose centroids may round onto the face, finite.
    coefficients[b] = area / std::max({along, std::sqrt(square) / 20, 1e-9 * std::sqrt(area)});
  }
  return coefficients;
}

std::vector<char> heldComponents(const CellComplex& cells, const Boundary& boundary, const CellComponents& components) {
  std::vector<char> held(components.count);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    if (boundary.condition[b] == Condition::dirichlet && cells.faceArea[h / 2] > 0)
      held[components.cellComponent[size_t(cells.faceCells[h])]] = 1;
  }
  return held;
}

}  // namespace physics

namespace {

SparseMatrix nullSpaceOf(const CellComplex& cells, const Boundary& boundary) {
  const CellComponents components = cellComponents(cells);
  const std::vector<char> held = physics::heldComponents(cells, boundary, components);
  std::vector<int> column(components.count, -1);
  int columns = 0;
  for (uint32_t r = 0; r < components.count; ++r) {
    if (!held[r]) column[r] = columns++;
  }
  physics::Triplets entries;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const int k = column[components.cellComponent[c]];
    if (k >= 0) entries.emplace_back(int(c), k, 1);
  }
  return physics::assemble(cells.cellCount(), size_t(columns), entries);
}

}  // namespace

PoissonSystem poissonSystem(const CellComplex& cells, const PoissonProblem& problem) {
  physics::requireProblem(cells, problem);
  const Boundary& boundary = problem.boundary;
  const std::vector<double> coefficients = physics::dirichletCoefficients(cells, problem);
  PoissonSystem system;
  system.rhs.resize(cells.cellCount());
  for (size_t c = 0; c < problem.source.size(); ++c) system.rhs[c] = -problem.source[c] * cells.cellVolume[c];
  physics::Triplets entries;
  physics::addLaplacian(cells, physics::dualEdges(cells, problem.dualPoints), -1, entries);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    const int32_t c = cells.faceCells[h];
    const bool isNeumann = boundary.condition[b] == Condition::neumann;
    system.rhs[size_t(c)] += (isNeumann ? cells.faceArea[h / 2] : coefficients[b]) * boundary.value[b];
    if (!isNeumann) entries.emplace_back(c, c, coefficients[b]);
  }
  system.matrix = physics::assemble(cells.cellCount(), cells.cellCount(), entries);
  system.nullSpace = nullSpaceOf(cells, boundary);
  return system;
}

}  // namespace mandoline
