#include "operators/cell_complex/grid_corners.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace mandoline::operators {

GridCorners::GridCorners(const CutMesh& cutMesh, const OctreeCells& octree) : cutMesh_(cutMesh), octree_(octree) {
  linkCutVertices();
  const auto forCutCorners = [&](const auto& f) {
    for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
      const int32_t* at = &cutMesh.vertexCell[3 * v];
      if (cutMesh.vertexMask[v] == 7) f(uint32_t(v), numberOf({at[0], at[1], at[2]}));
    }
  };
  forCutCorners([&](uint32_t, uint64_t number) { places_.insert(number); });
  for (size_t c = 0; c < octree.cellCount(); ++c) {
    const GridIndex low = octree.corner(c), high = octree.end(c);
    for (int which = 0; which < 8; ++which) {
      places_.insert(numberOf({(which & 1 ? high : low)[0], (which & 2 ? high : low)[1], (which & 4 ? high : low)[2]}));
    }
  }
  places_.rank();

  constexpr uint32_t kNew = ~0u;
  ids_.assign(places_.size(), kNew);
  forCutCorners([&](uint32_t v, uint64_t number) {
    uint32_t& id = ids_[places_.rankOf(number)];
    id = std::min(id, v);
  });
  const uint64_t nx = uint64_t(octree.gridCells[0]) + 1, ny = uint64_t(octree.gridCells[1]) + 1;
  uint32_t rank = 0;
  places_.forEach([&](uint64_t number) {
    uint32_t& id = ids_[rank++];
    if (id != kNew) return;
    id = uint32_t(cutMesh.vertexCount() + added_.size());
    added_.push_back({int32_t(number % nx), int32_t(number / nx % ny), int32_t(number / nx / ny)});
  });
}

/// Of a grid vertex: x changes fastest.
uint64_t GridCorners::numberOf(const GridIndex& at) const {
  const uint64_t nx = uint64_t(octree_.gridCells[0]) + 1, ny = uint64_t(octree_.gridCells[1]) + 1;
  return (uint64_t(at[2]) * ny + uint64_t(at[1])) * nx + uint64_t(at[0]);
}

/// Of a grid vertex that is a corner.
uint32_t GridCorners::idAt(const GridIndex& at) const { return ids_[places_.rankOf(numberOf(at))]; }

/// A surface may touch a grid-edge, and not all four grid cells around it.
void GridCorners::linkCutVertices() {
  const auto onLine = [&](uint32_t v) {
    const uint8_t mask = cutMesh_.vertexMask[v];
    return mask == 3 || mask == 5 || mask == 6;
  };
  for (size_t l = 0; l < cutMesh_.loopCount(); ++l) {
    const auto loop = cutMesh_.loop(l);
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
      if (!onLine(a) && !onLine(b)) continue;
      const uint8_t planes = cutMesh_.vertexMask[a] & cutMesh_.vertexMask[b];
      if (planes != 3 && planes != 5 && planes != 6) continue;
      bool same = true;  // those of two lines share but one plane, except for parallel ones
      for (size_t d = 0; d < 3; ++d) same &= !(planes >> d & 1) || cutMesh_.vertexCell[3 * a + d] == cutMesh_.vertexCell[3 * b + d];
      if (same) links_.insert(links_.end(), {{a, b}, {b, a}});
    }
  }
  detail::sortUnique(links_);
}

/// Appends the cut-vertices inside of a grid-edge.
void GridCorners::appendCutVertices(const GridIndex& low, size_t axis, std::vector<uint32_t>& ids) const {
  const uint32_t corner = idAt(low);
  if (corner >= cutMesh_.vertexCount()) return;
  const auto isInside = [&](uint32_t v) {
    return cutMesh_.vertexMask[v] == (7 & ~(1 << axis)) && cutMesh_.vertexCell[3 * v + axis] == low[axis];
  };
  for (uint32_t from = corner, at = corner;;) {
    const auto [first, last] = std::equal_range(links_.begin(), links_.end(), std::array<uint32_t, 2>{at, 0},
                                                [](const auto& a, const auto& b) { return a[0] < b[0]; });
    const auto next = std::find_if(first, last, [&](const auto& link) { return link[1] != from && isInside(link[1]); });
    if (next == last) return;
    ids.push_back((*next)[1]);
    from = std::exchange(at, (*next)[1]);
  }
}

void GridCorners::appendSide(size_t cell, size_t axis, int side, std::vector<uint32_t>& ids) const {
  const GridIndex corner = octree_.corner(cell), end = octree_.end(cell);
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  GridIndex low = corner;  // the side's lowest vertex
  low[axis] = (side ? end : corner)[axis];
  GridIndex right = low, up = low;
  right[u] = end[u];
  up[v] = end[v];
  const int level = octree_.cellLevel[cell];
  appendEdge(low, {u, level}, true, ids);
  appendEdge(right, {v, level}, true, ids);
  appendEdge(up, {u, level}, false, ids);
  appendEdge(low, {v, level}, false, ids);
}

/// Appends the vertices of the edge that begins at `low`, except the last. Backwards: from its upper end.
void GridCorners::appendEdge(const GridIndex& low, const Edge& edge, bool forwards, std::vector<uint32_t>& ids) const {
  GridIndex high = low;
  high[edge.axis] = int32_t(std::min(int64_t(low[edge.axis]) + (int64_t(1) << edge.level), int64_t(octree_.gridCells[edge.axis])));
  ids.push_back(idAt(forwards ? low : high));
  const auto first = std::ptrdiff_t(ids.size());
  appendInside(low, edge, ids);
  if (!forwards) std::reverse(ids.begin() + first, ids.end());
}

/// Appends the vertices strictly inside, upwards. If smaller cells have corners there, then in the middle, too: octree cells are halved.
void GridCorners::appendInside(const GridIndex& low, const Edge& edge, std::vector<uint32_t>& ids) const {
  if (edge.level == 0) return appendCutVertices(low, edge.axis, ids);
  const Edge half = {edge.axis, edge.level - 1};
  GridIndex middle = low;
  middle[edge.axis] += int32_t(1) << half.level;
  if (middle[edge.axis] >= octree_.gridCells[edge.axis]) return appendInside(low, half, ids);
  const uint32_t rank = places_.rankOf(numberOf(middle));
  if (rank == places_.kNone) return;
  appendInside(low, half, ids);
  ids.push_back(ids_[rank]);
  appendInside(middle, half, ids);
}

}  // namespace mandoline::operators
