#include "physics/fit_data.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace mandoline::physics {
namespace {

/// What is given on the boundary weighs more than differences of phi, so that a flow stays along the surface.
constexpr double kBoundaryWeight = 4;

/// Makes the direction a unit vector; where it is none, nothing is known.
void setLength(FitDatum& datum, double weight) {
  const Point& d = datum.direction;
  datum.length = std::sqrt(dot(d, d));
  if (!(datum.length > 0)) return;
  for (double& x : datum.direction) x /= datum.length;
  datum.weight = weight;
}

/// Half-way between two points, where a difference over their distance is the derivative to second order.
FitDatum between(const Point& a, const Point& b, double weight) {
  FitDatum datum{};
  for (size_t d = 0; d < 3; ++d) {
    datum.point[d] = (a[d] + b[d]) / 2;
    datum.direction[d] = b[d] - a[d];
  }
  setLength(datum, weight);
  return datum;
}

/// A derivative plus a coefficient times a difference of phi, as the derivative at a point between theirs: exactly, if their directions are
/// the same.
FitDatum sumOf(const FitDatum& derivative, const FitDatum& difference, double coefficient) {
  const double share = coefficient * difference.length;
  FitDatum sum{};
  for (size_t d = 0; d < 3; ++d) {
    sum.point[d] = (derivative.point[d] + share * difference.point[d]) / (1 + share);
    sum.direction[d] = derivative.direction[d] + share * difference.direction[d];
  }
  setLength(sum, derivative.weight);
  return sum;
}

class Maker {
 public:
  Maker(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem, const CellCoefficients& coefficients)
      : cells_(cells), dual_(dual), problem_(problem), points_(pointsOf(cells, problem.dualPoints)), jumps_(coefficients.jumps) {
    fit_.slope = coefficients.slope;
  }

  FitData run() {
    findRims();
    fit_.cellSize.resize(cells_.cellCount());
    for (size_t e = 0; e < dual_.edges.size(); ++e) addEdge(e);
    for (size_t b = 0; b < problem_.boundary.halfFaces.size(); ++b) addBoundary(b);
    fit_.cellData = grouped(ofCells_);
    fit_.cellNeighbors = grouped(neighbors_);
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      if (fit_.cellSize[c] > 0) continue;
      double area = 0;
      for (const uint32_t d : fit_.cellData[c]) area += fit_.data[d].weight;
      fit_.cellSize[c] = std::sqrt(area / 6);
    }
    return std::move(fit_);
  }

 private:
  struct ItemOfCell {
    uint32_t cell, item;
    auto operator<=>(const ItemOfCell&) const = default;
  };

  /// Notes the cells that have both sides of a triangle.
  void findRims() {
    aroundRim_.resize(cells_.cellCount());
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t cell = cells_.faceCells[2 * f];
      if (cell >= 0 && cell == cells_.faceCells[2 * f + 1]) aroundRim_[size_t(cell)] = 1;
    }
  }

  void addEdge(size_t e) {
    const DualEdge& edge = dual_.edges[e];
    const uint32_t id = uint32_t(fit_.data.size());
    Point others{};
    bool isKnown = !jumps(edge.cell);
    for (const uint32_t f : dual_.faces[e]) {
      const uint32_t other = otherCell(cells_, edge, f);
      for (size_t d = 0; d < 3; ++d) others[d] += shareOf(cells_, dual_, e, f) * points_[3 * other + d];
      isKnown &= !jumps(other);
    }
    fit_.data.push_back(between(pointAt(points_, edge.cell), others, edge.area));
    if (!isKnown) return;
    ofCells_.push_back({edge.cell, id});
    for (const uint32_t f : dual_.faces[e]) {
      const uint32_t other = otherCell(cells_, edge, f);
      ofCells_.push_back({other, id});
      join(edge.cell, other, edge.distance);
      join(other, edge.cell, edge.distance);
    }
  }

  bool jumps(size_t cell) const { return !jumps_.empty() && jumps_[cell]; }

  void join(uint32_t a, uint32_t b, double distance) {
    if (!aroundRim_[b]) neighbors_.push_back({a, b});
    fit_.cellSize[a] = std::max(fit_.cellSize[a], distance);
  }

  void addBoundary(size_t b) {
    const uint32_t h = problem_.boundary.halfFaces[b], f = h / 2, cell = uint32_t(cells_.faceCells[h]);
    ofCells_.push_back({cell, uint32_t(fit_.data.size())});
    const Point centroid = pointAt(cells_.faceCentroid, f);
    const double weight = kBoundaryWeight * cells_.faceArea[f];
    FitDatum datum{centroid, pointAt(cells_.faceNormal, f), 1, weight};
    if (h % 2 == 1) {
      for (double& x : datum.direction) x = -x;
    }
    const Condition condition = problem_.boundary.condition[b];
    if (condition != Condition::neumann) {
      const FitDatum difference = between(pointAt(points_, cell), centroid, weight);
      const double coefficient = problem_.boundary.coefficient[b];
      datum = condition == Condition::dirichlet ? difference : sumOf(datum, difference, coefficient);
      const double reach = difference.length + (condition == Condition::dirichlet ? 0 : 1 / coefficient), size = fit_.cellSize[cell];
      if (reach < size) datum.weight *= reach * reach / (size * size);
    }
    fit_.data.push_back(datum);
  }

  detail::Csr<uint32_t> grouped(std::vector<ItemOfCell>& pairs) const {
    detail::sortUnique(pairs);
    return detail::groupBy<uint32_t>(
        cells_.cellCount(), pairs.size(), [&](size_t i) { return size_t(pairs[i].cell); }, [&](size_t i) { return pairs[i].item; });
  }

  const CellComplex& cells_;
  const DualEdges& dual_;
  const PoissonProblem& problem_;
  const std::vector<double>& points_;
  const std::vector<char>& jumps_;
  std::vector<char> aroundRim_;  // per cell
  std::vector<ItemOfCell> ofCells_, neighbors_;
  FitData fit_;
};

}  // namespace

FitData fitData(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem, const CellCoefficients& coefficients) {
  return Maker(cells, dual, problem, coefficients).run();
}

std::vector<double> fitValues(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem, const FitData& fit,
                              const std::vector<double>& phi) {
  std::vector<double> values;
  values.reserve(fit.data.size());
  const auto add = [&](double difference) {
    const double length = fit.data[values.size()].length;
    values.push_back(length > 0 ? difference / length : 0);
  };
  for (size_t e = 0; e < dual.edges.size(); ++e) add(differenceAt(cells, dual, e, phi));
  const Boundary& boundary = problem.boundary;
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const double own = phi[size_t(cells.faceCells[boundary.halfFaces[b]])];
    if (boundary.condition[b] == Condition::neumann) {
      add(boundary.value[b]);
    } else {
      add(boundary.value[b] - (boundary.condition[b] == Condition::dirichlet ? 1 : boundary.coefficient[b]) * own);
    }
  }
  return values;
}

}  // namespace mandoline::physics
