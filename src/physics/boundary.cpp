#include "physics/joined_cells.h"

namespace mandoline {

Boundary boundaryOf(const CellComplex& cells) {
  Boundary boundary;
  for (uint32_t h = 0; h < 2 * cells.faceCount(); ++h) {
    if (cells.faceCells[h] >= 0 && !physics::isInner(cells, h / 2)) boundary.halfFaces.push_back(h);
  }
  boundary.condition.assign(boundary.halfFaces.size(), Condition::neumann);
  boundary.value.assign(boundary.halfFaces.size(), 0);
  return boundary;
}

void setBoundary(Boundary& boundary, const CellComplex& cells, FaceTag tag, Condition condition, double value) {
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    if (cells.faceTag[boundary.halfFaces[b] / 2] != tag) continue;
    boundary.condition[b] = condition;
    boundary.value[b] = value;
  }
}

std::vector<double> outwardNormals(const Boundary& boundary, const CellComplex& cells) {
  std::vector<double> normals;
  normals.reserve(3 * boundary.halfFaces.size());
  for (const uint32_t h : boundary.halfFaces) {
    for (size_t d = 0; d < 3; ++d) normals.push_back((h % 2 == 0 ? 1 : -1) * cells.faceNormal[3 * (h / 2) + d]);
  }
  return normals;
}

CellComponents cellComponents(const CellComplex& cells) {
  return physics::joinedCells(cells, [](size_t) { return true; });
}

}  // namespace mandoline
