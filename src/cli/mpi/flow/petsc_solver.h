// Conjugate gradients of PETSc.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace mandoline::cli {

/// A process's rows of a symmetric, positive semidefinite matrix. Those of each process follow those of the one before.
struct RankRows {
  int64_t all = 0;                  ///< rows of the whole
  std::vector<int64_t> rowOffsets;  ///< into the entries
  std::vector<int64_t> columns;     ///< per entry: of the whole
  std::vector<double> values;       ///< per entry
  /// Per row: which of the vectors of the null space is 1 there, or -1. The others are 0.
  std::vector<int32_t> nullVectors;
  int32_t nullCount = 0;
};

/// Starts PETSc, whose options come from PETSC_OPTIONS, and ends it. All calls are collective. A failure of PETSc is a std::runtime_error,
/// perhaps of one process alone.
class PetscSolver {
 public:
  /// `onIteration` may be null; what it throws ends the iterations, of this process alone.
  PetscSolver(MPI_Comm comm, const RankRows& rows, std::function<void()> onIteration);
  ~PetscSolver();
  PetscSolver(const PetscSolver&) = delete;

  /// Solves for so small a part of the residual, in the norm that the preconditioner makes, or as well as it can. Gives the iterations.
  int solve(const std::vector<double>& rightSide, double tolerance, int maxIterations, std::vector<double>& x);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace mandoline::cli
