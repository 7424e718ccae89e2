#include "cut/stages/input.h"

#include <cmath>
#include <string>

#include "cut/corner_winding.h"

namespace mandoline::detail {
namespace {

[[noreturn]] void fail(Status status, int64_t element, const std::string& message) { throw Failure{{status, element, -1, message}}; }

const char* const kAxisNames[3] = {"x", "y", "z"};

/// The planes along an axis, scaled.
std::vector<double> scalePlanes(const Grid& grid, int axis, const Scale& scale, uint32_t& flushed) {
  std::vector<double> planes;
  for (const double x : grid.planes[size_t(axis)]) {
    planes.push_back(scale.scaled(x, flushed));
    const size_t i = planes.size() - 1;
    if (i == 0 || planes[i - 1] < planes[i]) continue;
    fail(Status::badGrid, axis,
         std::string("The grid's ") + kAxisNames[axis] + " axis has planes too close for their size (" + std::to_string(i - 1) + " and " +
             std::to_string(i) + ").");
  }
  return planes;
}

double cellsPerUnit(const std::vector<double>& planes) { return double(planes.size() - 1) / (planes.back() - planes.front()); }

/// The slab of a coordinate: a guess that is right for uniform grids, and a binary search where it is not.
int32_t locate(const std::vector<double>& planes, double perCell, double x) {
  const int32_t n = int32_t(planes.size()) - 1;
  if (x < planes[0]) return -1;
  if (x > planes[n]) return 2 * n + 1;
  int32_t c = int32_t(std::clamp((x - planes[0]) * perCell, 0.0, double(n - 1)));
  if (!(planes[c] <= x && x < planes[c + 1])) c = int32_t(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin()) - 1;
  return 2 * c + (x == planes[c] ? 0 : 1);
}

/// The slab of a made vertex, among the planes that its approximate coordinate leaves.
int32_t locateMade(const MeshPoints& points, VertexId v, int axis, const std::vector<double>& planes, Predicates& predicates) {
  const Bounded x = points.approximate(v.number, axis);
  int32_t plane = int32_t(std::lower_bound(planes.begin(), planes.end(), x.value - 2 * x.error) - planes.begin());
  for (; plane < int32_t(planes.size()); ++plane) {
    const int order = points.compareWith(v.number, axis, planes[size_t(plane)], predicates);
    if (order == 0) return 2 * plane;
    if (order < 0) break;
  }
  return 2 * plane - 1;
}

/// Whether all vertices lie beyond the lowest plane of an axis: then nothing winds around the grid's lowest corner.
bool areBeyondLowest(const IdVector<VertexId, Slab>& slabs) {
  Slab least{1, 1, 1};
  for (const Slab& slab : slabs) {
    for (size_t d = 0; d < 3; ++d) least[d] = std::min(least[d], slab[d]);
  }
  return least[0] > 0 || least[1] > 0 || least[2] > 0;
}

}  // namespace

std::array<std::vector<double>, 3> scaledPlanes(const Grid& grid, const Scale& scale, uint32_t& flushed) {
  return {scalePlanes(grid, 0, scale, flushed), scalePlanes(grid, 1, scale, flushed), scalePlanes(grid, 2, scale, flushed)};
}

SlabFinder::SlabFinder(const std::array<std::vector<double>, 3>& planes) : planes_(planes) {
  for (size_t d = 0; d < 3; ++d) perCell_[d] = cellsPerUnit(planes[d]);
}

Slab SlabFinder::find(const Point& p) const {
  Slab slab;
  for (size_t d = 0; d < 3; ++d) slab[d] = locate(planes_[d], perCell_[d], p[d]);
  return slab;
}

void checkGrid(const Grid& grid, double snapTolerance) {
  if (!(snapTolerance >= 0 && snapTolerance < 0.5)) fail(Status::badOption, -1, "snapTolerance must be at least 0 and below 0.5.");
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& planes = grid.planes[d];
    const std::string axis = std::string("The grid's ") + kAxisNames[d] + " axis";
    if (planes.size() < 2) fail(Status::badGrid, d, axis + " has no cells.");
    if (planes.size() > (size_t(1) << 24) + 1) fail(Status::gridTooLarge, d, axis + " has more than 2^24 cells.");
    for (size_t i = 0; i < planes.size(); ++i) {
      if (!std::isfinite(planes[i])) fail(Status::badGrid, d, axis + " has a plane that is not finite (" + std::to_string(i) + ").");
      if (i > 0 && !(planes[i - 1] < planes[i])) {
        fail(Status::badGrid, d, axis + " has planes that do not ascend (" + std::to_string(i - 1) + " and " + std::to_string(i) + ").");
      }
    }
  }
  if (uint64_t(grid.cells(1)) * uint64_t(grid.cells(2)) > uint64_t(1) << 28) {
    fail(Status::gridTooLarge, -1, "The grid has more than 2^28 rows of cells.");
  }
}

double largestCoordinate(const Grid& grid) {
  double largest = 0;
  for (const auto& planes : grid.planes) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  return largest;
}

Input prepareInput(const Prepared& mesh, const Grid& grid, Run& run, const KnownSlabs* known) {
  Input input;
  input.mesh = &mesh;
  input.planes = scaledPlanes(grid, Scale(mesh.shift), run.stats.flushedCoordinates);
  const SlabFinder finder(input.planes);
  if (known) {
    const auto before = known->input.slabs.begin();
    input.slabs.assign(before, before + ptrdiff_t(known->moved.size()));
  }
  input.slabs.resize(mesh.points.size());
  const auto chunks = forChunks<Predicates>(mesh.points.size(), run.monitor, [&](Predicates& predicates, size_t begin, size_t end) {
    for (const VertexId v : Ids<VertexId>(begin, end)) {
      if (!mesh.isMade(v)) {
        if (!known || known->moved[v]) input.slabs[v] = finder.find(mesh.point(v));
        continue;
      }
      for (int d = 0; d < 3; ++d)
        input.slabs[v][size_t(d)] = locateMade(mesh.arrangement->points, v, d, input.planes[size_t(d)], predicates);
    }
  });
  for (const Predicates& p : chunks) run.count(p);
  if (areBeyondLowest(input.slabs)) {
    input.cornerWinding.assign(countedOf(mesh).size(), 0);
    return input;
  }
  Predicates predicates;
  input.cornerWinding = windingsBeside({input.planes[0][0], input.planes[1][0], input.planes[2][0]}, mesh, input.triangleIds(), predicates);
  run.count(predicates);
  return input;
}

}  // namespace mandoline::detail
