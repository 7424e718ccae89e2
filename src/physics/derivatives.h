// The derivatives of phi along the normals of faces: what passes through them, per area.
#pragma once

#include "physics/cell_fitter.h"
#include "physics/poisson_problem.h"

namespace mandoline::physics {

/// Makes the derivatives of a problem's phi: per face along its normal, 0 without a dual edge; then per half-face of the boundary along the
/// normal that points out of the cell.
class MANDOLINE_SHARED Differentiator {
 public:
  /// `terms`: boundaryTerms().
  Differentiator(const FitSource& source, const std::vector<BoundaryTerm>& terms, unsigned threads);

  /// Those that the problem's system has: differences over distances.
  std::vector<double> plain(const std::vector<double>& phi, unsigned threads) const;
  /// The sum of their squares by area and coefficient.
  double squareOfPlain(const std::vector<double>& phi, unsigned threads) const;

  /// What is added to some of those for second order, from polynomials fitted in the cells on both sides: such a derivative is that of the
  /// polynomials in the mean on the face, and what they leave of the difference of phi, over the distance; where the line between two
  /// merged cells is oblique to their face, less of that. In octree cells larger than grid cells, and in those beside larger ones but not
  /// beside cut-cells, polynomials are of degree three, without coefficients; with them they are of degree two everywhere, and between
  /// octree cells of one size what third derivatives add is found from how second ones change. Nothing is added where a cell meets smaller
  /// ones of which some are cut and not merged, or slivers, since that need not converge; nor beside cells where the coefficient jumps.
  std::vector<double> corrections(CellFitter& fitter, const std::vector<double>& phi, detail::Monitor& monitor) const;
  CellFitter fitter(detail::Monitor& monitor) const;

  /// Per correction the derivative that it is added to, ascending.
  const std::vector<uint32_t>& corrected() const { return corrected_; }
  /// A cell beside the face of a derivative.
  size_t cellOf(size_t derivative) const;
  /// The sum of products of corrections by area and coefficient.
  double product(const std::vector<double>& a, const std::vector<double>& b) const;
  /// Adds what flows into each cell by corrections.
  void addFlows(const std::vector<double>& corrections, std::vector<double>& cellValues) const;

 private:
  uint32_t halfFaceOf(size_t derivative) const { return problem_.boundary.halfFaces[derivative - cells_.faceCount()]; }
  double flowOf(size_t derivative) const;
  bool isCorrected(size_t edge) const;
  bool isCorrectedOnBoundary(size_t b) const;
  bool isBetweenEqual(size_t edge) const;
  double plainAt(size_t edge, const std::vector<double>& phi) const;
  double plainOnBoundary(size_t b, const std::vector<double>& phi) const;
  double addedByThirds(size_t edge, const CellFits& fits) const;
  double correctionOf(size_t edge, size_t face, const CellFits& fits, const std::vector<double>& phi) const;
  double correctionOnBoundary(size_t b, const CellFits& fits) const;
  bool jumps(size_t cell) const { return !coefficients_.jumps.empty() && coefficients_.jumps[cell]; }
  std::vector<double> sourceOf(const std::vector<double>& phi, const std::vector<double>& cellSize) const;

  const CellComplex& cells_;
  const DualEdges& dual_;
  const detail::Csr<uint32_t>& edgesOfCells_;
  const PoissonProblem& problem_;
  const std::vector<BoundaryTerm>& terms_;
  CellCoefficients coefficients_;
  std::vector<uint32_t> corrected_;  // derivatives
  std::vector<uint32_t> edges_;      // of those of faces, the dual edge
};

}  // namespace mandoline::physics
