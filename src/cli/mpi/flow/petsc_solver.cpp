#include "cli/mpi/flow/petsc_solver.h"

#include <petscksp.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>

namespace mandoline::cli {
namespace {

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc failed: ") + (text ? text : "error " + std::to_string(code)));
}

PetscInt index(int64_t i) {
  if (i > int64_t(std::numeric_limits<PetscInt>::max())) throw std::runtime_error("the cells are more than this PETSc counts");
  return PetscInt(i);
}

}  // namespace

struct PetscSolver::Data {
  /// Signals are the program's own, and an error is told once.
  struct Session {
    Session() {
      check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
      check(PetscInitializeNoArguments());
      check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    }
    ~Session() { PetscFinalize(); }
  };

  Data(MPI_Comm comm_, const RankRows& rows, std::function<void()> onIteration_)
      : comm(comm_), onIteration(std::move(onIteration_)), count(index(int64_t(rows.rowOffsets.size()) - 1)) {
    makeMatrix(rows);
    check(MatCreateVecs(matrix, &x, &b));
    if (rows.nullCount > 0) setNullSpace(rows);
    check(KSPCreate(comm, &ksp));
    check(KSPSetOperators(ksp, matrix, matrix));
    check(KSPSetType(ksp, KSPCG));
    check(KSPSetNormType(ksp, KSP_NORM_NATURAL));  // a residual of small cells counts in it
    PC pc;
    check(KSPGetPC(ksp, &pc));
    check(PCSetType(pc, PCGAMG));
    check(KSPMonitorSet(ksp, monitor, this, nullptr));
    check(KSPSetFromOptions(ksp));
  }

  ~Data() {
    KSPDestroy(&ksp);
    VecDestroy(&x);
    VecDestroy(&b);
    MatDestroy(&matrix);
  }

  void makeMatrix(const RankRows& rows) {
    std::vector<PetscInt> offsets, columns;
    for (const int64_t offset : rows.rowOffsets) offsets.push_back(index(offset));
    for (const int64_t column : rows.columns) columns.push_back(index(column));
    check(MatCreateMPIAIJWithArrays(comm, count, count, index(rows.all), index(rows.all), offsets.data(), columns.data(),
                                    rows.values.data(), &matrix));
    check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  }

  /// Vectors of length 1, at right angles to each other since no two have a row in common.
  void setNullSpace(const RankRows& rows) {
    std::vector<Vec> vectors(size_t(rows.nullCount), nullptr);
    for (int32_t v = 0; v < rows.nullCount; ++v) {
      check(VecDuplicate(x, &vectors[size_t(v)]));
      PetscScalar* values = nullptr;
      check(VecGetArray(vectors[size_t(v)], &values));
      for (PetscInt i = 0; i < count; ++i) values[i] = rows.nullVectors[size_t(i)] == v;
      check(VecRestoreArray(vectors[size_t(v)], &values));
      check(VecNormalize(vectors[size_t(v)], nullptr));
    }
    MatNullSpace space = nullptr;
    check(MatNullSpaceCreate(comm, PETSC_FALSE, PetscInt(rows.nullCount), vectors.data(), &space));
    check(MatSetNullSpace(matrix, space));
    check(MatNullSpaceDestroy(&space));
    for (Vec& vector : vectors) check(VecDestroy(&vector));
  }

  /// What it throws waits until PETSc has ended.
  static PetscErrorCode monitor(KSP, PetscInt, PetscReal, void* data) {
    Data& d = *static_cast<Data*>(data);
    try {
      if (d.onIteration) d.onIteration();
    } catch (...) {
      d.thrown = std::current_exception();
      return PETSC_ERR_USER;
    }
    return 0;
  }

  const Session session;
  MPI_Comm comm;
  const std::function<void()> onIteration;
  std::exception_ptr thrown;
  PetscInt count;  // of rows
  Mat matrix = nullptr;
  Vec x = nullptr, b = nullptr;
  KSP ksp = nullptr;
};

PetscSolver::PetscSolver(MPI_Comm comm, const RankRows& rows, std::function<void()> onIteration)
    : data_(std::make_unique<Data>(comm, rows, std::move(onIteration))) {}
PetscSolver::~PetscSolver() = default;

int PetscSolver::solve(const std::vector<double>& rightSide, double tolerance, int maxIterations, std::vector<double>& x) {
  Data& d = *data_;
  PetscScalar* values = nullptr;
  check(VecGetArray(d.b, &values));
  std::copy(rightSide.begin(), rightSide.end(), values);
  check(VecRestoreArray(d.b, &values));
  check(KSPSetTolerances(d.ksp, tolerance, 0, PETSC_DEFAULT, maxIterations));
  const PetscErrorCode code = KSPSolve(d.ksp, d.b, d.x);
  if (d.thrown) std::rethrow_exception(d.thrown);
  check(code);
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(d.ksp, &iterations));
  check(VecGetArray(d.x, &values));
  x.assign(values, values + d.count);
  check(VecRestoreArray(d.x, &values));
  return int(iterations);
}

}  // namespace mandoline::cli
