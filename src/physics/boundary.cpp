#include "operators/require_cut_mesh.h"
#include "physics/joined_cells.h"
#include "physics/poisson_problem.h"

namespace mandoline {

static bool isOfBoundary(const CellComplex& cells, uint32_t halfFace) {
  return cells.faceCells[halfFace] >= 0 && !physics::isInner(cells, halfFace / 2);
}

Boundary boundaryOf(const CellComplex& cells) {
  Boundary boundary;
  for (uint32_t h = 0; h < 2 * cells.faceCount(); ++h) {
    if (isOfBoundary(cells, h)) boundary.halfFaces.push_back(h);
  }
  boundary.condition.assign(boundary.halfFaces.size(), Condition::neumann);
  boundary.value.assign(boundary.halfFaces.size(), 0);
  boundary.coefficient.assign(boundary.halfFaces.size(), 0);
  boundary.madeFrom = cells.fingerprint;
  return boundary;
}

void physics::requireBoundary(const Boundary& boundary, const CellComplex& cells) {
  operators::requireMadeFrom(boundary.madeFrom, cells.fingerprint, "The boundary is not that of these cells.");
  const size_t n = boundary.halfFaces.size();
  for (size_t b = 0; b < n; ++b) {
    const uint32_t h = boundary.halfFaces[b];
    if (h >= 2 * cells.faceCount()) operators::refuse("There is no half-face " + std::to_string(h) + ".", int64_t(b));
    if (!isOfBoundary(cells, h) || (b > 0 && boundary.halfFaces[b - 1] >= h))
      operators::refuse("The boundary has half-face " + std::to_string(h) + ", which is none of the boundary or is out of order.",
                        int64_t(b));
  }
  if (boundary.condition.size() != n || boundary.value.size() != n || boundary.coefficient.size() != n)
    operators::refuse("The boundary has " + std::to_string(n) + " half-faces, but other numbers of conditions, values or coefficients.");
}

void setBoundary(Boundary& boundary, const CellComplex& cells, FaceTag tag, Condition condition, double value) {
  physics::requireBoundary(boundary, cells);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    if (cells.faceTag[boundary.halfFaces[b] / 2] != tag) continue;
    boundary.condition[b] = condition;
    boundary.value[b] = value;
    boundary.coefficient[b] = 0;
  }
}

void setRobin(Boundary& boundary, const CellComplex& cells, FaceTag tag, double coefficient, double value) {
  setBoundary(boundary, cells, tag, Condition::robin, value);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    if (cells.faceTag[boundary.halfFaces[b] / 2] == tag) boundary.coefficient[b] = coefficient;
  }
}

std::vector<double> outwardNormals(const Boundary& boundary, const CellComplex& cells) {
  physics::requireBoundary(boundary, cells);
  std::vector<double> normals;
  normals.reserve(3 * boundary.halfFaces.size());
  for (const uint32_t h : boundary.halfFaces) {
    for (size_t d = 0; d < 3; ++d) normals.push_back((h % 2 == 0 ? 1 : -1) * cells.faceNormal[3 * (h / 2) + d]);
  }
  return normals;
}

CellComponents cellComponents(const CellComplex& cells) { return physics::componentsOf(cells, 1); }

}  // namespace mandoline
