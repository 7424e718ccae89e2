#include <cmath>

#include "mandoline/cut_mesh.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"
#include "physics/flow_state.h"
#include "physics/poisson_problem.h"
#include "physics/poisson_setup.h"

namespace mandoline {
namespace {

void requireOptions(const std::array<double, 3>& wind, const FlowStepperOptions& options) {
  if (!std::isfinite(std::hypot(wind[0], wind[1], wind[2]))) operators::refuse("The wind is not finite.");
  const auto require = [](bool isGood, const char* message) {
    if (!isGood) throw CallError({Status::badOption, -1, -1, message});
  };
  require(options.viscosity >= 0 && std::isfinite(options.viscosity), "The viscosity is negative or not finite.");
  require(options.timeStep >= 0 && std::isfinite(options.timeStep), "The time step is negative or not finite.");
  require(options.courant > 0 && std::isfinite(options.courant), "The Courant number has to be positive.");
  SolveOptions solving;
  solving.tolerance = options.tolerance;
  solving.maxIterations = options.maxIterations;
  solving.corrections = options.corrections;
  physics::requireOptions(solving);
}

}  // namespace

FlowStepper::FlowStepper(const CellComplex& cells, const std::array<double, 3>& wind, const FlowStepperOptions& options) {
  requireOptions(wind, options);
  state_ = detail::runCall("flow", [&] { return std::make_unique<State>(cells, wind, options); });
}
FlowStepper::FlowStepper(FlowStepper&&) noexcept = default;
FlowStepper& FlowStepper::operator=(FlowStepper&&) noexcept = default;
FlowStepper::~FlowStepper() = default;

void FlowStepper::start(std::span<const double> cellVelocity) {
  physics::requireCellValues(state_->cells(), cellVelocity, {"velocities", "velocity"}, 3);
  detail::runCall("flow", [&] { state_->start({cellVelocity.begin(), cellVelocity.end()}); });
}

FlowStep FlowStepper::step() {
  return detail::runCall("step", [&] { return state_->step(); });
}

const UnsteadyFlow& FlowStepper::flow() const { return state_->flow(); }

std::vector<SurfaceForce> FlowStepper::forces(std::span<const uint32_t> faceGroup, const std::array<double, 3>& centre) const {
  if (!faceGroup.empty() && faceGroup.size() != state_->cells().faceCount())
    operators::refuse("There are " + std::to_string(state_->cells().faceCount()) + " faces, but another number of groups.");
  return state_->forces(faceGroup, centre);
}

std::vector<uint32_t> faceGroups(const CutMesh& cutMesh, const CellComplex& cells, std::span<const uint32_t> triangleGroup) {
  operators::requireCellsOf(cutMesh, cells);
  if (triangleGroup.size() != cutMesh.triangleCount)
    operators::refuse("There are " + std::to_string(cutMesh.triangleCount) + " triangles, but another number of groups.");
  std::vector<uint32_t> groups(cells.faceCount());
  for (size_t f = 0; f < cells.cutFaces; ++f) {
    const uint32_t face = cells.membersOfFace(f)[0];
    if (face >= cutMesh.faceCount()) operators::refuseCells();
    const int32_t triangle = cutMesh.faceTriangle[face];
    if (triangle >= 0) groups[f] = triangleGroup[size_t(triangle)];
  }
  return groups;
}

}  // namespace mandoline
