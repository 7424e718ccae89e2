// Poisson's equation div k grad phi - m phi = s on a cell complex, where k is 1 and m is 0 if nothing else is given, with conditions on its
// boundary (paper, appendix B): library mandoline::operators.
#pragma once

#include <memory>
#include <span>

#include "mandoline/operators.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// What is given on a half-face of the boundary.
enum class Condition : uint8_t {
  neumann,    ///< the derivative of phi along the normal that points out of the cell is given
  dirichlet,  ///< phi is given
  robin       ///< the same derivative plus a coefficient times phi is given
};

/// The boundary of all cells: each half-face of a cell through which no flux passes to another one, that is, of a face of tag surface or of
/// one with a single cell. A face of a sheet has two, also where both belong to one cell, so that each side has a value of its own. Values
/// may be set; they are read by each call.
struct Boundary {
  std::vector<uint32_t> halfFaces;   ///< ascending
  std::vector<Condition> condition;  ///< per half-face
  std::vector<double> value;         ///< per half-face: the mean of what its condition gives on the face
  std::vector<double> coefficient;   ///< per half-face: that of phi in a Robin condition, at least 0; not read elsewhere
  Fingerprint madeFrom;              ///< of the cell complex

  static void fields(auto& self, const auto& f) {
    f("halfFaces", self.halfFaces);
    f("condition", self.condition);
    f("value", self.value);
    f("coefficient", self.coefficient);
    f("madeFrom", self.madeFrom);
  }
};

/// Everywhere neumann, 0: nothing passes.
Boundary boundaryOf(const CellComplex& cells);

/// Sets all half-faces of a tag.
void setBoundary(Boundary& boundary, const CellComplex& cells, FaceTag tag, Condition condition, double value = 0);
/// The same with a Robin condition.
void setRobin(Boundary& boundary, const CellComplex& cells, FaceTag tag, double coefficient, double value);

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
  /// Where phi is held on the surface, or with a mass, centroids need fewer corrections.
  DualPoints dualPoints = DualPoints::centres;
  /// Per face: k there, above 0, also on the boundary; empty for 1. It may jump from cell to cell: then a face has what lies between, e.g.
  /// the harmonic mean.
  std::vector<double> faceCoefficient;
  std::vector<double> mass;  ///< per cell: the mean of m in it, at least 0; empty for 0
};

/// The system matrix * phi = rhs; both are those of m phi - div k grad phi = -s, integrated over cells. No cell is left out: what holds phi
/// is on the diagonal and in rhs.
struct PoissonSystem {
  /// Cells x cells, symmetric, positive semidefinite: -laplacian(), and more on the diagonal where phi is held. With a coefficient, the
  /// other value where one cell meets smaller ones is the mean of theirs by area times coefficient.
  CsrMatrix matrix;
  std::vector<double> rhs;  ///< per cell
  CsrMatrix nullSpace;      ///< cells x components where phi is held nowhere: 1 for each cell of the component

  static void fields(auto& self, const auto& f) {
    f("matrix", self.matrix);
    f("rhs", self.rhs);
    f("nullSpace", self.nullSpace);
  }
};

/// Dirichlet conditions hold phi, and so do Robin conditions with a coefficient above 0, and mass. Conditions act over the distance along
/// the normal between the face's centroid and the cell's dual point, or, on the surface, the cell's centroid; at least a twentieth of the
/// distance itself. Of first order; solvePoisson() corrects it. Throws CallError{badArgument} for a boundary that is not that of `cells`,
/// for arrays of other lengths, for a value of a half-face, a source or mass of a cell or a coefficient of a face (element) that is not
/// finite or out of range, and if the cells together are smaller than 1e-70 or larger than 1e70.
PoissonSystem poissonSystem(const CellComplex& cells, const PoissonProblem& problem);

/// What makes phi unique in a component where it is held nowhere.
enum class FreeConstant : uint8_t {
  zeroMean,  ///< phi has the mean zero by volume
  pinned     ///< phi of the component's first cell is zero
};

struct SolveOptions : RunOptions {
  double tolerance = 1e-10;  ///< of the residual, relative to the right side, both in the Euclidean norm
  int maxIterations = 500;
  /// How often at most to solve again with derivatives of second order at cut-cells, at sides of octree cells that meet smaller ones, and
  /// where phi is held, until less than a 30,000th of what they lacked is missing: three to six times. 0: phi solves the system of
  /// poissonSystem().
  int corrections = 8;
  FreeConstant freeConstant = FreeConstant::zeroMean;
  /// In a component where phi is held nowhere, sources and inflow have to cancel. False (default): they have to cancel
  /// up to rounding: 1e-9 of the sum of their absolute values there plus 1e-15 of that everywhere; else the data are incompatible. True:
  /// the excess is subtracted, evenly by volume.
  bool balance = false;
};

/// How solving ended. Flows and steps are not unresolved: what passes through faces is known also where phi is not.
enum class SolveStatus : uint8_t {
  converged,
  iterationLimit,  ///< the residual is above the tolerance after maxIterations
  incompatible,    ///< in some components sources and fluxes do not cancel, so nothing solves the system there; elsewhere it is solved
  unresolved,      ///< solved, but rounding errors of what is given may make more than a millionth of the range of phi in some cells
  breakdown        ///< numbers, or the differences between them, are too large or too small for doubles; phi is the last that was found
};

/// The status as the word above.
inline const char* name(SolveStatus status) {
  constexpr const char* kNames[] = {"converged", "iterationLimit", "incompatible", "unresolved", "breakdown"};
  return kNames[size_t(status)];
}

/// Whether phi solves the system in all components.
inline bool isSolved(SolveStatus status) { return status == SolveStatus::converged || status == SolveStatus::unresolved; }

/// What solvePoisson() found.
struct Solution {
  SolveStatus status = SolveStatus::converged;
  std::vector<double> phi;        ///< per cell, at its dual point
  std::vector<double> residuals;  ///< before each iteration and after the last, relative as in SolveOptions; the last one is that of phi
  /// Per face of tag inner between two cells: the mean derivative of phi along its normal; 0 for others. With those on the boundary, their
  /// products with areas and coefficients are the fluxes that sources and mass balance in each cell, within the tolerance.
  std::vector<double> faceDerivative;
  std::vector<double> boundaryDerivative;  ///< per half-face of the boundary: the same along the normal that points out of the cell
  /// Components of cellComponents(), ascending, in which sources and fluxes do not cancel: phi is 0 there, and the residuals leave them
  /// out.
  std::vector<uint32_t> incompatible;
  std::vector<double> excess;  ///< per incompatible component: the inflow minus the integral of s
  /// Cells, ascending, in which phi may be wrong by more than a millionth of its range: much flows into them through their faces on the
  /// boundary and out again, and they exchange so little with others that rounding of the difference decides. Thin slivers between
  /// triangles are such, where fluxes through the surface are given that do not vanish; mergeSmallCells() leaves fewer.
  std::vector<uint32_t> unresolved;

  size_t iterations() const { return residuals.empty() ? 0 : residuals.size() - 1; }

  static void fields(auto& self, const auto& f) {
    f("status", self.status);
    f("phi", self.phi);
    f("residuals", self.residuals);
    f("faceDerivative", self.faceDerivative);
    f("boundaryDerivative", self.boundaryDerivative);
    f("incompatible", self.incompatible);
    f("excess", self.excess);
    f("unresolved", self.unresolved);
  }
};

/// Solves the problem's system by conjugate gradients, preconditioned by a multigrid, and corrects its right side by what the derivatives
/// in the matrix lack: so phi, and nearly everywhere its derivatives on faces, are of second order also on cut-cells, merged or not, and
/// where octree cells meet smaller ones, unless these are cut (keep a fine layer, see CoarsenOptions). Between octree cells of one size,
/// larger than grid cells, derivatives are of fourth order, if sources and derivatives on the boundary are given as means. What lacks
/// follows from polynomials of degree two, fitted in the cells on both sides of a face. Where coefficients on the faces of a cell differ by
/// more than a half, as they do where k jumps, nothing is corrected on these faces, and the polynomials beside them know nothing of what is
/// behind.
///
/// The result has the same bits for any number of threads. Throws CallError as poissonSystem() does (badArgument), for a tolerance that is
/// not positive or for negative maxIterations or corrections (badOption), or if cancelled.
Solution solvePoisson(const CellComplex& cells, const PoissonProblem& problem, const SolveOptions& options = {});

/// What a PoissonSolver solves for.
struct PoissonData {
  std::span<const double> source;         ///< as in PoissonProblem
  std::span<const double> boundaryValue;  ///< per half-face of the boundary, as in Boundary; empty for 0
  /// Per cell: a phi that is near the solution, e.g. that of the last time step; empty for 0. Corrections start with what it lacks. One
  /// with a larger residual than 0 has is not used.
  std::span<const double> start;
};

/// Solves one problem for many sources and values on the boundary. The system, the multigrid and, once there are corrections, the fits are
/// made once. Not to be used by two threads at once.
class PoissonSolver {
 public:
  /// The problem's source and boundary values are not used. `cells` have to outlive the solver. `threads`: as in RunOptions, of
  /// what is made here; solve() has its own. Throws CallError as poissonSystem() does.
  PoissonSolver(const CellComplex& cells, PoissonProblem problem, unsigned threads = 0);
  PoissonSolver(PoissonSolver&&) noexcept;
  PoissonSolver& operator=(PoissonSolver&&) noexcept;
  ~PoissonSolver();

  // The system of poissonSystem(), to the bit, for other solvers. With 0 corrections, solve() finds phi of matrix() * phi =
  // rightSide(data), within the tolerance.

  /// As long as the solver lives.
  const CsrMatrix& matrix() const;
  /// `start` is not used. Throws CallError as solve() does.
  std::vector<double> rightSide(const PoissonData& data) const;
  CsrMatrix nullSpace() const;

  /// Without `start` the same as solvePoisson(), to the bit. Throws CallError like that, and for data that are not finite or of other
  /// lengths (badArgument).
  Solution solve(const PoissonData& data, const SolveOptions& options = {});

 private:
  struct Setup;
  std::unique_ptr<Setup> setup_;
};

}  // namespace mandoline
