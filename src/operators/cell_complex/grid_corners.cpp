#include "operators/cell_complex/grid_corners.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/large_array.h"

namespace mandoline::operators {

GridCorners::GridCorners(const CutMesh& cutMesh, const OctreeCells& octree)
    : cutMesh_(cutMesh), octree_(octree), places_(numberOf(octree.gridCells) + 1, octree.cellCount()) {}

void GridCorners::setPlaces() {
  const auto forCutCorners = [&](const auto& f) {
    for (size_t v = 0; v < cutMesh_.vertexCount(); ++v) {
      const int32_t* at = &cutMesh_.vertexCell[3 * v];
      if (cutMesh_.vertexMask[v] == 7) f(uint32_t(v), numberOf({at[0], at[1], at[2]}));
    }
  };
  forCutCorners([&](uint32_t, uint64_t number) { places_.insert(number); });
  for (size_t c = 0; c < octree_.cellCount(); ++c) {
    const GridIndex low = octree_.corner(c), high = octree_.end(c);
    for (int which = 0; which < 8; ++which) {
      places_.insert(numberOf({(which & 1 ? high : low)[0], (which & 2 ? high : low)[1], (which & 4 ? high : low)[2]}));
    }
  }
  places_.rank();

  constexpr uint32_t kNew = ~0u;
  detail::makeLarge(ids_, places_.size(), kNew);
  forCutCorners([&](uint32_t v, uint64_t number) {
    uint32_t& id = ids_[places_.rankOf(number)];
    id = std::min(id, v);
  });
  for (uint32_t& id : ids_) {
    if (id == kNew) id = uint32_t(cutMesh_.vertexCount() + added_++);
  }
}

void GridCorners::appendPositions(std::vector<double>& positions) const {
  const auto& planes = cutMesh_.grid.planes;
  const uint64_t nx = planes[0].size(), ny = planes[1].size();
  const size_t before = positions.size();
  positions = detail::longer(positions, before + 3 * added_);
  double* next = positions.data() + before;
  uint64_t rowBegin = 0, row = 0;
  uint32_t rank = 0;
  places_.forEach([&](uint64_t number) {
    if (number >= rowBegin + nx) row = number / nx, rowBegin = row * nx;
    if (ids_[rank++] < cutMesh_.vertexCount()) return;
    *next++ = planes[0][number - rowBegin];
    *next++ = planes[1][row % ny];
    *next++ = planes[2][row / ny];
  });
}

/// Of a grid vertex: x changes fastest.
uint64_t GridCorners::numberOf(const GridIndex& at) const {
  const uint64_t nx = uint64_t(octree_.gridCells[0]) + 1, ny = uint64_t(octree_.gridCells[1]) + 1;
  return (uint64_t(at[2]) * ny + uint64_t(at[1])) * nx + uint64_t(at[0]);
}

/// A surface may touch a grid-edge, and not all four grid cells around it.
void GridCorners::linkCutVertices() {
  const auto onLine = [&](uint32_t v) {
    const uint8_t mask = cutMesh_.vertexMask[v];
    return mask == 3 || mask == 5 || mask == 6;
  };
  std::vector<std::array<uint32_t, 2>> links;
  for (size_t l = 0; l < cutMesh_.loopCount(); ++l) {
    const auto loop = cutMesh_.loop(l);
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
      if (!onLine(a) && !onLine(b)) continue;
      // On different grid lines they have one plane in common at most.
      if (std::popcount(cutMesh_.commonPlanes(a, b)) == 2) links.insert(links.end(), {{a, b}, {b, a}});
    }
  }
  links_ = detail::groupBy<uint32_t>(
      cutMesh_.vertexCount(), links.size(), [&](size_t i) { return size_t(links[i][0]); }, [&](size_t i) { return links[i][1]; });
}

GridCorners::OfCell GridCorners::ofCell(size_t cell) const {
  const GridIndex low = octree_.corner(cell), high = octree_.end(cell);
  OfCell corners;
  for (size_t row = 0; row < 8; row += 2) {
    const int32_t y = (row & 2 ? high : low)[1], z = (row & 4 ? high : low)[2];
    const uint32_t rank = places_.rankOf(numberOf({low[0], y, z}));
    corners[row] = ids_[rank];
    // Corners next to each other have ranks next to each other.
    corners[row | 1] = high[0] == low[0] + 1 ? ids_[rank + 1] : idAt({high[0], y, z});
  }
  return corners;
}

/// Appends the cut-vertices inside of a grid-edge.
void GridCorners::appendCutVertices(const Edge& edge, std::vector<uint32_t>& ids) const {
  if (edge.lowId >= cutMesh_.vertexCount()) return;
  const auto isInside = [&](uint32_t v) {
    return cutMesh_.vertexMask[v] == (7 & ~(1 << edge.axis)) && cutMesh_.vertexCell[3 * v + edge.axis] == edge.low[edge.axis];
  };
  for (uint32_t from = edge.lowId, at = from;;) {
    constexpr uint32_t kNone = ~0u;
    uint32_t next = kNone;
    for (const uint32_t v : links_[at]) {
      if (v != from && isInside(v)) next = std::min(next, v);
    }
    if (next == kNone) return;
    ids.push_back(next);
    from = std::exchange(at, next);
  }
}

/// The edge of an octree cell along an axis that begins at a corner.
GridCorners::Edge GridCorners::edgeOf(size_t cell, const OfCell& corners, size_t axis, size_t corner) const {
  GridIndex low = octree_.corner(cell);
  const GridIndex high = octree_.end(cell);
  for (size_t d = 0; d < 3; ++d) {
    if (corner >> d & 1) low[d] = high[d];
  }
  return {low, corners[corner], axis, octree_.cellLevel[cell]};
}

bool GridCorners::hasPlainSides(size_t cell, const OfCell& corners) const {
  const auto isAdded = [&](uint32_t v) { return v >= cutMesh_.vertexCount(); };
  if (octree_.cellLevel[cell] == 0 && std::all_of(corners.begin(), corners.end(), isAdded)) return true;
  std::vector<uint32_t> inside;
  for (size_t axis = 0; axis < 3 && inside.empty(); ++axis) {
    for (size_t corner = 0; corner < 8; ++corner) {
      if (!(corner >> axis & 1)) appendInside(edgeOf(cell, corners, axis, corner), inside);
    }
  }
  return inside.empty();
}

void GridCorners::appendSide(size_t cell, const OfCell& corners, size_t axis, int side, std::vector<uint32_t>& ids) const {
  const size_t low = size_t(side) << axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const size_t right = low | size_t(1) << u, up = low | size_t(1) << v;
  ids.push_back(corners[low]);
  appendInside(edgeOf(cell, corners, u, low), true, ids);
  ids.push_back(corners[right]);
  appendInside(edgeOf(cell, corners, v, right), true, ids);
  ids.push_back(corners[right | up]);
  appendInside(edgeOf(cell, corners, u, up), false, ids);
  ids.push_back(corners[up]);
  appendInside(edgeOf(cell, corners, v, low), false, ids);
}

/// Appends the vertices strictly inside of an edge.
void GridCorners::appendInside(const Edge& edge, bool forwards, std::vector<uint32_t>& ids) const {
  const auto first = std::ptrdiff_t(ids.size());
  appendInside(edge, ids);
  if (!forwards) std::reverse(ids.begin() + first, ids.end());
}

/// The same, upwards. If smaller cells have corners there, then in the middle, too: octree cells are halved.
void GridCorners::appendInside(const Edge& edge, std::vector<uint32_t>& ids) const {
  if (edge.level == 0) return appendCutVertices(edge, ids);
  const Edge lower = {edge.low, edge.lowId, edge.axis, edge.level - 1};
  Edge upper = lower;
  upper.low[edge.axis] += int32_t(1) << upper.level;
  if (upper.low[edge.axis] >= octree_.gridCells[edge.axis]) return appendInside(lower, ids);
  const uint32_t rank = places_.rankOf(numberOf(upper.low));
  if (rank == places_.kNone) return;
  appendInside(lower, ids);
  ids.push_back(upper.lowId = ids_[rank]);
  appendInside(upper, ids);
}

}  // namespace mandoline::operators
