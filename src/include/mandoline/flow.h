// Potential flow of a wind through the cells of a complex and about the surface (paper, appendix B, figure 22), its velocity at any point,
// and streamlines: library mandoline::operators.
#pragma once

#include <array>

#include "mandoline/poisson.h"

namespace mandoline {

struct FlowOptions : RunOptions {
  double tolerance = 1e-10;  ///< as in SolveOptions
  int maxIterations = 500;
};

/// A flow without rotation or sources: its velocity is the gradient of phi. Velocities are in the unit of the wind.
struct Flow {
  SolveStatus status = SolveStatus::converged;
  std::vector<double> residuals;  ///< as in Solution
  std::array<double, 3> wind{};
  std::vector<double> phi;           ///< per cell, at its centre; in each component of cellComponents() with the mean zero by volume
  std::vector<double> faceVelocity;  ///< per face: the mean component along its normal; times faceArea what flows through
  std::vector<double> cellVelocity;  ///< 3 per cell, at its centroid
  /// 6 per cell: how the velocity changes in it, as the symmetric matrix xx, yy, zz, xy, yz, xz, whose trace is zero
  std::vector<double> cellGradient;
  std::vector<double> cellPressure;  ///< per cell, at its centroid: the pressure coefficient 1 - |velocity|^2 / |wind|^2
  /// Components where the wind would bring more into the box than it takes out, or less; ascending. See solveFlow().
  std::vector<uint32_t> throttled;
};

/// Solves div grad phi = 0, where grad phi . N = wind . N on the sides of the box and nothing passes the surface, on either side of it, nor
/// faces that a sub-complex was cut off at. As much flows into a cell as out of it, to the tolerance; what doesn't touch the box is at
/// rest.
///
/// Where the surface divides the box, a component may get more from the wind than it can give away, or less: then the larger of both is
/// scaled down to the other on all its sides, so that nowhere on them it blows faster than the wind. A component that can only take or only
/// give, a dead end, is at rest.
///
/// In a cell the velocity is the gradient of a harmonic polynomial of degree two, fitted to what flows through its faces and those of the
/// cells beside it, but of none that has both sides of a triangle. A uniform flow is exact.
///
/// The result is the same to the bit for any number of threads. Throws CallError if the wind is not finite (badArgument), if an option is
/// out of range (badOption), or if cancelled.
Flow solveFlow(const CellComplex& cells, const std::array<double, 3>& wind, const FlowOptions& options = {});

}  // namespace mandoline
