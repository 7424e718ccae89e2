// What validate() works out from the arrays before it checks.
#include "operators/validate/context.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/position_table.h"
#include "base/sort.h"

namespace mandoline::validation {
namespace {

/// Per tri-vertex that a triangle has, the lowest such one at its position; none for other tri-vertices.
std::vector<uint32_t> welded(const MeshView& mesh, const std::vector<double>& positions) {
  std::vector<uint8_t> referenced(mesh.vertexCount(), 0);
  for (const uint32_t v : mesh.triangles) referenced[v] = 1;
  std::vector<uint32_t> lowest = detail::lowestAtPosition(
      mesh.vertexCount(), [&](uint32_t v) { return &positions[3 * size_t(v)]; }, [&](uint32_t v) { return referenced[v] != 0; });
  for (size_t v = 0; v < lowest.size(); ++v) {
    if (!referenced[v]) lowest[v] = UINT32_MAX;
  }
  return lowest;
}

/// The nearest plane if it is within the tolerance (in widths of the slab that x lies in, or that is next to it), else x.
double snapped(const std::vector<double>& planes, double x, double tolerance) {
  const int64_t cells = int64_t(planes.size()) - 1;
  const int64_t c = std::clamp<int64_t>(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin() - 1, 0, cells - 1);
  const double width = planes[c + 1] - planes[c], low = std::fabs(x - planes[c]) / width, high = std::fabs(x - planes[c + 1]) / width;
  return std::min(low, high) > tolerance ? x : planes[low < high ? c : c + 1];
}

std::vector<uint8_t> isDropped(const CutMesh& cutMesh, size_t triangles) {
  std::vector<uint8_t> dropped(triangles, 0);
  for (const uint32_t t : cutMesh.droppedTriangles) dropped[t] = 1;
  return dropped;
}

Vec3 roundingOf(const MeshView& mesh, const Grid& grid, const Coordinates& coordinates, const std::vector<uint8_t>& dropped) {
  // The least doubles are all as far from each other, so that half of this may be far more than the usual share of a coordinate.
  const double least = std::ldexp(std::numeric_limits<double>::denorm_min(), scaleOf(mesh, grid) - 1);
  Vec3 rounding;
  for (int d = 0; d < 3; ++d) {
    double largest = std::max(std::fabs(coordinates.planes[d].front()), std::fabs(coordinates.planes[d].back()));
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!dropped[i / 3]) largest = std::max(largest, std::fabs(coordinates.triPositions[3 * size_t(mesh.triangles[i]) + size_t(d)]));
    }
    rounding[d] = std::max(kRounding * largest, least);
  }
  return rounding;
}

std::vector<int32_t> ownersOf(const CutMesh& cutMesh) {
  std::vector<int32_t> owner(2 * cutMesh.faceCount(), -1);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (owner[h] < 0) owner[h] = int32_t(c);
    }
  }
  return owner;
}

/// Where a grid cell is among the groups, which are in order of grid cells; the number of groups if it is untouched.
size_t groupAt(const CutMesh& cutMesh, const GridCellGroups& groups, const std::array<int32_t, 3>& gridCell) {
  const auto isBefore = [&](uint32_t cell) {
    const int32_t* g = &cutMesh.cellGridCell[3 * size_t(cell)];
    return g[2] != gridCell[2] ? g[2] < gridCell[2] : g[1] != gridCell[1] ? g[1] < gridCell[1] : g[0] < gridCell[0];
  };
  size_t low = 0, high = groups.count();
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (isBefore(groups[middle][0])) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == groups.count()) return low;
  return std::equal(gridCell.begin(), gridCell.end(), &cutMesh.cellGridCell[3 * size_t(groups[low][0])]) ? low : groups.count();
}

detail::Csr<Edge> findEdgesBeyond(const CutMesh& cutMesh, const GridCellGroups& groups, const std::vector<int32_t>& owner) {
  struct Beyond {
    size_t group;
    Edge edge;
  };
  std::vector<Beyond> found;
  const auto isOn = [&](uint32_t v, int axis, int32_t plane) {
    return (cutMesh.vertexMask[v] >> axis & 1) != 0 && cutMesh.vertexCell[3 * size_t(v) + size_t(axis)] == plane;
  };
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    const int32_t cell = std::max(owner[2 * f], owner[2 * f + 1]);
    if (cutMesh.faceAxis[f] >= 0 || cell < 0) continue;
    const int32_t* g = &cutMesh.cellGridCell[3 * size_t(cell)];
    for (const std::span<const uint32_t> loop : cutMesh.loops(f)) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
        for (int d = 0; d < 3; ++d) {
          if (!isOn(u, d, g[d] + 1) || !isOn(v, d, g[d] + 1)) continue;
          std::array<int32_t, 3> above{g[0], g[1], g[2]};
          ++above[size_t(d)];
          const size_t group = groupAt(cutMesh, groups, above);
          if (group < groups.count()) found.push_back({group, edgeOf(u, v)});
        }
      }
    }
  }
  return detail::groupBy<Edge>(
      groups.count(), found.size(), [&](size_t i) { return found[i].group; }, [&](size_t i) { return found[i].edge; });
}

}  // namespace

int scaleOf(const MeshView& mesh, const Grid& grid) {
  double largest = 0;
  for (const auto& planes : grid.planes) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  for (const uint32_t v : mesh.triangles) {
    for (int d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * size_t(v) + d]));
  }
  return kLargestExponent - std::ilogb(largest);
}

Coordinates scaled(const MeshView& mesh, const CutMesh& cutMesh) {
  const int exponent = scaleOf(mesh, cutMesh.grid);
  const auto scale = [&](const auto& from) {
    std::vector<double> to(from.size());
    for (size_t i = 0; i < to.size(); ++i) {
      to[i] = std::ldexp(from[i], exponent);
      if (std::fabs(to[i]) < std::ldexp(1.0, kNegligibleExponent)) to[i] = 0;
    }
    return to;
  };
  Coordinates result;
  for (int d = 0; d < 3; ++d) result.planes[d] = scale(cutMesh.grid.planes[d]);
  result.positions = scale(cutMesh.positions);
  result.triPositions = scale(mesh.positions);
  for (size_t i = 0; i < result.triPositions.size() && cutMesh.snapTolerance > 0; ++i) {
    double& x = result.triPositions[i];
    if (std::isfinite(x)) x = snapped(result.planes[i % 3], x, cutMesh.snapTolerance);
  }
  return result;
}

GridCellGroups groupByGridCell(const CutMesh& cutMesh) {
  GridCellGroups groups;
  groups.cells.resize(cutMesh.cellCount());
  std::iota(groups.cells.begin(), groups.cells.end(), 0u);
  const auto before = [&](uint32_t a, uint32_t b) {
    const int32_t *g = &cutMesh.cellGridCell[3 * size_t(a)], *h = &cutMesh.cellGridCell[3 * size_t(b)];
    return g[2] != h[2] ? g[2] < h[2] : g[1] != h[1] ? g[1] < h[1] : g[0] < h[0];
  };
  detail::sortItems(groups.cells, before);
  groups.offsets = {0};
  for (size_t i = 1; i <= groups.cells.size(); ++i) {
    if (i == groups.cells.size() || before(groups.cells[i - 1], groups.cells[i])) groups.offsets.push_back(uint32_t(i));
  }
  return groups;
}

Context::Context(const MeshView& mesh_, const CutMesh& cutMesh)
    : mesh(mesh_),
      cut(cutMesh),
      coordinates(scaled(mesh, cut)),
      dropped(isDropped(cut, mesh.triangleCount())),
      weld(welded(mesh, coordinates.triPositions)),
      rounding(roundingOf(mesh, cut.grid, coordinates, dropped)),
      owner(ownersOf(cut)),
      groups(groupByGridCell(cut)),
      edgesBeyond(findEdgesBeyond(cut, groups, owner)),
      exact(*this) {}

bool Context::inBox(const Vec3& p) const {
  for (int d = 0; d < 3; ++d) {
    if (p[d] < planes()[d].front() || p[d] > planes()[d].back()) return false;
  }
  return true;
}

int64_t Context::madeIndex(uint32_t v) const {
  const auto place = std::lower_bound(cut.madeVertices.begin(), cut.madeVertices.end(), v);
  return place != cut.madeVertices.end() && *place == v ? place - cut.madeVertices.begin() : -1;
}

bool Context::haveOnePlane(size_t s, size_t t) const {
  const uint32_t* corners = &mesh.triangles[3 * t];
  const auto isIn = [&](uint32_t v) { return exact.planeOf(s).holds(exact.triVertex(v)); };
  return isIn(corners[0]) && isIn(corners[1]) && isIn(corners[2]);
}

int Context::axialSide(size_t face) const {
  const int32_t t = cut.faceTriangle[face];
  return t < 0 ? 1 : sideOf(size_t(t), cut.faceAxis[face]);
}

int64_t Context::runAt(int64_t i, int64_t j, int64_t k) const {
  const size_t row = size_t(k * cut.grid.cells(1) + j);
  const auto first = cut.runBegin.begin() + cut.rowRunOffsets[row], last = cut.runBegin.begin() + cut.rowRunOffsets[row + 1];
  const auto after = std::upper_bound(first, last, i);
  if (after == first) return -1;
  const int64_t run = after - cut.runBegin.begin() - 1;
  return i < cut.runEnd[run] ? run : -1;
}

}  // namespace mandoline::validation
