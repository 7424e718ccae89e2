#include "physics/wind.h"

#include <algorithm>
#include <cmath>

#include "physics/joined_cells.h"

namespace mandoline::physics {
CellComponents partsBetweenSlits(const CellComplex& cells, const detail::Team& team) {
  constexpr double kSlit = 1e-6;
  std::vector<double> largest(cells.cellCount());
  forBlocks(cells.cellCount(), team, [&](size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      for (const uint32_t h : cells.halfFaces(c)) largest[c] = std::max(largest[c], cells.faceArea[h / 2]);
    }
  });
  return joinedCells(cells, team, [&](size_t f) {
    const double smaller = std::min(largest[size_t(cells.faceCells[2 * f])], largest[size_t(cells.faceCells[2 * f + 1])]);
    return cells.faceArea[f] >= kSlit * smaller;
  });
}

Boundary freeWind(const CellComplex& cells, const std::array<double, 3>& wind) {
  Boundary boundary = boundaryOf(cells);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    if (cells.faceTag[boundary.halfFaces[b] / 2] >= FaceTag::inner) continue;
    for (size_t d = 0; d < 3; ++d) boundary.value[b] += wind[d] * normals[3 * b + d];
  }
  return boundary;
}

template <class Visit>
static void forWind(const CellComplex& cells, const Boundary& boundary, const Visit& visit) {
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    visit(b, size_t(cells.faceCells[h]), std::fabs(boundary.value[b]) * cells.faceArea[h / 2]);
  }
}

WindThrough windThrough(const CellComplex& cells, const Boundary& boundary, std::span<const uint32_t> cellPart, uint32_t parts) {
  WindThrough wind{std::vector<double>(parts), std::vector<double>(parts)};
  forWind(cells, boundary, [&](size_t b, size_t cell, double flux) {
    if (cellPart[cell] < parts) (boundary.value[b] < 0 ? wind.in : wind.out)[cellPart[cell]] += flux;
  });
  return wind;
}

WindLost throttle(const CellComplex& cells, const WindThrough& wind, std::span<const uint32_t> cellPart, const CellComponents& components,
                  Boundary& boundary) {
  WindLost result{std::vector<double>(components.count), std::vector<double>(components.count)};
  forWind(cells, boundary, [&](size_t b, size_t cell, double flux) {
    const uint32_t p = cellPart[cell], r = components.cellComponent[cell];
    const double mine = p >= wind.in.size() ? 0 : boundary.value[b] < 0 ? wind.in[p] : wind.out[p];
    if (!(mine > 0)) return;
    const double kept = std::min(wind.in[p], wind.out[p]) / mine;
    boundary.value[b] *= kept;
    result.all[r] += flux, result.lost[r] += flux * (1 - kept);
  });
  return result;
}

std::vector<uint32_t> WindLost::throttled() const {
  std::vector<uint32_t> components;
  for (uint32_t r = 0; r < all.size(); ++r) {
    if (lost[r] > 1e-9 * all[r]) components.push_back(r);  // more than rounding
  }
  return components;
}

Boundary windBoundary(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<uint32_t>& throttled,
                      const detail::Team& team) {
  Boundary boundary = freeWind(cells, wind);
  const CellComponents parts = partsBetweenSlits(cells, team);
  const WindThrough through = windThrough(cells, boundary, parts.cellComponent, parts.count);
  throttled = throttle(cells, through, parts.cellComponent, componentsOf(cells, team), boundary).throttled();
  return boundary;
}

}  // namespace mandoline::physics
