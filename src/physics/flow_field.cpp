#include "physics/flow_field.h"

#include <algorithm>
#include <cmath>

#include "mandoline/locate.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace physics {

static constexpr const char* kOtherCells = "The flow is one of other cells.";

operators::CutInput requireField(const FlowField& field, std::span<const double> points) {
  const auto& [mesh, cutMesh, cells, flow] = field;
  operators::requireCutMesh(cutMesh);
  operators::CutInput input(mesh, cutMesh);
  operators::requireCellsOf(cutMesh, cells);
  const size_t n = cells.cellCount();
  for (size_t i = 0; i < 3 * n; ++i) {
    if (cells.cellCorner[i] < 0 || cells.cellCorner[i] >= cutMesh.grid.cells(int(i % 3))) operators::refuseCells();
  }
  operators::requireMadeFrom(flow.madeFrom, cells.fingerprint, kOtherCells);
  if (flow.cellVelocity.size() != 3 * n || flow.cellGradient.size() != 6 * n) operators::refuse(kOtherCells);
  const auto isFinite = [](double number) { return std::isfinite(number); };
  const bool isFlow = std::all_of(flow.cellVelocity.begin(), flow.cellVelocity.end(), isFinite) &&
                      std::all_of(flow.cellGradient.begin(), flow.cellGradient.end(), isFinite);
  if (!isFlow) operators::refuse("The flow has a number that is not finite.");
  if (points.size() % 3 != 0) operators::refuse("The points have " + std::to_string(points.size()) + " coordinates, no multiple of 3.");
  return input;
}

FieldMembers membersOf(const FlowField& field) {
  constexpr uint32_t kNone = ~0u;
  const CellComplex& cells = field.cells;
  const size_t cutCells = field.cutMesh.cellCount();
  FieldMembers members;
  members.cellOf.assign(std::max(cells.cellCount(), cells.cellMembers.size()), kNone);
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    for (const uint32_t m : cells.membersOfCell(c)) {
      if (m >= members.cellOf.size() || members.cellOf[m] != kNone) operators::refuseCells();
      members.cellOf[m] = c;
    }
  }
  OctreeCells& octree = members.octree;
  for (size_t d = 0; d < 3; ++d) octree.gridCells[d] = int32_t(field.cutMesh.grid.cells(int(d)));
  for (size_t m = cutCells; m < members.cellOf.size(); ++m) {
    const size_t c = members.cellOf[m];
    for (size_t d = 0; d < 3; ++d) octree.cellCorner.push_back(cells.cellCorner[3 * c + d]);
    octree.cellLevel.push_back(cells.cellLevel[c]);
    octree.cellRegion.push_back(cells.cellRegion[c]);
  }
  return members;
}

std::vector<int64_t> membersAt(const FlowField& field, const FieldMembers& members, std::span<const double> points) {
  const Locations found = cellsAt(field.cutMesh, points);
  std::vector<int64_t> result(found.cell.begin(), found.cell.end());
  for (size_t i = 0; i < result.size(); ++i) {
    if (result[i] >= 0 || found.gridCell[3 * i] < 0) continue;
    const int64_t n = members.octree.find(found.gridCell[3 * i], found.gridCell[3 * i + 1], found.gridCell[3 * i + 2]);
    if (n < 0) operators::refuseCells();
    result[i] = int64_t(field.cutMesh.cellCount()) + n;
  }
  return result;
}

}  // namespace physics

std::vector<double> velocityAt(const FlowField& field, std::span<const double> points) {
  physics::requireField(field, points);
  const physics::FieldMembers members = physics::membersOf(field);
  const std::vector<int64_t> found = physics::membersAt(field, members, points);
  std::vector<double> result(points.size(), NAN);
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i] < 0) continue;
    const auto v = physics::velocityIn(field.cells, field.flow, members.cellOf[size_t(found[i])], &points[3 * i]);
    std::copy(v.begin(), v.end(), &result[3 * i]);
  }
  return result;
}

std::vector<double> inflowSeeds(const Grid& grid, const std::array<double, 3>& wind, size_t count) {
  double inflow[3], all = 0;
  for (size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = grid.planes[d];
    if (!std::isfinite(wind[d])) operators::refuse("The wind is not finite.");
    if (planes.size() < 2 || !(planes.back() - planes.front() > 0 && std::isfinite(planes.back() - planes.front())))
      throw CallError({Status::badGrid, int64_t(d), -1, std::string("The grid has no cells along ") + "xyz"[d] + "."});
  }
  for (size_t d = 0; d < 3; ++d) {
    inflow[d] = std::fabs(wind[d]);
    for (size_t e = 0; e < 3; ++e) inflow[d] *= e == d ? 1 : grid.planes[e].back() - grid.planes[e].front();
    all += inflow[d];
  }
  std::vector<double> seeds;
  if (all > 0) seeds.reserve(3 * count);
  // Points of a plane's R2 sequence (Roberts 2018), which fills it evenly; sides in turns of a sequence of its own.
  constexpr double kSide = 0.6180339887498949, kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  const auto fraction = [](double x) { return x - std::floor(x); };
  for (size_t i = 0; i < count && all > 0; ++i) {
    double side = all * fraction(0.5 + kSide * double(i));
    size_t axis = 0;
    while (axis < 2 && (side >= inflow[axis] || inflow[axis] == 0)) side -= inflow[axis++];
    if (inflow[axis] == 0) axis = inflow[0] > 0 ? 0 : 1;  // by rounding
    const double at[2] = {fraction(0.5 + kFirst * double(i)), fraction(0.5 + kSecond * double(i))};
    for (size_t d = 0; d < 3; ++d) {
      const double low = grid.planes[d].front(), high = grid.planes[d].back();
      seeds.push_back(d == axis ? (wind[d] > 0 ? low : high) : std::clamp(low + at[d == (axis + 1) % 3 ? 0 : 1] * (high - low), low, high));
    }
  }
  return seeds;
}

}  // namespace mandoline
