#include <algorithm>
#include <cmath>
#include <string>

#include "operators/require_cut_mesh.h"
#include "physics/cell_edges.h"
#include "physics/poisson_problem.h"
#include "physics/sparse.h"

namespace mandoline {
namespace physics {

/// An empty array is none.
static void requireCount(size_t count, size_t expected, const char* elements, const char* values) {
  if (count != 0 && count != expected)
    operators::refuse("There are " + std::to_string(expected) + " " + elements + ", but another number of " + values + ".");
}

void requireProblem(const CellComplex& cells, const PoissonProblem& problem) {
  operators::requireLengths(cells);
  const Boundary& boundary = problem.boundary;
  requireBoundary(boundary, cells);
  const size_t count = boundary.halfFaces.size(), expected = boundaryOf(cells).halfFaces.size();
  if (count != expected) {
    operators::refuse("The boundary has " + std::to_string(count) + " half-faces, that of these cells has " + std::to_string(expected) +
                      ".");
  }
  requireValues(boundary, boundary.value);
  for (size_t b = 0; b < count; ++b) {
    const double coefficient = boundary.coefficient[b];
    if (boundary.condition[b] == Condition::robin && !(coefficient >= 0 && std::isfinite(coefficient)))
      operators::refuse("The coefficient of half-face " + std::to_string(boundary.halfFaces[b]) + " is negative or not finite.",
                        boundary.halfFaces[b]);
  }
  requireSources(cells, problem.source);
  requireCount(problem.faceCoefficient.size(), cells.faceCount(), "faces", "coefficients");
  for (size_t f = 0; f < problem.faceCoefficient.size(); ++f) {
    if (!(problem.faceCoefficient[f] > 0 && std::isfinite(problem.faceCoefficient[f])))
      operators::refuse("The coefficient of face " + std::to_string(f) + " is not positive or not finite.", int64_t(f));
  }
  requireCount(problem.mass.size(), cells.cellCount(), "cells", "masses");
  for (size_t c = 0; c < problem.mass.size(); ++c) {
    if (!(problem.mass[c] >= 0 && std::isfinite(problem.mass[c])))
      operators::refuse("The mass of cell " + std::to_string(c) + " is negative or not finite.", int64_t(c));
  }
}

void requireCellValues(const CellComplex& cells, std::span<const double> values, const CellValuesName& name, size_t perCell) {
  if (values.size() != perCell * cells.cellCount())
    operators::refuse("There are " + std::to_string(cells.cellCount()) + " cells, but another number of " + name.all + ".");
  for (size_t i = 0; i < values.size(); ++i) {
    const size_t c = i / perCell;
    if (std::isfinite(values[i])) continue;
    operators::refuse(std::string("The ") + name.one + " of cell " + std::to_string(c) + name.after + " is not finite.", int64_t(c));
  }
}

void requireSources(const CellComplex& cells, std::span<const double> source) {
  if (!source.empty()) requireCellValues(cells, source, {"sources", "source"});
}

void requireValues(const Boundary& boundary, std::span<const double> values) {
  requireCount(values.size(), boundary.halfFaces.size(), "half-faces of the boundary", "values");
  for (size_t b = 0; b < values.size(); ++b) {
    if (!std::isfinite(values[b]))
      operators::refuse("The value of half-face " + std::to_string(boundary.halfFaces[b]) + " is not finite.", boundary.halfFaces[b]);
  }
}

static double conditionDistance(const CellComplex& cells, DualPoints dualPoints, uint32_t h) {
  const size_t f = h / 2, c = size_t(cells.faceCells[h]);
  const bool onSurface = cells.faceTag[f] == FaceTag::surface;
  const std::vector<double>& points = pointsOf(cells, onSurface ? DualPoints::centroids : dualPoints);
  double along = 0, square = 0;
  for (size_t d = 0; d < 3; ++d) {
    const double difference = cells.faceCentroid[3 * f + d] - points[3 * c + d];
    along += (h % 2 == 0 ? 1 : -1) * cells.faceNormal[3 * f + d] * difference;
    square += difference * difference;
  }
  // The last one keeps slivers, whose centroids may round onto the face, finite.
  return std::max({along, std::sqrt(square) / 20, 1e-9 * std::sqrt(cells.faceArea[f])});
}

std::vector<BoundaryTerm> boundaryTerms(const CellComplex& cells, const PoissonProblem& problem) {
  const Boundary& boundary = problem.boundary;
  std::vector<BoundaryTerm> terms(boundary.halfFaces.size());
  for (size_t b = 0; b < terms.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    const double area = cells.faceArea[h / 2];
    if (!(area > 0)) continue;
    BoundaryTerm& term = terms[b];
    const double flow = problem.faceCoefficient.empty() ? area : problem.faceCoefficient[h / 2] * area;
    term.perValue = term.flow = flow;
    if (boundary.condition[b] == Condition::neumann) continue;
    term.distance = conditionDistance(cells, problem.dualPoints, h);
    if (boundary.condition[b] == Condition::dirichlet) {
      term.perPhi = term.perValue = flow / term.distance;
    } else {
      term.perValue = flow / (1 + boundary.coefficient[b] * term.distance);
      term.perPhi = boundary.coefficient[b] * term.perValue;
    }
  }
  return terms;
}

std::vector<double> massTerms(const CellComplex& cells, const PoissonProblem& problem) {
  std::vector<double> terms(cells.cellCount());
  for (size_t c = 0; c < problem.mass.size(); ++c) terms[c] = problem.mass[c] * cells.cellVolume[c];
  return terms;
}

std::vector<char> heldComponents(const CellComplex& cells, const PoissonProblem& problem, const CellComponents& components) {
  const Boundary& boundary = problem.boundary;
  std::vector<char> held(components.count);
  for (size_t c = 0; c < problem.mass.size(); ++c) {
    if (problem.mass[c] > 0 && cells.cellVolume[c] > 0) held[components.cellComponent[c]] = 1;
  }
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    const Condition condition = boundary.condition[b];
    const bool isHeld = condition == Condition::dirichlet || (condition == Condition::robin && boundary.coefficient[b] > 0);
    if (isHeld && cells.faceArea[h / 2] > 0) held[components.cellComponent[size_t(cells.faceCells[h])]] = 1;
  }
  return held;
}

std::vector<double> heldTerms(const CellComplex& cells, const Boundary& boundary, const std::vector<BoundaryTerm>& terms) {
  std::vector<double> held(cells.cellCount());
  for (size_t b = 0; b < terms.size(); ++b) held[size_t(cells.faceCells[boundary.halfFaces[b]])] += terms[b].perPhi;
  return held;
}

std::vector<double> addedTerms(std::vector<double> held, const std::vector<double>& mass) {
  for (size_t c = 0; c < held.size(); ++c) held[c] += mass[c];
  return held;
}

std::vector<double> rightSide(const CellComplex& cells, const Boundary& boundary, const std::vector<BoundaryTerm>& terms,
                              const PoissonData& data) {
  std::vector<double> rhs(cells.cellCount());
  for (size_t c = 0; c < data.source.size(); ++c) rhs[c] = -data.source[c] * cells.cellVolume[c];
  for (size_t b = 0; b < data.boundaryValue.size(); ++b)
    rhs[size_t(cells.faceCells[boundary.halfFaces[b]])] += terms[b].perValue * data.boundaryValue[b];
  return rhs;
}

CsrMatrix nullSpaceOf(const CellComponents& components, const std::vector<char>& held) {
  CsrMatrix matrix;
  std::vector<int32_t> column(components.count);
  for (uint32_t r = 0; r < components.count; ++r) {
    if (!held[r]) column[r] = int32_t(matrix.columns++);
  }
  for (const uint32_t r : components.cellComponent) {
    if (!held[r]) matrix.entryColumns.push_back(column[r]), matrix.entryValues.push_back(1);
    matrix.rowOffsets.push_back(int64_t(matrix.entryCount()));
  }
  return matrix;
}

}  // namespace physics

PoissonSystem poissonSystem(const CellComplex& cells, const PoissonProblem& problem) {
  physics::requireProblem(cells, problem);
  const physics::DualEdges dual = physics::dualEdges(cells, problem.dualPoints, problem.faceCoefficient);
  const std::vector<physics::BoundaryTerm> terms = physics::boundaryTerms(cells, problem);
  const CellComponents components = cellComponents(cells);
  const std::vector<double> added =
      physics::addedTerms(physics::heldTerms(cells, problem.boundary, terms), physics::massTerms(cells, problem));
  return {physics::laplacianRows(cells, dual, physics::cellEdges(cells, dual, 1), {-1, added}, 1),
          physics::rightSide(cells, problem.boundary, terms, {problem.source, problem.boundary.value, {}}),
          physics::nullSpaceOf(components, physics::heldComponents(cells, problem, components))};
}

}  // namespace mandoline
