// What is asked of a problem, and its conditions as numbers.
#pragma once

#include "mandoline/poisson.h"

namespace mandoline::physics {

/// Throws CallError{badArgument} for the boundary of other cells, and for half-faces (element: their place) that are none of theirs.
void requireBoundary(const Boundary& boundary, const CellComplex& cells);

/// Throws CallError{badArgument}.
void requireProblem(const CellComplex& cells, const PoissonProblem& problem);

/// Per half-face of the boundary: what a Dirichlet condition adds to the matrix, area over distance; 0 for a Neumann condition.
std::vector<double> dirichletCoefficients(const CellComplex& cells, const PoissonProblem& problem);

/// Per component whether it has a Dirichlet condition.
std::vector<char> heldComponents(const CellComplex& cells, const Boundary& boundary, const CellComponents& components);

}  // namespace mandoline::physics
