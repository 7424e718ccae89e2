#include "physics/dual_edges.h"

#include <algorithm>
#include <cmath>

namespace mandoline::physics {
namespace {

class Finder {
 public:
  Finder(const CellComplex& cells, DualPoints dualPoints) : cells_(cells), points_(pointsOf(cells, dualPoints)) {}

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
    for (const uint32_t h : cells_.halfFaces(cell(f, side))) {
      const size_t other = h / 2;
      if (h % 2 == side && isInner(cells_, other) && level(other, 1 - side) < level(other, side) && axisOf(other) == axis)
        besides_.push_back(uint32_t(other));
    }
    return besides_.front();
  }
  size_t axisOf(size_t f) const {
    const double* n = &cells_.faceNormal[3 * f];
    return n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
  }

  void add(size_t f, size_t side, const std::vector<uint32_t>& faces) {
    if (faces.empty())
      result_.faces.items.push_back(uint32_t(f));
    else
      result_.faces.items.insert(result_.faces.items.end(), faces.begin(), faces.end());
    result_.faces.endGroup();
    DualEdge edge{uint32_t(cell(f, side)), side == 0 ? 1.0 : -1.0, 0, 0};
    double sum = 0, largest = 0;
    for (const uint32_t face : result_.faces[result_.edges.size()]) {
      edge.area += cells_.faceArea[face];
      sum += cells_.faceArea[face] * distance(face);
      largest = std::max(largest, distance(face));
    }
    edge.distance = edge.area > 0 ? std::min(sum / edge.area, largest) : largest;
    result_.edges.push_back(edge);
  }

  /// Along the normal. Inner faces lie in axial planes between the cells' dual points. Centroids of slivers may round onto the plane;
  /// they keep a billionth of their grid cells' distance.
  double distance(size_t f) const {
    const auto along = [&](const std::vector<double>& points) {
      double sum = 0;
      for (size_t d = 0; d < 3; ++d) sum += cells_.faceNormal[3 * f + d] * (points[3 * cell(f, 1) + d] - points[3 * cell(f, 0) + d]);
      return sum;
    };
    return std::max(along(points_), 1e-9 * along(cells_.cellCentre));
  }

  const CellComplex& cells_;
  const std::vector<double>& points_;
  std::vector<uint32_t> besides_;
  DualEdges result_;
};

}  // namespace

DualEdges dualEdges(const CellComplex& cells, DualPoints dualPoints) { return Finder(cells, dualPoints).run(); }

}  // namespace mandoline::physics
