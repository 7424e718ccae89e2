#include "physics/fit_data.h"

#include <algorithm>
#include <cmath>

#include "base/large_array.h"
#include "physics/node_loops.h"
#include "physics/rows_of.h"

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
  Maker(const FitSource& source, const CellCoefficients& coefficients, unsigned threads)
      : cells_(source.cells),
        dual_(source.dual),
        edges_(source.edgesOfCells),
        problem_(source.problem),
        points_(pointsOf(cells_, problem_.dualPoints)),
        jumps_(coefficients.jumps),
        threads_(threads) {
    fit_.slope = coefficients.slope;
  }

  FitData run(const std::vector<uint32_t>* which) {
    setNeighbors(which);
    setCellData();
    numberData();
    setSizes();
    detail::makeLargeOnThreads(fit_.data, fit_.ids.size(), threads_);
    forBlocks(fit_.ids.size(), threads_, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) fit_.data[i] = isEdge(i) ? edgeDatum(fit_.ids[i]) : boundaryDatum(fit_.ids[i] - edgeCount());
    });
    setOtherSizes();
    return std::move(fit_);
  }

 private:
  size_t edgeCount() const { return dual_.edges.size(); }
  bool isEdge(size_t datum) const { return fit_.ids[datum] < edgeCount(); }
  bool jumps(size_t cell) const { return !jumps_.empty() && jumps_[cell]; }

  /// Whether none of a dual edge's cells is one where the coefficient jumps.
  bool isKnown(size_t e) const {
    bool isKnown = !jumps(dual_.edges[e].cell);
    for (const uint32_t f : dual_.faces[e]) isKnown &= !jumps(otherCell(cells_, dual_.edges[e], f));
    return isKnown;
  }

  /// Whether a cell has both sides of a triangle.
  bool isAroundRim(uint32_t cell) const {
    const auto halfFaces = cells_.halfFaces(cell);
    return std::any_of(halfFaces.begin(), halfFaces.end(), [&](uint32_t h) { return cells_.faceCells[h ^ 1] == int32_t(cell); });
  }

  /// Also finds out which cells' data are wanted.
  void setNeighbors(const std::vector<uint32_t>* which) {
    isWanted_.assign(cells_.cellCount(), !which);
    for (size_t i = 0; which && i < which->size(); ++i) isWanted_[(*which)[i]] = 1;
    fit_.cellNeighbors = rowsOf(cells_.cellCount(), threads_, [&](size_t c, std::vector<uint32_t>& row) {
      const auto add = [&](uint32_t cell) {
        if (!isAroundRim(cell)) row.push_back(cell);
      };
      if (!isWanted_[c]) return;
      for (const uint32_t e : edges_[c]) {
        if (!isKnown(e)) continue;
        for (const uint32_t f : dual_.faces[e]) {
          const uint32_t other = otherCell(cells_, dual_.edges[e], f);
          if (dual_.edges[e].cell == c) add(other);
          if (other == c) add(dual_.edges[e].cell);
        }
      }
    });
    if (!which) return;
    for (const uint32_t cell : fit_.cellNeighbors.items) isWanted_[cell] = 1;
  }

  /// By their ids.
  void setCellData() {
    const Boundary& boundary = problem_.boundary;
    const auto ofBoundary = detail::groupBy<uint32_t>(
        cells_.cellCount(), boundary.halfFaces.size(), [&](size_t b) { return size_t(cells_.faceCells[boundary.halfFaces[b]]); },
        [](size_t b) { return uint32_t(b); });
    fit_.cellData = rowsOf(cells_.cellCount(), threads_, [&](size_t c, std::vector<uint32_t>& row) {
      if (!isWanted_[c]) return;
      for (const uint32_t e : edges_[c]) {
        if (isKnown(e)) row.push_back(e);
      }
      for (const uint32_t b : ofBoundary[c]) row.push_back(uint32_t(edgeCount() + b));
    });
  }

  /// In the order of their ids.
  void numberData() {
    std::vector<uint32_t> numbers;
    detail::makeLargeOnThreads(numbers, edgeCount() + problem_.boundary.halfFaces.size(), threads_);
    for (const uint32_t id : fit_.cellData.items) numbers[id] = 1;
    for (uint32_t id = 0; id < numbers.size(); ++id) {
      if (numbers[id] == 0) continue;
      numbers[id] = uint32_t(fit_.ids.size());
      fit_.ids.push_back(id);
    }
    forBlocks(fit_.cellData.items.size(), threads_, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) fit_.cellData.items[i] = numbers[fit_.cellData.items[i]];
    });
  }

  /// The largest distance to a neighbour.
  void setSizes() {
    detail::makeLargeOnThreads(fit_.cellSize, cells_.cellCount(), threads_);
    forBlocks(cells_.cellCount(), threads_, [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        for (const uint32_t i : fit_.cellData[c]) {
          if (isEdge(i)) fit_.cellSize[c] = std::max(fit_.cellSize[c], dual_.edges[fit_.ids[i]].distance);
        }
      }
    });
  }

  /// Those of cells without neighbours.
  void setOtherSizes() {
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      if (fit_.cellSize[c] > 0) continue;
      double area = 0;
      for (const uint32_t i : fit_.cellData[c]) area += fit_.data[i].weight;
      fit_.cellSize[c] = std::sqrt(area / 6);
    }
  }

  FitDatum edgeDatum(size_t e) const {
    const DualEdge& edge = dual_.edges[e];
    Point others{};
    for (const uint32_t f : dual_.faces[e]) {
      const uint32_t other = otherCell(cells_, edge, f);
      for (size_t d = 0; d < 3; ++d) others[d] += shareOf(cells_, dual_, e, f) * points_[3 * other + d];
    }
    FitDatum datum = between(pointAt(points_, edge.cell), others, edge.area);
    if (dual_.faces[e].size() > 1 && datum.length > 0) addSpread(e, others, datum);
    return datum;
  }

  /// Half the second moments of the points of a dual edge's other cells about their mean.
  void addSpread(size_t e, const Point& mean, FitDatum& datum) const {
    for (const uint32_t f : dual_.faces[e]) {
      const uint32_t other = otherCell(cells_, dual_.edges[e], f);
      const double share = shareOf(cells_, dual_, e, f) / datum.length;
      Point r = pointAt(points_, other);
      for (size_t d = 0; d < 3; ++d) r[d] -= mean[d];
      for (size_t d = 0; d < 3; ++d) {
        datum.spread[d] += share * r[d] * r[d] / 2;
        datum.spread[3 + d] += share * r[d] * r[(d + 1) % 3];
      }
    }
  }

  FitDatum boundaryDatum(size_t b) const {
    const uint32_t h = problem_.boundary.halfFaces[b], f = h / 2, cell = uint32_t(cells_.faceCells[h]);
    const Point centroid = pointAt(cells_.faceCentroid, f);
    const double weight = kBoundaryWeight * cells_.faceArea[f];
    FitDatum datum{centroid, pointAt(cells_.faceNormal, f), 1, weight, {}};
    if (h % 2 == 1) {
      for (double& x : datum.direction) x = -x;
    }
    const Condition condition = problem_.boundary.condition[b];
    if (condition == Condition::neumann) return datum;
    const FitDatum difference = between(pointAt(points_, cell), centroid, weight);
    const double coefficient = problem_.boundary.coefficient[b];
    datum = condition == Condition::dirichlet ? difference : sumOf(datum, difference, coefficient);
    const double reach = difference.length + (condition == Condition::dirichlet ? 0 : 1 / coefficient), size = fit_.cellSize[cell];
    if (reach < size) datum.weight *= reach * reach / (size * size);
    return datum;
  }

  const CellComplex& cells_;
  const DualEdges& dual_;
  const detail::Csr<uint32_t>& edges_;  // per cell
  const PoissonProblem& problem_;
  const std::vector<double>& points_;
  const std::vector<char>& jumps_;
  const unsigned threads_;
  std::vector<char> isWanted_;  // per cell
  FitData fit_;
};

}  // namespace

FitData fitData(const FitSource& source, const std::vector<uint32_t>* which, const CellCoefficients& coefficients, unsigned threads) {
  return Maker(source, coefficients, threads).run(which);
}

std::vector<double> fitValues(const FitSource& source, const FitData& fit, const std::vector<double>& phi, unsigned threads) {
  const CellComplex& cells = source.cells;
  const DualEdges& dual = source.dual;
  const Boundary& boundary = source.problem.boundary;
  const auto differenceOf = [&](uint32_t id) {
    if (id < dual.edges.size()) return differenceAt(cells, dual, id, phi);
    const size_t b = id - dual.edges.size();
    if (boundary.condition[b] == Condition::neumann) return boundary.value[b];
    const double own = phi[size_t(cells.faceCells[boundary.halfFaces[b]])];
    return boundary.value[b] - (boundary.condition[b] == Condition::dirichlet ? 1 : boundary.coefficient[b]) * own;
  };
  std::vector<double> values;
  detail::makeLargeOnThreads(values, fit.data.size(), threads);
  forBlocks(values.size(), threads, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const double length = fit.data[i].length;
      values[i] = length > 0 ? differenceOf(fit.ids[i]) / length : 0;
    }
  });
  return values;
}

}  // namespace mandoline::physics
