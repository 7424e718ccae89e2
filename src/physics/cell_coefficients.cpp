#include "physics/cell_coefficients.h"

#include <algorithm>
#include <cmath>

#include "physics/fit_data.h"
#include "physics/symmetric3.h"

namespace mandoline::physics {
namespace {

struct FaceOfCell {
  uint32_t cell, face;
};

/// The logarithm is linear in the cell, by least squares weighted by area.
void fitLogarithm(const CellComplex& cells, const std::vector<double>& coefficients, std::span<const uint32_t> faces, size_t cell,
                  CellCoefficients& result) {
  double area = 0, mean = 0;
  Point middle{};
  for (const uint32_t f : faces) {
    area += cells.faceArea[f], mean += cells.faceArea[f] * std::log(coefficients[f]);
    for (size_t d = 0; d < 3; ++d) middle[d] += cells.faceArea[f] * cells.faceCentroid[3 * f + d];
  }
  mean /= area;
  for (double& x : middle) x /= area;
  Symmetric3 matrix;
  Point right{}, offset;
  for (const uint32_t f : faces) {
    Point r;
    for (size_t d = 0; d < 3; ++d) r[d] = cells.faceCentroid[3 * f + d] - middle[d];
    matrix.add(r, cells.faceArea[f]);
    for (size_t d = 0; d < 3; ++d) right[d] += cells.faceArea[f] * (std::log(coefficients[f]) - mean) * r[d];
  }
  constexpr double kTowardsZero = 1e-4;
  const Point slope = matrix.solve(right, kTowardsZero);
  for (size_t d = 0; d < 3; ++d) {
    result.slope[3 * cell + d] = slope[d];
    offset[d] = cells.cellCentroid[3 * cell + d] - middle[d];
  }
  result.value[cell] = std::exp(mean + dot(slope, offset));
}

}  // namespace

CellCoefficients cellCoefficients(const CellComplex& cells, const DualEdges& dual, const Boundary& boundary) {
  CellCoefficients result;
  const std::vector<double>& coefficients = dual.coefficients;
  if (coefficients.empty()) return result;
  std::vector<FaceOfCell> all;
  const auto add = [&](int32_t cell, uint32_t f) {
    if (cells.faceArea[f] > 0) all.push_back({uint32_t(cell), f});
  };
  for (const uint32_t f : dual.faces.items) add(cells.faceCells[2 * f], f), add(cells.faceCells[2 * f + 1], f);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    if (boundary.condition[b] != Condition::neumann) add(cells.faceCells[boundary.halfFaces[b]], boundary.halfFaces[b] / 2);
  }
  const auto faces = detail::groupBy<uint32_t>(
      cells.cellCount(), all.size(), [&](size_t i) { return size_t(all[i].cell); }, [&](size_t i) { return all[i].face; });
  result.value.assign(cells.cellCount(), 1);
  result.slope.resize(3 * cells.cellCount());
  result.jumps.resize(cells.cellCount());
  constexpr double kJump = 1.5;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (faces[c].empty()) continue;
    double low = HUGE_VAL, high = 0;
    for (const uint32_t f : faces[c]) low = std::min(low, coefficients[f]), high = std::max(high, coefficients[f]);
    result.jumps[c] = !(high <= kJump * low);
    if (!result.jumps[c]) fitLogarithm(cells, coefficients, faces[c], c, result);
  }
  return result;
}

}  // namespace mandoline::physics
