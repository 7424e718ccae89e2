// What of a problem is made once for all its sources and values, and one solution of it.
#pragma once

#include <optional>

#include "physics/derivatives.h"
#include "physics/free_means.h"
#include "physics/multigrid.h"
#include "physics/system_matrix.h"

namespace mandoline::physics {

struct PoissonSetup {
  /// Throws CallError{badArgument}.
  PoissonSetup(const CellComplex& cells_, PoissonProblem problem_, unsigned threads);
  PoissonSetup(const PoissonSetup&) = delete;

  const CellComplex& cells;
  PoissonProblem problem;  ///< its source and values are those that are solved for
  CellComponents components;
  std::vector<char> held;  ///< heldComponents()
  std::vector<BoundaryTerm> terms;
  DualEdges dual;
  detail::Csr<uint32_t> edgesOfCells;  ///< cellEdges()
  std::vector<double> mass;            ///< massTerms()
  std::vector<double> added;           ///< per cell: what conditions and mass add to the diagonal
  CsrMatrix matrix;
  SweepOrder order;  ///< sweepOrderOf(matrix)
  SystemMatrix system;
  ComponentRuns runs;
  FreeMeans means;
  Multigrid multigrid;
  Differentiator differentiator;
  std::optional<CellFitter> fitter;  ///< once it is needed
};

/// Throws CallError{badOption}.
void requireOptions(const SolveOptions& options);

/// `data` are valid. Tells the monitor of no stage.
Solution solve(PoissonSetup& setup, const PoissonData& data, const SolveOptions& options, detail::Monitor& monitor);
/// As the only stage of a call; `noun` names it as of runCall().
Solution solveOnly(PoissonSetup& setup, const PoissonData& data, const SolveOptions& options, const char* noun);

}  // namespace mandoline::physics
