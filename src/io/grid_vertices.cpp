#include "io/grid_vertices.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// The axis of the grid line through two vertices, or -1.
int commonGridLine(const CutMesh& m, uint32_t u, uint32_t v) {
  const uint8_t planes = m.commonPlanes(u, v);
  return planes == 6 ? 0 : planes == 5 ? 1 : planes == 3 ? 2 : -1;
}

}  // namespace

GridVertices::GridVertices(const CutMesh& cutMesh, const Selection& selection) : cutMesh_(cutMesh), count_(int64_t(cutMesh.vertexCount())) {
  numberCorners(selection);
  linkAlongGridLines();
  findDividedCells(selection);
}

void GridVertices::numberCorners(const Selection& selection) {
  const size_t rows = cutMesh_.grid.planes[1].size() * cutMesh_.grid.planes[2].size();
  std::vector<size_t> offsets(rows + 1, 0);
  const auto forEachGridVertex = [&](const auto& visit) {
    for (uint32_t v = 0; v < cutMesh_.vertexCount(); ++v) {
      const int32_t* c = cutMesh_.vertexCell.data() + 3 * size_t(v);
      if (cutMesh_.vertexMask[v] == kGridVertex) visit(v, c[0], rowOf({c[0], c[1], c[2]}));
    }
  };
  forEachGridVertex([&](uint32_t, int32_t, size_t row) { ++offsets[row + 1]; });
  for (size_t row = 0; row < rows; ++row) offsets[row + 1] += offsets[row];
  std::vector<std::pair<int32_t, uint32_t>> cutCorners(offsets[rows]);  // x and vertex, by row
  std::vector<size_t> next(offsets.begin(), offsets.end() - 1);
  forEachGridVertex([&](uint32_t v, int32_t x, size_t row) { cutCorners[next[row]++] = {x, v}; });
  rowOffsets_.assign(1, 0);
  for (size_t row = 0; row < rows; ++row) {
    const std::span<std::pair<int32_t, uint32_t>> corners(cutCorners.data() + offsets[row], offsets[row + 1] - offsets[row]);
    sortItems(corners);
    addRow(selection, row, corners);
    rowOffsets_.push_back(segments_.size());
  }
}

/// A corner belongs to the untouched cells of the four rows of cells around its row.
void GridVertices::addRow(const Selection& selection, size_t row, std::span<const std::pair<int32_t, uint32_t>> cutCorners) {
  const size_t ny = cutMesh_.grid.planes[1].size() - 1, nz = cutMesh_.grid.planes[2].size() - 1;
  const size_t j = row % (ny + 1), k = row / (ny + 1);
  std::vector<std::pair<int32_t, int32_t>> pieces;
  for (size_t side = 0; side < 4; ++side) {
    const size_t y = j + (side & 1), z = k + (side >> 1);  // one more than the cells'
    if (y == 0 || y > ny || z == 0 || z > nz) continue;
    selection.forEachRun((z - 1) * ny + y - 1, [&](int32_t begin, int32_t end, uint32_t) { pieces.push_back({begin, end + 1}); });
  }
  sortItems(pieces);
  for (size_t p = 0; p < pieces.size();) {
    const int32_t begin = pieces[p].first;
    int32_t end = pieces[p].second;
    for (++p; p < pieces.size() && pieces[p].first <= end; ++p) end = std::max(end, pieces[p].second);
    addSegments(begin, end, cutCorners);
  }
}

void GridVertices::addSegments(int32_t begin, int32_t end, std::span<const std::pair<int32_t, uint32_t>> cutCorners) {
  const auto addFree = [&](int32_t to) {
    if (begin < to) segments_.push_back({begin, to, count_});
    count_ += std::max(to - begin, 0);
  };
  auto cut = std::lower_bound(cutCorners.begin(), cutCorners.end(), std::pair(begin, 0u));
  for (; cut != cutCorners.end() && cut->first < end; ++cut) {
    addFree(cut->first);
    segments_.push_back({cut->first, cut->first + 1, int64_t(cut->second)});
    begin = cut->first + 1;
  }
  addFree(end);
}

const GridVertices::Segment* GridVertices::find(const Index& corner) const {
  const size_t row = rowOf(corner);
  const Segment *first = segments_.data() + rowOffsets_[row], *last = segments_.data() + rowOffsets_[row + 1];
  return std::partition_point(first, last, [&](const Segment& segment) { return segment.end <= corner[0]; });
}

/// The sides of faces along grid lines tell the order of the vertices there: coordinates are rounded and may not.
void GridVertices::linkAlongGridLines() {
  links_.assign(3 * cutMesh_.vertexCount(), kNone);
  for (size_t l = 0; l < cutMesh_.loopCount(); ++l) {
    const auto loop = cutMesh_.loop(l);
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
      const int axis = commonGridLine(cutMesh_, u, v);
      if (axis < 0) continue;
      link(u, v, axis);
      link(v, u, axis);
    }
  }
}

void GridVertices::link(uint32_t from, uint32_t to, int axis) {
  uint32_t* slots = links_.data() + 3 * size_t(from);
  if (cutMesh_.vertexMask[from] == kGridVertex) {
    const bool above = cutMesh_.vertexCell[3 * size_t(to) + axis] == cutMesh_.vertexCell[3 * size_t(from) + axis];
    if (above && cutMesh_.vertexMask[to] != kGridVertex) slots[axis] = to;
  } else if (slots[0] == kNone || slots[0] == to) {
    slots[0] = to;
  } else {
    slots[1] = to;
  }
}

void GridVertices::findDividedCells(const Selection& selection) {
  const auto& grid = cutMesh_.grid;
  const auto addIfUntouched = [&](const Index& cell) {
    for (int d = 0; d < 3; ++d) {
      if (cell[d] < 0 || cell[d] >= grid.cells(d)) return;
    }
    const int64_t row = cell[1] + grid.cells(1) * cell[2];
    selection.forEachRun(size_t(row), [&](int32_t begin, int32_t end, uint32_t) {
      if (begin <= cell[0] && cell[0] < end) dividedCells_.push_back(cell[0] + grid.cells(0) * row);
    });
  };
  for (size_t v = 0; v < cutMesh_.vertexCount(); ++v) {
    const uint8_t mask = cutMesh_.vertexMask[v];
    const int axis = mask == 6 ? 0 : mask == 5 ? 1 : mask == 3 ? 2 : -1;  // of the grid-edge that it lies inside
    if (axis < 0) continue;
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    for (int side = 0; side < 4; ++side) {
      Index cell = {cutMesh_.vertexCell[3 * v], cutMesh_.vertexCell[3 * v + 1], cutMesh_.vertexCell[3 * v + 2]};
      cell[p] -= side & 1;
      cell[q] -= side >> 1;
      addIfUntouched(cell);
    }
  }
  sortUnique(dividedCells_);
}

void GridVertices::appendEdge(const Index& from, int axis, bool upwards, std::vector<int64_t>& vertices) const {
  const size_t begin = vertices.size();
  Index to = from;
  ++to[axis];
  vertices.push_back(corner(from));
  const bool isCut = vertices.back() < int64_t(cutMesh_.vertexCount());
  uint32_t previous = isCut ? uint32_t(vertices.back()) : kNone, current = isCut ? links_[3 * size_t(previous) + axis] : kNone;
  while (current != kNone && cutMesh_.vertexMask[current] != kGridVertex) {
    vertices.push_back(current);
    const uint32_t* slots = links_.data() + 3 * size_t(current);
    const uint32_t next = slots[0] == previous ? slots[1] : slots[0];
    previous = current;
    current = next;
  }
  if (upwards) return;
  vertices[begin] = corner(to);
  std::reverse(vertices.begin() + std::ptrdiff_t(begin) + 1, vertices.end());
}

}  // namespace mandoline::detail
