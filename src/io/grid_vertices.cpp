#include "io/grid_vertices.h"

#include <algorithm>

namespace mandoline::detail {
namespace {

/// The axis of the grid line through two vertices, or -1.
int commonGridLine(const CutMesh& m, uint32_t u, uint32_t v) {
  int axis = -1, common = 0;
  for (int d = 0; d < 3; ++d) {
    const bool onPlane = (m.vertexMask[u] & m.vertexMask[v]) >> d & 1;
    if (onPlane && m.vertexCell[3 * size_t(u) + d] == m.vertexCell[3 * size_t(v) + d]) {
      ++common;
    } else {
      axis = d;
    }
  }
  return common == 2 ? axis : -1;
}

}  // namespace

GridVertices::GridVertices(const CutMesh& cutMesh) : cutMesh_(cutMesh), positions_(cutMesh.positions) {
  const auto planes = [&](int d) { return size_t(cutMesh.grid.cells(d) + 1); };
  corners_.assign(planes(0) * planes(1) * planes(2), kNone);
  for (uint32_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t* c = cutMesh.vertexCell.data() + 3 * size_t(v);
    if (cutMesh.vertexMask[v] == kGridVertex) corners_[cornerIndex({c[0], c[1], c[2]})] = v;
  }
  linkAlongGridLines();
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

uint32_t GridVertices::corner(const Index& at) {
  uint32_t& vertex = corners_[cornerIndex(at)];
  if (vertex == kNone) {
    vertex = uint32_t(positions_.size() / 3);
    for (int d = 0; d < 3; ++d) positions_.push_back(cutMesh_.grid.planes[d][at[d]]);
  }
  return vertex;
}

bool GridVertices::divided(const Index& from, int axis) const {
  const uint32_t vertex = corners_[cornerIndex(from)];
  return vertex < cutMesh_.vertexCount() && links_[3 * size_t(vertex) + axis] != kNone;
}

void GridVertices::appendEdge(const Index& from, int axis, bool upwards, std::vector<uint32_t>& vertices) {
  const size_t begin = vertices.size();
  Index to = from;
  ++to[axis];
  vertices.push_back(corner(from));
  if (divided(from, axis)) {
    uint32_t previous = vertices.back(), current = links_[3 * size_t(previous) + axis];
    while (current != kNone && cutMesh_.vertexMask[current] != kGridVertex) {
      vertices.push_back(current);
      const uint32_t* slots = links_.data() + 3 * size_t(current);
      const uint32_t next = slots[0] == previous ? slots[1] : slots[0];
      previous = current;
      current = next;
    }
  }
  if (upwards) return;
  vertices[begin] = corner(to);
  std::reverse(vertices.begin() + std::ptrdiff_t(begin) + 1, vertices.end());
}

}  // namespace mandoline::detail
