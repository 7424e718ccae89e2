#include "cut/stages/input.h"

#include <cmath>
#include <string>

namespace mandoline::detail {
namespace {

// Scaled coordinates are below 2^121 and multiples of 2^-133, or 0: degree 7 stays within 2^860 and 2^-931.
constexpr int kLargestExponent = 120;
constexpr double kFlushBelow = 0x1p-80;

[[noreturn]] void fail(Status status, int64_t element, const std::string& message) { throw Failure{{status, element, -1, message}}; }

const char* const kAxisNames[3] = {"x", "y", "z"};

void checkArrays(const MeshView& mesh) {
  if (mesh.positions.size() % 3 != 0) fail(Status::badArrays, -1, "The length of positions is not a multiple of 3.");
  if (mesh.triangles.size() % 3 != 0) fail(Status::badArrays, -1, "The length of triangles is not a multiple of 3.");
  if (mesh.triangles.empty()) fail(Status::emptyMesh, -1, "The mesh has no triangles.");
  if (mesh.triangleCount() >= uint64_t(1) << 31 || mesh.vertexCount() >= uint64_t(1) << 31) {
    fail(Status::meshTooLarge, -1, "The mesh has more than 2^31 triangles or vertices.");
  }
}

void checkGrid(const Grid& grid) {
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

/// Marks referenced tri-vertices.
std::vector<uint8_t> referencedVertices(const MeshView& mesh) {
  std::vector<uint8_t> referenced(mesh.vertexCount(), 0);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t v = mesh.triangles[i];
    if (v >= referenced.size()) {
      fail(Status::badIndex, int64_t(i / 3),
           "Triangle " + std::to_string(i / 3) + " refers to vertex " + std::to_string(v) + ", but there are only " +
               std::to_string(referenced.size()) + ".");
    }
    referenced[v] = 1;
  }
  for (size_t v = 0; v < referenced.size(); ++v) {
    for (int d = 0; d < 3 && referenced[v]; ++d) {
      if (!std::isfinite(mesh.positions[3 * v + d])) {
        fail(Status::nonFiniteCoordinate, int64_t(v), "Vertex " + std::to_string(v) + " has a coordinate that is not finite.");
      }
    }
  }
  return referenced;
}

/// The exponent of the power of two that brings the largest coordinate to kLargestExponent.
int scaleOf(const MeshView& mesh, const Grid& grid, const std::vector<uint8_t>& referenced) {
  double largest = 0;
  for (size_t v = 0; v < referenced.size(); ++v) {
    for (int d = 0; d < 3 && referenced[v]; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * v + d]));
  }
  for (const auto& planes : grid.planes) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  return largest > 0 ? kLargestExponent - std::ilogb(largest) : 0;
}

/// Copies coordinates and planes, scaled by one power of two.
void scale(const MeshView& mesh, const Grid& grid, const std::vector<uint8_t>& referenced, Input& input, CutStats& stats) {
  const int shift = scaleOf(mesh, grid, referenced);
  const double factor[2] = {std::ldexp(1.0, shift / 2), std::ldexp(1.0, shift - shift / 2)};  // a double can't hold 2^1194
  input.unscale[0] = 1 / factor[0];
  input.unscale[1] = 1 / factor[1];
  const auto scaled = [&](double x) {
    x = x * factor[0] * factor[1] + 0.0;  // -0 becomes 0
    if (std::fabs(x) >= kFlushBelow || x == 0) return x;
    ++stats.flushedCoordinates;
    return 0.0;
  };
  for (int d = 0; d < 3; ++d) {
    input.planes[d].resize(grid.planes[d].size());
    for (size_t i = 0; i < grid.planes[d].size(); ++i) {
      input.planes[d][i] = scaled(grid.planes[d][i]);
      if (i > 0 && !(input.planes[d][i - 1] < input.planes[d][i])) {
        fail(Status::badGrid, d,
             std::string("The grid's ") + kAxisNames[d] + " axis has planes too close for their size (" + std::to_string(i - 1) + " and " +
                 std::to_string(i) + ").");
      }
    }
  }
  input.points.resize(referenced.size());
  for (size_t v = 0; v < referenced.size(); ++v) {
    if (referenced[v])
      input.points[v] = {scaled(mesh.positions[3 * v]), scaled(mesh.positions[3 * v + 1]), scaled(mesh.positions[3 * v + 2])};
  }
}

/// The slab of a coordinate: a guess that is right for uniform grids, and a binary search where it is not.
int32_t locate(const std::vector<double>& planes, double perCell, double x) {
  const int32_t n = int32_t(planes.size()) - 1;
  if (x < planes[0]) return -1;
  if (x > planes[n]) return 2 * n + 1;
  int32_t c = int32_t(std::clamp((x - planes[0]) * perCell, 0.0, double(n - 1)));
  if (!(planes[c] <= x && x < planes[c + 1])) c = int32_t(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin()) - 1;
  return 2 * c + (x == planes[c] ? 0 : 1);
}

/// Moves a coordinate onto a plane within the tolerance of it; returns its slab.
int32_t snap(const std::vector<double>& planes, int32_t slab, double tolerance, double& x, double& largest) {
  if (onPlane(slab)) return slab;
  const int32_t n = int32_t(planes.size()) - 1;
  double nearest = tolerance;
  int32_t plane = -1;
  for (int32_t p = std::max(0, slab >> 1); p <= std::min(n, (slab >> 1) + 1); ++p) {
    const int32_t cell = std::clamp(slab >> 1, 0, n - 1);
    const double distance = std::fabs(x - planes[p]) / (planes[cell + 1] - planes[cell]);
    if (distance <= nearest) {
      nearest = distance;
      plane = p;
    }
  }
  if (plane < 0) return slab;
  largest = std::max(largest, nearest);
  x = planes[plane];
  return 2 * plane;
}

void locateVertices(const std::vector<uint8_t>& referenced, double snapTolerance, Input& input, Run& run) {
  struct Snaps {
    uint32_t count = 0;
    double largest = 0;
  };
  double perCell[3];
  for (int d = 0; d < 3; ++d) perCell[d] = input.cells(d) / (input.planes[d].back() - input.planes[d].front());
  input.slabs.resize(referenced.size());
  const auto snaps = forChunks<Snaps>(referenced.size(), run.monitor, [&](Snaps& chunk, size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      if (!referenced[v]) continue;
      bool moved = false;
      for (int d = 0; d < 3; ++d) {
        double& x = input.points[v][d];
        int32_t& slab = input.slabs[v][d];
        slab = locate(input.planes[d], perCell[d], x);
        if (snapTolerance > 0 && !onPlane(slab)) {
          slab = snap(input.planes[d], slab, snapTolerance, x, chunk.largest);
          moved |= onPlane(slab);
        }
      }
      chunk.count += moved;
    }
  });
  for (const Snaps& s : snaps) {
    run.stats.snappedVertices += s.count;
    run.stats.largestSnap = std::max(run.stats.largestSnap, s.largest);
  }
}

}  // namespace

Input prepareInput(const MeshView& mesh, const Grid& grid, double snapTolerance, Run& run) {
  if (!(snapTolerance >= 0 && snapTolerance < 0.5)) fail(Status::badOption, -1, "snapTolerance must be at least 0 and below 0.5.");
  checkGrid(grid);
  checkArrays(mesh);
  Input input;
  const std::vector<uint8_t> referenced = referencedVertices(mesh);
  scale(mesh, grid, referenced, input, run.stats);
  locateVertices(referenced, snapTolerance, input, run);
  const std::vector<uint32_t> lowest = weld(referenced, input.points);
  for (uint32_t v = 0; v < lowest.size(); ++v) run.stats.weldedVertices += lowest[v] != v;
  input.triangles.resize(mesh.triangleCount());
  input.states.assign(mesh.triangleCount(), TriangleState::kept);
  for (size_t t = 0; t < input.triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) input.triangles[t][i] = lowest[mesh.triangles[3 * t + i]];
  }
  Predicates predicates;
  const std::vector<uint32_t> zeroArea = dropZeroArea(input, predicates);
  run.count(predicates);
  run.stats.zeroAreaTriangles = uint32_t(zeroArea.size());
  if (!zeroArea.empty()) input.stitches = findStitches(input, zeroArea);
  return input;
}

}  // namespace mandoline::detail
