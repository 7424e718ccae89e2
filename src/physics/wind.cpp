#include "physics/wind.h"

#include <algorithm>
#include <cmath>

#include "physics/joined_cells.h"

namespace mandoline::physics {
CellComponents partsBetweenSlits(const CellComplex& cells) {
  constexpr double kSlit = 1e-6;
  std::vector<double> largest(cells.cellCount());
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    for (const uint32_t h : cells.halfFaces(c)) largest[c] = std::max(largest[c], cells.faceArea[h / 2]);
  }
  return joinedCells(cells, [&](size_t f) {
    const double smaller = std::min(largest[size_t(cells.faceCells[2 * f])], largest[size_t(cells.faceCells[2 * f + 1])]);
    return cells.faceArea[f] >= kSlit * smaller;
  });
}

Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled) {
  Boundary boundary = boundaryOf(cells);
  const CellComponents parts = partsBetweenSlits(cells), components = cellComponents(cells);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  std::vector<double> in(parts.count), out(parts.count), all(components.count), lost(components.count);
  const auto cellOf = [&](size_t b) { return size_t(cells.faceCells[boundary.halfFaces[b]]); };
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t face = boundary.halfFaces[b] / 2;
    if (cells.faceTag[face] >= FaceTag::inner) continue;
    for (size_t d = 0; d < 3; ++d) boundary.value[b] += wind[d] * normals[3 * b + d];
    (boundary.value[b] < 0 ? in : out)[parts.cellComponent[cellOf(b)]] += std::fabs(boundary.value[b]) * cells.faceArea[face];
  }
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t p = parts.cellComponent[cellOf(b)], r = components.cellComponent[cellOf(b)];
    const double mine = boundary.value[b] < 0 ? in[p] : out[p],
                 flux = std::fabs(boundary.value[b]) * cells.faceArea[boundary.halfFaces[b] / 2];
    if (!(mine > 0)) continue;
    const double kept = std::min(in[p], out[p]) / mine;
    boundary.value[b] *= kept;
    all[r] += flux, lost[r] += flux * (1 - kept);
  }
  for (uint32_t r = 0; r < components.count; ++r) {
    if (lost[r] > 1e-9 * all[r]) throttled.push_back(r);  // more than rounding
  }
  return boundary;
}

}  // namespace mandoline::physics
