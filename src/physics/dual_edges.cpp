#include "physics/dual_edges.h"

#include <algorithm>
#include <cmath>

namespace mandoline::physics {
namespace {

class Finder {
 public:
  Finder(const CellComplex& cells, DualPoints dualPoints, std::vector<double> coefficients)
      : cells_(cells), points_(pointsOf(cells, dualPoints)) {
    result_.coefficients = std::move(coefficients);
  }

  DualEdges run() {
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      if (!isInner(cells_, f)) continue;
      const size_t side = level(f, 1) > level(f, 0) ? 1 : 0;  // that of the one cell
      if (level(f, side) == level(f, 1 - side))
        add(f, side, {});
      else if (f == firstBeside(f, side))
        add(f, side, besides_);
    }
    return std::move(result_);
  }

 private:
  uint8_t level(size_t f, size_t side) const { return cells_.cellLevel[cell(f, side)]; }
  size_t cell(size_t f, size_t side) const { return size_t(cells_.faceCells[2 * f + side]); }

  /// Finds the faces on the side of the larger cell that face f is on. Their first one.
  size_t firstBeside(size_t f, size_t side) {
    besides_.clear();
    const size_t axis = axisOf(f);
    const double plane = placeOf(f, axis);
    for (const uint32_t h : cells_.halfFaces(cell(f, side))) {
      const size_t other = h / 2;
      if (h % 2 == side && isInner(cells_, other) && level(other, 1 - side) < level(other, side) && axisOf(other) == axis &&
          placeOf(other, axis) == plane)
        besides_.push_back(uint32_t(other));
    }
    return besides_.front();
  }
  size_t axisOf(size_t f) const {
    const double* n = &cells_.faceNormal[3 * f];
    return n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
  }
  /// Merged cells have several sides across one axis.
  double placeOf(size_t f, size_t axis) const { return cells_.positions[3 * size_t(cells_.loops(f)[0][0]) + axis]; }

  void add(size_t f, size_t side, const std::vector<uint32_t>& faces) {
    if (faces.empty())
      result_.faces.items.push_back(uint32_t(f));
    else
      result_.faces.items.insert(result_.faces.items.end(), faces.begin(), faces.end());
    result_.faces.endGroup();
    DualEdge edge{uint32_t(cell(f, side)), side == 0 ? 1.0 : -1.0, 0, 0, 0};
    double sum = 0, largest = 0;
    for (const uint32_t face : result_.faces[result_.edges.size()]) {
      const double flow = result_.flowOf(cells_, face);
      edge.area += cells_.faceArea[face];
      edge.flow += flow;
      sum += flow * distance(face);
      largest = std::max(largest, distance(face));
    }
    edge.distance = edge.flow > 0 ? std::min(sum / edge.flow, largest) : largest;
    result_.edges.push_back(edge);
  }

  /// Along the normal. Inner faces lie in axial planes between the cells' dual points. Centroids of slivers may round onto the plane;
  /// they keep a billionth of their grid cells' distance. Merged cells may lie around each other: with them it is at least a twentieth of
  /// the distance itself; or that of their centroids where both have the same dual point.
  double distance(size_t f) const {
    if (cells_.cellMemberOffsets.empty()) return std::max(along(points_, f).normal, 1e-9 * along(cells_.cellCentre, f).normal);
    const Along dual = along(points_, f), other = dual.all > 0 ? dual : along(cells_.cellCentroid, f);
    return other.all > 0 ? std::max(other.normal, other.all / 20) : 1e-9 * sizeOf(cell(f, 0));
  }
  double sizeOf(size_t c) const {
    double largest = 0;
    for (const uint32_t h : cells_.halfFaces(c)) largest = std::max(largest, cells_.faceArea[h / 2]);
    return std::sqrt(largest);
  }

  /// From the point of one cell at a face to that of the other: how far along the normal, and in all.
  struct Along {
    double normal, all;
  };
  Along along(const std::vector<double>& points, size_t f) const {
    double sum = 0, square = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double difference = points[3 * cell(f, 1) + d] - points[3 * cell(f, 0) + d];
      sum += cells_.faceNormal[3 * f + d] * difference;
      square += difference * difference;
    }
    return {sum, std::sqrt(square)};
  }

  const CellComplex& cells_;
  const std::vector<double>& points_;
  std::vector<uint32_t> besides_;
  DualEdges result_;
};

}  // namespace

DualEdges dualEdges(const CellComplex& cells, DualPoints dualPoints, std::vector<double> coefficients) {
  return Finder(cells, dualPoints, std::move(coefficients)).run();
}

}  // namespace mandoline::physics
