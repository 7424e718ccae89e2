#include "physics/flow_field.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace physics {

static constexpr const char* kOtherCells = "The flow is one of other cells.";

operators::CutInput requireField(const FlowField& field, std::span<const double> points) {
  const auto& [mesh, cutMesh, cells, flow] = field;
  operators::requireNotEmpty(cutMesh);
  operators::CutInput input(mesh, cutMesh, true);
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

FieldMembers::FieldMembers(const FlowField& field) : cutCells_(field.cutMesh.cellCount()) {
  constexpr uint32_t kNone = ~0u;
  const auto& [mesh, cutMesh, cells, flow] = field;
  cellOf_.assign(std::max(cells.cellCount(), cells.cellMembers.size()), kNone);
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    for (const uint32_t m : cells.membersOfCell(c)) {
      if (m >= cellOf_.size() || cellOf_[m] != kNone) operators::refuseCells();
      cellOf_[m] = c;
    }
  }
  for (size_t d = 0; d < 3; ++d) blocks_.gridCells[d] = int32_t(cutMesh.grid.cells(int(d)));
  for (size_t m = 0; m < cellOf_.size(); ++m) {
    const size_t c = cellOf_[m];
    if (c == kNone) operators::refuseCells();
    const int32_t* at = isCut(m) ? &cutMesh.cellGridCell[3 * m] : &cells.cellCorner[3 * c];
    if (m == 0 || !isCut(m) || !std::equal(at, at + 3, at - 3)) {
      blocks_.cellCorner.insert(blocks_.cellCorner.end(), at, at + 3);
      blocks_.cellLevel.push_back(isCut(m) ? 0 : cells.cellLevel[c]);
      firstMembers_.push_back(uint32_t(m));
    }
    blocksOf_.push_back(uint32_t(blocks_.cellCount() - 1));
  }
  firstMembers_.push_back(uint32_t(cellOf_.size()));
  if (operators::isRefined(cutMesh)) findLevels();
  index_.emplace(blocks_);
}

/// Of the blocks with cut-cells, which may have merged with cells of other sizes. Blocks fill the grid: so one is as large as it can be
/// without those that begin beside it, half-way along its edges.
void FieldMembers::findLevels() {
  constexpr int kMostLevels = 24;
  const auto& size = blocks_.gridCells;
  const auto numberOf = [&](const operators::GridCell& at) {
    return (uint64_t(at[2]) * uint64_t(size[1]) + uint64_t(at[1])) * uint64_t(size[0]) + uint64_t(at[0]);
  };
  detail::RankedSet corners(numberOf({size[0] - 1, size[1] - 1, size[2] - 1}) + 1, blocks_.cellCount());
  for (size_t b = 0; b < blocks_.cellCount(); ++b) corners.insert(numberOf(blocks_.corner(b)));
  corners.rank();
  const auto fills = [&](const operators::GridCell& corner, int level) {
    bool isAlone = true, isInGrid = false;
    for (size_t d = 0; d < 3; ++d) {
      operators::GridCell beside = corner;
      beside[d] += 1 << (level - 1);
      isAlone &= corner[d] % (1 << level) == 0;
      if (beside[d] >= size[d]) continue;
      isInGrid = true;
      isAlone &= corners.rankOf(numberOf(beside)) == detail::RankedSet::kNone;
    }
    return isAlone && isInGrid;
  };
  for (size_t b = 0; b < blocks_.cellCount() && isCut(firstMembers_[b]); ++b) {
    uint8_t& level = blocks_.cellLevel[b];
    while (level < kMostLevels && fills(blocks_.corner(b), level + 1)) ++level;
  }
}

IdRange FieldMembers::in(const operators::GridCell& at) const {
  const int64_t block = index_->find(at, 0);
  if (block < 0) return {0, 0};
  return {firstMembers_[size_t(block)], firstMembers_[size_t(block) + 1]};
}

std::vector<int64_t> membersAt(const FlowField& field, const FieldMembers& members, std::span<const double> points) {
  struct PointInCut {
    uint32_t firstMember, point;
  };
  const Grid& grid = field.cutMesh.grid;
  std::vector<int64_t> result(points.size() / 3, -1);
  std::vector<PointInCut> inCut;
  for (size_t i = 0; i < result.size(); ++i) {
    operators::GridCell at;
    if (!operators::findGridCell(grid, &points[3 * i], at)) continue;
    const IdRange range = members.in(at);
    if (range.size() == 0) operators::refuseCells();
    result[i] = int64_t(range.begin);
    if (members.isCut(range.begin)) inCut.push_back({uint32_t(range.begin), uint32_t(i)});
  }
  detail::sortItems(inCut, [](const PointInCut& a, const PointInCut& b) { return a.firstMember < b.firstMember; });
  const operators::ScaledSpace space(grid);
  operators::Walls walls(field.cutMesh, space);
  std::vector<operators::ScaledPoint> scaled;
  for (size_t begin = 0, end; begin < inCut.size(); begin = end) {
    const uint32_t first = inCut[begin].firstMember;
    const IdRange range = members.in(members.cornerOf(first));
    scaled.clear();
    for (end = begin; end < inCut.size() && inCut[end].firstMember == first; ++end)
      scaled.push_back(space.scaled(&points[3 * size_t(inCut[end].point)]));
    walls.load(range, members.blockSize(first), scaled);
    for (size_t i = begin; i < end; ++i) {
      const uint32_t place = walls.cellAt(scaled[i - begin]);
      result[inCut[i].point] = place == operators::Walls::kNone ? -1 : int64_t(range.begin + place);
    }
  }
  return result;
}

}  // namespace physics

std::vector<double> velocityAt(const FlowField& field, std::span<const double> points) {
  physics::requireField(field, points);
  const physics::FieldMembers members(field);
  const std::vector<int64_t> found = physics::membersAt(field, members, points);
  std::vector<double> result(points.size(), NAN);
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i] < 0) continue;
    const auto v = physics::velocityIn(field.cells, field.flow, members.cellOf(size_t(found[i])), &points[3 * i]);
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
