#include "physics/flow_cells.h"

#include <algorithm>

#include "physics/symmetric3.h"

namespace mandoline::physics {
namespace {

/// Directions in which nothing is known, or nearly, stay zero.
constexpr double kTowardsZero = 1e-6;

FlowFace flowFace(const CellComplex& cells, uint32_t f) {
  FlowFace face{f, {uint32_t(cells.faceCells[2 * f]), uint32_t(cells.faceCells[2 * f + 1])}, 0.5, {}, {}, false};
  const Point from = pointAt(cells.cellCentroid, face.cells[0]), to = pointAt(cells.cellCentroid, face.cells[1]),
              at = pointAt(cells.faceCentroid, f), normal = pointAt(cells.faceNormal, f);
  Point before;
  for (size_t d = 0; d < 3; ++d) face.step[d] = to[d] - from[d], before[d] = at[d] - from[d];
  const double along = dot(face.step, normal), length = std::sqrt(dot(face.step, face.step));
  if (along > length / 20) face.share = std::clamp(dot(before, normal) / along, 0.0, 1.0);
  for (size_t d = 0; d < 3; ++d) face.skew[d] = before[d] - face.share * face.step[d];
  face.isSkewed = std::sqrt(dot(face.skew, face.skew)) > 1e-9 * length;  // more than rounding
  return face;
}

void addTo(double* sum, const Point& vector, double factor) {
  for (size_t d = 0; d < 3; ++d) sum[d] += factor * vector[d];
}

}  // namespace

FlowCells::FlowCells(const CellComplex& cells, std::span<const uint32_t> wall, std::span<const uint32_t> outlets) : cells_(cells) {
  for (uint32_t f = 0; f < cells.faceCount(); ++f) {
    if (isInner(cells, f) && cells.faceArea[f] > 0) faces_.push_back(flowFace(cells, f));
  }
  setSlopes(wall);
  setNormals(outlets);
}

/// Differences weigh as much as the area that they hold for, and over a distance of r as 1 / r^2.
void FlowCells::setSlopes(std::span<const uint32_t> wall) {
  std::vector<Symmetric3> sums(cells_.cellCount());
  const auto weightOf = [&](const Point& step, size_t f) {
    const double square = dot(step, step);
    return square > 0 ? cells_.faceArea[f] / square : 0;
  };
  for (const FlowFace& face : faces_) {
    for (const uint32_t c : face.cells) sums[c].add(face.step, weightOf(face.step, face.face));
  }
  const auto stepTo = [&](uint32_t h) {
    Point step;
    for (size_t d = 0; d < 3; ++d)
      step[d] = cells_.faceCentroid[3 * (h / 2) + d] - cells_.cellCentroid[3 * size_t(cells_.faceCells[h]) + d];
    return step;
  };
  for (const uint32_t h : wall) sums[size_t(cells_.faceCells[h])].add(stepTo(h), weightOf(stepTo(h), h / 2));
  const auto slopeOf = [&](size_t cell, const Point& step, size_t f) {
    Point right;
    for (size_t d = 0; d < 3; ++d) right[d] = weightOf(step, f) * step[d];
    return sums[cell].solve(right, kTowardsZero);
  };
  for (const FlowFace& face : faces_)
    slopes_.push_back({slopeOf(face.cells[0], face.step, face.face), slopeOf(face.cells[1], face.step, face.face)});
  wallSlopes_.resize(wall.empty() ? 0 : cells_.cellCount());
  for (const uint32_t h : wall) {
    const size_t cell = size_t(cells_.faceCells[h]);
    addTo(wallSlopes_[cell].data(), slopeOf(cell, stepTo(h), h / 2), 1);
  }
}

void FlowCells::setNormals(std::span<const uint32_t> outlets) {
  std::vector<Symmetric3> sums(cells_.cellCount());
  for (const FlowFace& face : faces_) {
    for (const uint32_t c : face.cells) sums[c].add(pointAt(cells_.faceNormal, face.face), cells_.faceArea[face.face]);
  }
  for (const uint32_t h : outlets) sums[size_t(cells_.faceCells[h])].add(pointAt(cells_.faceNormal, h / 2), cells_.faceArea[h / 2]);
  const auto normalOf = [&](size_t cell, size_t f, double sign) {
    Point right;
    for (size_t d = 0; d < 3; ++d) right[d] = sign * cells_.faceArea[f] * cells_.faceNormal[3 * f + d];
    return sums[cell].solve(right, kTowardsZero);
  };
  for (const FlowFace& face : faces_) normals_.push_back({normalOf(face.cells[0], face.face, 1), normalOf(face.cells[1], face.face, 1)});
  for (const uint32_t h : outlets) {
    outletCells_.push_back(uint32_t(cells_.faceCells[h]));
    outletNormals_.push_back(normalOf(outletCells_.back(), h / 2, h % 2 == 0 ? 1 : -1));
  }
}

void FlowCells::gradients(const std::vector<double>& velocity, std::vector<double>& result) const {
  result.assign(9 * cells_.cellCount(), 0);
  for (size_t i = 0; i < faces_.size(); ++i) {
    const auto [a, b] = faces_[i].cells;
    for (size_t d = 0; d < 3; ++d) {
      const double difference = velocity[3 * b + d] - velocity[3 * a + d];
      addTo(&result[9 * a + 3 * d], slopes_[i][0], difference);
      addTo(&result[9 * b + 3 * d], slopes_[i][1], difference);
    }
  }
  for (size_t c = 0; c < wallSlopes_.size(); ++c) {
    for (size_t d = 0; d < 3; ++d) addTo(&result[9 * c + 3 * d], wallSlopes_[c], -velocity[3 * c + d]);
  }
}

void FlowCells::vectors(const std::vector<double>& faceDerivative, const std::vector<double>& outlet, std::vector<double>& result) const {
  result.assign(3 * cells_.cellCount(), 0);
  for (size_t i = 0; i < faces_.size(); ++i) {
    const double derivative = faceDerivative[faces_[i].face];
    for (const size_t side : {0, 1}) addTo(&result[3 * faces_[i].cells[side]], normals_[i][side], derivative);
  }
  for (size_t i = 0; i < outletCells_.size(); ++i) addTo(&result[3 * outletCells_[i]], outletNormals_[i], outlet[i]);
}

double FlowCells::normalVelocity(const FlowFace& face, const std::vector<double>& velocity, const std::vector<double>& gradients) const {
  double sum = 0;
  for (size_t d = 0; d < 3; ++d) {
    const auto [a, b] = face.cells;
    double value = (1 - face.share) * velocity[3 * a + d] + face.share * velocity[3 * b + d];
    if (face.isSkewed) {
      const double *atA = &gradients[9 * a + 3 * d], *atB = &gradients[9 * b + 3 * d];
      for (size_t e = 0; e < 3; ++e) value += face.skew[e] * ((1 - face.share) * atA[e] + face.share * atB[e]);
    }
    sum += value * cells_.faceNormal[3 * face.face + d];
  }
  return sum;
}

}  // namespace mandoline::physics
