// Incompressible flow about the surface, step by step: library mandoline::operators.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "mandoline/poisson.h"

namespace MANDOLINE_API mandoline {

struct FlowStepperOptions {
  unsigned threads = 0;  ///< as in RunOptions
  double viscosity = 0;  ///< kinematic. At 0 the flow slips along the surface, otherwise it sticks to it
  double timeStep = 0;   ///< of all steps; 0: it follows from the Courant number
  /// In a step, at most this part of what a cell holds flows out of it. Larger numbers than 0.5 need not be stable.
  double courant = 0.5;
  /// Of the divergence: of what flows into a cell and not out of it, relative to the largest speed of wind and start times the area of a
  /// side of a grid cell.
  double tolerance = 1e-10;
  int maxIterations = 500;  ///< of each solution
  /// As in SolveOptions, but they begin with what the flow before the step lacks, so that more than one hardly helps. With 0 steps are
  /// quicker, and what happens at the surface is of first order.
  int corrections = 1;
};

/// A flow at one time, of a fluid of density 1.
struct UnsteadyFlow {
  double time = 0;
  std::vector<double> faceVelocity;  ///< per face: the mean component along its normal; times faceArea it is the flow through it
  std::vector<double> cellVelocity;  ///< 3 per cell, at its centroid
  std::vector<double> cellPressure;  ///< per cell, at its centroid: that of fluid of density 1; 0 where the flow leaves the box
  Fingerprint madeFrom;              ///< of the cell complex

  static void fields(auto& self, const auto& f) {
    f("time", self.time);
    f("faceVelocity", self.faceVelocity);
    f("cellVelocity", self.cellVelocity);
    f("cellPressure", self.cellPressure);
    f("madeFrom", self.madeFrom);
  }
};

/// What a step took.
struct FlowStep {
  SolveStatus status = SolveStatus::converged;  ///< if it is another one, the flow is still that before the step
  double timeStep = 0;
  double courant = 0;     ///< the largest number of a cell
  double divergence = 0;  ///< after the step: the largest of a cell, relative as in FlowStepperOptions
  size_t iterations = 0;  ///< of all solutions

  static void fields(auto& self, const auto& f) {
    f("status", self.status);
    f("timeStep", self.timeStep);
    f("courant", self.courant);
    f("divergence", self.divergence);
    f("iterations", self.iterations);
  }
};

/// What the flow does to a part of the surface.
struct SurfaceForce {
  std::array<double, 3> pressure{};  ///< the force of the pressure
  std::array<double, 3> viscous{};   ///< that of the viscosity
  std::array<double, 3> moment{};    ///< of both, about a point

  static void fields(auto& self, const auto& f) {
    f("pressure", self.pressure);
    f("viscous", self.viscous);
    f("moment", self.moment);
  }
};

/// Solves the incompressible Navier-Stokes equations, or Euler's without viscosity, on merged cells (see mergeSmallCells(); on others steps
/// have to be tiny). Unite their walls, too: then a step is quicker.
///
/// The wind enters through the sides of the box that it blows against, and leaves, at pressure 0, through those opposite, as in
/// solveFlow(); what comes back in there has the speed of the wind. Along other sides the flow slips, and so it does where a sub-complex
/// was cut off. Where the surface divides the box, the wind is throttled as by solveFlow(); a component without inflow or outflow starts at
/// rest.
///
/// A step is of second order in time: backward differences of two steps (BDF2), in which advection is extrapolated, viscosity is implicit,
/// and the pressure makes the fluxes free of divergence in every cell; both sides of a sheet are apart. Advection is
/// conservative and of second order: linear in each cell, and limited where it would pass its neighbours' values (monotonized central
/// differences, van Leer 1977). The pressure and the velocities in cells are collocated (approximate projection, Almgren et al. 1998;
/// Popinet 2003). There are no turbulence models.
///
/// The result is the same to the bit for any number of threads.
class FlowStepper {
 public:
  /// The wind blows at time 0 as the potential flow about the surface. `cells` have to outlive the stepper. Throws CallError for a wind
  /// that is not finite (badArgument), if an option is out of range (badOption), or as poissonSystem() does.
  FlowStepper(const CellComplex& cells, const std::array<double, 3>& wind, const FlowStepperOptions& options = {});
  FlowStepper(FlowStepper&&) noexcept;
  FlowStepper& operator=(FlowStepper&&) noexcept;
  ~FlowStepper();

  /// Starts again at time 0, from velocities at the cells' centroids, 3 per cell, less what makes them diverge. Throws
  /// CallError{badArgument} for another length or a number that is not finite (element: the cell).
  void start(std::span<const double> cellVelocity);

  /// Where nothing moves an automatic step has no length; its status is breakdown. So is that of steps which were too long for a flow to
  /// stay finite.
  FlowStep step();

  const UnsteadyFlow& flow() const;

  /// Per group: what the flow did to the surface in the last step. `faceGroup`: per face its group; empty for one group. Moments are about
  /// `centre`. Throws CallError{badArgument} for another length.
  std::vector<SurfaceForce> forces(std::span<const uint32_t> faceGroup = {}, const std::array<double, 3>& centre = {}) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Per face: the group of its triangle, 0 for others. `cells` are all of the cut-mesh's, merged or not; `triangleGroup` has one per
/// triangle of the input, e.g. TriangleGroups::triangleGroup. Throws CallError{badArgument} if they don't belong together.
std::vector<uint32_t> faceGroups(const CutMesh& cutMesh, const CellComplex& cells, std::span<const uint32_t> triangleGroup);

}  // namespace mandoline
