// Potential flow of a wind through the cells of a complex and about the surface (paper, appendix B, figure 22), its velocity at any point,
// and streamlines: library mandoline::operators.
#pragma once

#include <array>
#include <span>

#include "mandoline/poisson.h"

namespace MANDOLINE_API mandoline {

struct FlowOptions : RunOptions {
  double tolerance = 1e-10;  ///< as in SolveOptions
  int maxIterations = 500;   ///< with farField, of each pass
  int corrections = 8;       ///< as in SolveOptions
  /// False (default): a wind tunnel, through whose sides the wind blows as if nothing were inside. True: unbounded space. Through the sides
  /// passes what would pass there without them: the wind, and what the surface adds to it at a distance. It may not reach the sides.
  bool farField = false;
};

/// A flow without rotation or sources: its velocity is the gradient of phi. Velocities are in the unit of the wind.
struct Flow {
  SolveStatus status = SolveStatus::converged;
  std::vector<double> residuals;  ///< as in Solution; with farField, those of all passes one after the other
  std::array<double, 3> wind{};
  std::vector<double> phi;           ///< per cell, at its centre; its mean by volume is zero in each component of cellComponents()
  std::vector<double> faceVelocity;  ///< per face: the mean component along its normal; times faceArea it is the flow through it
  std::vector<double> cellVelocity;  ///< 3 per cell, at its centroid
  /// 6 per cell: how the velocity changes in it, as the symmetric matrix xx, yy, zz, xy, yz, xz, whose trace is zero
  std::vector<double> cellGradient;
  std::vector<double> cellPressure;  ///< per cell, at its centroid: the pressure coefficient 1 - |velocity|^2 / |wind|^2
  /// Components into which the wind would blow more than it takes out, or less; ascending. See solveFlow().
  std::vector<uint32_t> throttled;
  Fingerprint madeFrom;  ///< of the cell complex

  static void fields(auto& self, const auto& f) {
    f("status", self.status);
    f("residuals", self.residuals);
    f("wind", self.wind);
    f("phi", self.phi);
    f("faceVelocity", self.faceVelocity);
    f("cellVelocity", self.cellVelocity);
    f("cellGradient", self.cellGradient);
    f("cellPressure", self.cellPressure);
    f("throttled", self.throttled);
    f("madeFrom", self.madeFrom);
  }
};

/// Solves div grad phi = 0, where grad phi . N = wind . N on the sides of the box. Nothing flows through the surface, or through faces
/// where a sub-complex was cut off. Within the tolerance, as much flows into a cell as out of it. Components that don't touch the box are
/// at rest.
///
/// Where the surface divides the box, the wind may bring more into a component than it takes out, or less. Then the larger of the two flows
/// is scaled down to the smaller one, so that it is nowhere faster than the wind on the sides of the box. A component with only an inflow
/// or only an outflow, a dead end, is at rest. So is a dead end within a component that only slits lead to: faces with less than a
/// millionth of the area of other faces of their cells.
///
/// With `farField`, the surface disturbs the wind as dipoles on it do: phi times its normal (Green's third identity). They count as one in
/// each block of space; blocks are half as large as the surface's distance from the sides, or a 16th of its longest extent if that is more.
/// Dipoles follow from phi, and phi from them: the problem is solved in passes, at least two, each from the phi of the last, until on the
/// sides they agree within 1e-4 of the wind; the status is iterationLimit if 20 do not do. About a ball that keeps half its diameter from
/// the sides, the fastest flow is within 1 % of that in unbounded space, where a wind tunnel makes it 9 % too fast. Keep the
/// sides at least a tenth of its longest extent away from the surface. As much flows into the box as out of it, within rounding.
///
/// In a cell the velocity is the gradient of a harmonic polynomial of degree two, fitted to the flow through its faces and those of the
/// cells beside it, except cells that have both sides of a triangle. A uniform flow is exact.
///
/// The result is the same to the bit for any number of threads. Throws CallError if the wind is not finite and as poissonSystem() does
/// (badArgument), with farField for a face of the surface (element) that reaches a side (badArgument), if an option is out of range
/// (badOption), or if cancelled.
Flow solveFlow(const CellComplex& cells, const std::array<double, 3>& wind, const FlowOptions& options = {});

/// A flow and what it was solved on; they have to outlive it.
struct FlowField {
  MeshView mesh;  ///< that the cut-mesh was made from
  const CutMesh& cutMesh;
  const CellComplex& cells;  ///< all of the cut-mesh's
  const Flow& flow;
};

/// 3 per point: the velocity there, linear in each cell; NaN outside the grid. `points`: 3 per point, world units. Which cell holds a
/// point, and so which side of a sheet it is on, is decided as cellsAt() does. Throws CallError{badArgument} unless the number of
/// coordinates is a multiple of 3, the field's parts belong together and the flow is finite.
std::vector<double> velocityAt(const FlowField& field, std::span<const double> points);

struct StreamlineOptions : RunOptions {
  bool upstream = false;       ///< against the flow
  double tolerance = 1e-3;     ///< of a step and of its chord, relative to the size of its cell
  double maxLength = 1e300;    ///< of a line, world units
  uint32_t maxPoints = 10000;  ///< of a line
};

/// Where a streamline ends.
enum class StreamlineEnd : uint8_t {
  side,       ///< on a side of the box, exactly
  surface,    ///< at the surface: its last point is before it, by rounding
  rest,       ///< where nothing flows, or faster than doubles can express; or where it goes to and fro, as it may beside the surface
  maxLength,  ///< it has reached that length
  maxPoints,  ///< it has that many points
  outside     ///< its seed is not in the grid; it has no points
};

/// Streamlines, one per seed.
struct Streamlines {
  std::vector<double> points;       ///< 3 per point
  std::vector<double> speeds;       ///< per point
  std::vector<uint32_t> offsets;    ///< into the points, per line
  std::vector<StreamlineEnd> ends;  ///< per line

  static void fields(auto& self, const auto& f) {
    f("points", self.points);
    f("speeds", self.speeds);
    f("offsets", self.offsets);
    f("ends", self.ends);
  }
};

/// Follows the flow from the seeds, 3 coordinates each: Runge-Kutta steps of third order (Bogacki, Shampine 1989) of adaptive length. Each
/// ends in its cell at the latest. No segment of a line meets a triangle of the mesh, by exact predicates (those without area are none),
/// and none leaves the grid. A seed on the surface has a line of one point.
///
/// The result is the same to the bit for any number of threads. Throws CallError as velocityAt() does, if an option is out of range
/// (badOption), if there are 2^32 points or more (meshTooLarge), or if cancelled.
Streamlines streamlines(const FlowField& field, std::span<const double> seeds, const StreamlineOptions& options = {});

/// 3 per seed: `count` points on the sides where the wind enters the box, spread in proportion to the inflow; none without wind. Throws
/// CallError if the wind is not finite (badArgument) or the grid has no cells (badGrid).
std::vector<double> inflowSeeds(const Grid& grid, const std::array<double, 3>& wind, size_t count);

}  // namespace mandoline
