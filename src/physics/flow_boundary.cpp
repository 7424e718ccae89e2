#include "physics/flow_boundary.h"

#include "physics/wind.h"

namespace mandoline::physics {

FlowBoundary::FlowBoundary(const CellComplex& cells, const std::array<double, 3>& wind) {
  std::vector<uint32_t> throttled;
  boundary = windBoundary(cells, wind, throttled);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  inflow.resize(normals.size());
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    if (cells.faceTag[h / 2] == FaceTag::surface) {
      kinds.push_back(Kind::surface);
      surface.push_back(h);
    } else if (boundary.value[b] > 0) {
      kinds.push_back(Kind::outlet);
      outlets.push_back(h), outletsAt.push_back(uint32_t(b));
      boundary.value[b] = 0;
    } else {
      kinds.push_back(boundary.value[b] < 0 ? Kind::inflow : Kind::side);
      double along = 0;
      for (size_t d = 0; d < 3; ++d) along += wind[d] * normals[3 * b + d];
      for (size_t d = 0; d < 3 && kinds.back() == Kind::inflow; ++d) inflow[3 * b + d] = wind[d] * (boundary.value[b] / along);
    }
  }
}

Boundary FlowBoundary::ofPressure() const {
  Boundary result = boundary;
  result.value.assign(result.value.size(), 0);
  for (const uint32_t b : outletsAt) result.condition[b] = Condition::dirichlet;
  return result;
}

Boundary FlowBoundary::ofVelocity(const CellComplex& cells, size_t axis) const {
  Boundary result = boundary;
  for (size_t b = 0; b < kinds.size(); ++b) {
    const bool isAcross = cells.faceNormal[3 * (result.halfFaces[b] / 2) + axis] != 0;
    const bool isHeld = kinds[b] == Kind::surface || kinds[b] == Kind::inflow || (kinds[b] == Kind::side && isAcross);
    result.condition[b] = isHeld ? Condition::dirichlet : Condition::neumann;
  }
  result.value = velocities(axis);
  return result;
}

std::vector<double> FlowBoundary::velocities(size_t axis) const {
  std::vector<double> values(kinds.size());
  for (size_t b = 0; b < values.size(); ++b) values[b] = inflow[3 * b + axis];
  return values;
}

}  // namespace mandoline::physics
