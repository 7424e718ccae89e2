// What is asked of a problem, and its conditions as numbers.
#pragma once

#include "mandoline/poisson.h"
#include "physics/dual_edges.h"

namespace mandoline::physics {

/// Throws CallError{badArgument} for the boundary of other cells, and for half-faces (element: their place) that are none of theirs.
void requireBoundary(const Boundary& boundary, const CellComplex& cells);

/// What values of cells are called: "The phi of cell 3 to start from".
struct CellValuesName {
  const char *all, *one, *after = "";
};

// These throw CallError{badArgument}, too.
void requireProblem(const CellComplex& cells, const PoissonProblem& problem);
/// That there are so many per cell, all finite.
void requireCellValues(const CellComplex& cells, std::span<const double> values, const CellValuesName& name, size_t perCell = 1);
void requireSources(const CellComplex& cells, std::span<const double> source);
void requireValues(const Boundary& boundary, std::span<const double> values);

/// What a half-face of the boundary adds to the equation of its cell: the flow into it is perValue * value - perPhi * phi.
struct BoundaryTerm {
  double perPhi = 0;    ///< 0 unless phi is held
  double perValue = 0;  ///< `flow` of a Neumann condition, over distance of a Dirichlet condition, and between for a Robin condition
  double distance = 0;  ///< over which the condition acts, if phi is held
  double flow = 0;      ///< per derivative: area times coefficient
};

/// Per half-face of the boundary.
MANDOLINE_SHARED std::vector<BoundaryTerm> boundaryTerms(const CellComplex& cells, const PoissonProblem& problem);

/// Per cell: its volume times its mass.
std::vector<double> massTerms(const CellComplex& cells, const PoissonProblem& problem);

/// Per component whether phi is held anywhere.
std::vector<char> heldComponents(const CellComplex& cells, const PoissonProblem& problem, const CellComponents& components);

/// Per cell: what conditions on the boundary add to the diagonal. `terms`: boundaryTerms().
std::vector<double> heldTerms(const CellComplex& cells, const Boundary& boundary, const std::vector<BoundaryTerm>& terms);
/// The sum of both, per cell: `held`: heldTerms(), `mass`: massTerms().
std::vector<double> addedTerms(std::vector<double> held, const std::vector<double>& mass);
/// Its right side, for sources and values of the boundary as in PoissonData.
MANDOLINE_SHARED std::vector<double> rightSide(const CellComplex& cells, const Boundary& boundary, const std::vector<BoundaryTerm>& terms,
                                               const PoissonData& data);
/// Its null space. `held`: heldComponents().
CsrMatrix nullSpaceOf(const CellComponents& components, const std::vector<char>& held);

}  // namespace mandoline::physics
