// The system of a potential flow, of which each of several processes has the rows of its own cells.
#pragma once

#include <functional>
#include <optional>

#include "cli/mpi/flow/halo.h"
#include "cli/mpi/flow/petsc_solver.h"
#include "mandoline/poisson.h"
#include "physics/system_matrix.h"

namespace mandoline::cli {

/// All calls are collective, but for isOwn() and iterations().
class RankSystem {
 public:
  using Vector = std::vector<double>;

  /// Keeps references. `components`: of the whole, per cell of the process. Components that nothing flows through in this problem are left
  /// out of all solutions; with other values on the sides nothing flows through them, either.
  RankSystem(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const CellComponents& components,
             const PoissonProblem& problem);

  Vector rhs;  ///< per cell; that of ghosts is not complete
  Vector phi;  ///< per cell: the solution so far, 0 at first

  bool isOwn(uint32_t cell) const { return complex_.cellRanks[cell] == comm_.rank(); }
  /// Takes away what rounding leaves of the sum of the right side of each component, evenly by volume.
  void balance();
  /// Makes residuals relative to the right side as it is now. Whether that is other than 0.
  bool takeNorm();
  double residual();
  /// Solves for what the residual lacks, again and again, until it is at most `goal` or gets no smaller. `residuals`: the last is
  /// that of phi; those of the passes are appended. Throws as PetscSolver does, whose onIteration is that of the first call.
  SolveStatus solve(double goal, const std::function<void()>& onIteration, Vector& residuals);
  /// Moves phi to the mean zero by volume in each component.
  void setMeans();
  int iterations() const { return iterations_; }  ///< of conjugate gradients, so far

 private:
  template <class Value>
  double sum(const Value& value);
  template <class Value>
  Vector sums(const Value& value);
  RankRows rows();
  void sweep();

  detail::Communicator& comm_;
  const RankComplex& complex_;
  const Halo& halo_;
  const CellComponents& components_;
  std::vector<uint32_t> own_;
  CsrMatrix matrix_;
  Vector added_;
  std::optional<physics::SystemMatrix> system_;
  std::optional<PetscSolver> solver_;
  Vector isActive_;  // per component: more than 0 where something flows
  double norm_ = 0;
  int iterations_ = 0;
};

}  // namespace mandoline::cli
