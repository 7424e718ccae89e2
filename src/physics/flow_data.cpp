#include "physics/flow_data.h"

#include <algorithm>
#include <cmath>

namespace mandoline::physics {
namespace {

/// Values given on the boundary weigh more than differences of phi, so that the flow stays along the surface.
constexpr double kBoundaryWeight = 4;

std::array<double, 3> pointAt(const std::vector<double>& points, size_t i) { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }

/// Half-way between the dual points, where the difference of their values is the derivative to second order.
FlowDatum datumOf(const CellComplex& cells, const DualEdge& edge, std::span<const uint32_t> faces, const Flow& flow) {
  FlowDatum datum{pointAt(cells.cellCentre, edge.cell), pointAt(cells.faceNormal, faces[0]), flow.faceVelocity[faces[0]], edge.area};
  for (double& x : datum.point) x /= 2;
  for (const uint32_t f : faces) {
    const double share = shareOf(cells, edge, faces, f);
    const size_t other = otherCell(cells, edge, f);
    for (size_t d = 0; d < 3; ++d) datum.point[d] += share * cells.cellCentre[3 * other + d] / 2;
  }
  return datum;
}

/// Whether a cell has both sides of a triangle.
std::vector<char> cellsAroundRims(const CellComplex& cells) {
  std::vector<char> result(cells.cellCount());
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t cell = cells.faceCells[2 * f];
    if (cell >= 0 && cell == cells.faceCells[2 * f + 1]) result[size_t(cell)] = 1;
  }
  return result;
}

struct ItemOfCell {
  uint32_t cell, item;
  auto operator<=>(const ItemOfCell&) const = default;
};

/// Items of cells, ascending and each once.
detail::Csr<uint32_t> grouped(size_t cellCount, std::vector<ItemOfCell>& pairs) {
  detail::sortUnique(pairs);
  return detail::groupBy<uint32_t>(
      cellCount, pairs.size(), [&](size_t i) { return size_t(pairs[i].cell); }, [&](size_t i) { return pairs[i].item; });
}

}  // namespace

void fillFaceVelocities(const CellComplex& cells, const Boundary& boundary, const DualEdges& dual, Flow& flow) {
  flow.faceVelocity.assign(cells.faceCount(), 0);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const uint32_t h = boundary.halfFaces[b];
    if (boundary.value[b] != 0) flow.faceVelocity[h / 2] = h % 2 == 0 ? boundary.value[b] : -boundary.value[b];
  }
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const DualEdge& edge = dual.edges[e];
    double other = 0;
    for (const uint32_t f : dual.faces[e]) {
      other += shareOf(cells, edge, dual.faces[e], f) * flow.phi[otherCell(cells, edge, f)];
    }
    for (const uint32_t f : dual.faces[e]) flow.faceVelocity[f] = edge.sign * (other - flow.phi[edge.cell]) / edge.distance;
  }
}

FlowData flowData(const CellComplex& cells, const DualEdges& dual, const Flow& flow) {
  FlowData result;
  std::vector<ItemOfCell> ofCells, neighbors;
  const std::vector<char> aroundRim = cellsAroundRims(cells);
  result.cellSize.resize(cells.cellCount());
  const auto join = [&](uint32_t a, uint32_t b, double distance) {
    if (!aroundRim[b]) neighbors.push_back({a, b});
    result.cellSize[a] = std::max(result.cellSize[a], distance);
  };
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const DualEdge& edge = dual.edges[e];
    const uint32_t id = uint32_t(result.data.size());
    result.data.push_back(datumOf(cells, edge, dual.faces[e], flow));
    ofCells.push_back({edge.cell, id});
    for (const uint32_t f : dual.faces[e]) {
      const uint32_t other = otherCell(cells, edge, f);
      ofCells.push_back({other, id});
      join(edge.cell, other, edge.distance);
      join(other, edge.cell, edge.distance);
    }
  }
  for (uint32_t h = 0; h < 2 * cells.faceCount(); ++h) {
    if (cells.faceCells[h] < 0 || isInner(cells, h / 2)) continue;
    ofCells.push_back({uint32_t(cells.faceCells[h]), uint32_t(result.data.size())});
    const size_t f = h / 2;
    result.data.push_back(
        {pointAt(cells.faceCentroid, f), pointAt(cells.faceNormal, f), flow.faceVelocity[f], kBoundaryWeight * cells.faceArea[f]});
  }
  result.cellData = grouped(cells.cellCount(), ofCells);
  result.cellNeighbors = grouped(cells.cellCount(), neighbors);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    if (result.cellSize[c] > 0) continue;
    double area = 0;
    for (const uint32_t d : result.cellData[c]) area += result.data[d].weight;
    result.cellSize[c] = std::sqrt(area / 6);
  }
  return result;
}

}  // namespace mandoline::physics
