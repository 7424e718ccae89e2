// Poisson's equation div grad phi = s on a cell complex, with conditions on its boundary (paper, appendix B): library mandoline::operators.
#pragma once

#include "mandoline/operators.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// What is given on a half-face of the boundary.
enum class Condition : uint8_t {
  neumann,   ///< the derivative of phi along the normal that points out of the cell is given
  dirichlet  ///< phi is given
};

/// The boundary of all cells: each half-face of a cell through which no flux passes to another one, that is, of a face of tag surface or of
/// one with a single cell. A face of a sheet has two, also where both belong to one cell, so that each side has a value of its own. Values
/// may be set; they are read by each call.
struct Boundary {
  std::vector<uint32_t> halfFaces;   ///< ascending
  std::vector<Condition> condition;  ///< per half-face
  std::vector<double> value;         ///< per half-face: the mean of what its condition gives on the face
  Fingerprint madeFrom;              ///< of the cell complex

  static void fields(auto& self, const auto& f) {
    f("halfFaces", self.halfFaces);
    f("condition", self.condition);
    f("value", self.value);
    f("madeFrom", self.madeFrom);
  }
};

/// Everywhere neumann, 0: nothing passes.
Boundary boundaryOf(const CellComplex& cells);

/// Sets all half-faces of a tag.
void setBoundary(Boundary& boundary, const CellComplex& cells, FaceTag tag, Condition condition, double value = 0);

/// 3 per half-face of the boundary: the unit normal that points out of the cell. The Neumann values of phi = U . x, or of a wind U that
/// blows through, are its products with U.
std::vector<double> outwardNormals(const Boundary& boundary, const CellComplex& cells);

/// Which cells are connected through inner faces. For whole regions these are the regions.
struct CellComponents {
  std::vector<uint32_t> cellComponent;  ///< per cell; components are in the order of their first cells
  uint32_t count = 0;                   ///< of components

  static void fields(auto& self, const auto& f) {
    f("cellComponent", self.cellComponent);
    f("count", self.count);
  }
};
CellComponents cellComponents(const CellComplex& cells);

struct PoissonProblem {
  Boundary boundary;
  std::vector<double> source;  ///< per cell: the mean of s in it, e.g. s at its centroid; empty for 0
  DualPoints dualPoints = DualPoints::centres;
};

/// The system matrix * phi = rhs; both are those of -div grad phi = -s, integrated over cells.
struct PoissonSystem {
  SparseMatrix matrix;      ///< cells x cells, symmetric, positive semidefinite: -laplacian(), and more on the diagonal of Dirichlet cells
  std::vector<double> rhs;  ///< per cell
  SparseMatrix nullSpace;   ///< cells x components without a Dirichlet condition: 1 for each cell of the component

  static void fields(auto& self, const auto& f) {
    f("matrix", self.matrix);
    f("rhs", self.rhs);
    f("nullSpace", self.nullSpace);
  }
};

/// A Dirichlet condition acts over the distance along the normal between the face's centroid and the cell's dual point, or, on the surface,
/// the cell's centroid; at least a twentieth of the distance itself. First order on the surface: with DualPoints::centres phi lies
/// elsewhere.
/// Throws CallError{badArgument} for a boundary that is not that of `cells`, for arrays of other lengths, for values that are not finite,
/// and if the cells together are smaller than 1e-70 or larger than 1e70.
PoissonSystem poissonSystem(const CellComplex& cells, const PoissonProblem& problem);

/// What makes phi unique in a component without a Dirichlet condition.
enum class FreeConstant : uint8_t {
  zeroMean,  ///< phi has the mean zero by volume
  pinned     ///< phi of the component's first cell is zero
};

struct SolveOptions : RunOptions {
  double tolerance = 1e-10;  ///< of the residual, relative to the right side, both in the Euclidean norm
  int maxIterations = 500;
  FreeConstant freeConstant = FreeConstant::zeroMean;
  /// In a component without a Dirichlet condition, sources and inflow have to cancel. False (default): they have to cancel
  /// up to rounding: 1e-9 of the sum of their absolute values there plus 1e-15 of that everywhere; else the data are incompatible. True:
  /// the excess is subtracted, evenly by volume.
  bool balance = false;
};

/// How solving ended.
enum class SolveStatus : uint8_t {
  converged,
  iterationLimit,  ///< the residual is above the tolerance after maxIterations
  incompatible,    ///< in some components sources and fluxes do not cancel, so nothing solves the system there; elsewhere it is solved
  breakdown        ///< numbers, or the differences between them, are too large or too small for doubles; phi is the last that was found
};

/// The status as the word above.
inline const char* name(SolveStatus status) {
  constexpr const char* kNames[] = {"converged", "iterationLimit", "incompatible", "breakdown"};
  return kNames[size_t(status)];
}

/// What solvePoisson() found.
struct Solution {
  SolveStatus status = SolveStatus::converged;
  std::vector<double> phi;        ///< per cell, at its dual point
  std::vector<double> residuals;  ///< before each iteration and after the last, relative as in SolveOptions; the last one is that of phi
  /// Components of cellComponents(), ascending, in which sources and fluxes do not cancel: phi is 0 there, and the residuals leave them
  /// out.
  std::vector<uint32_t> incompatible;
  std::vector<double> excess;  ///< per incompatible component: the inflow minus the integral of s

  size_t iterations() const { return residuals.empty() ? 0 : residuals.size() - 1; }

  static void fields(auto& self, const auto& f) {
    f("status", self.status);
    f("phi", self.phi);
    f("residuals", self.residuals);
    f("incompatible", self.incompatible);
    f("excess", self.excess);
  }
};

/// Solves the problem's system by conjugate gradients, preconditioned by a multigrid. Runs on one thread, so the result has the same bits
/// for any number. Throws CallError as poissonSystem() does (badArgument), for a tolerance that is not positive or a negative maxIterations
/// (badOption), or if cancelled.
Solution solvePoisson(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options = {});

}  // namespace mandoline
