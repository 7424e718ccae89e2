#include "physics/cubic_fits.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "base/mix.h"
#include "physics/cell_edges.h"
#include "physics/face_box.h"

namespace mandoline::physics {
namespace {

/// Less than for polynomials of degree two, since third derivatives weigh less.
constexpr double kThirdsTowardsZero = 3e-6;
/// Of what sources tell, which is known better than derivatives are.
constexpr double kSourceWeight = 3;

void addTo(Thirds& sum, double factor, const Thirds& product) {
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += factor * product[i];
}

}  // namespace

std::vector<uint32_t> cubicCells(const FitSource& source, const std::vector<uint32_t>& cells, bool besideCut) {
  const auto& [complex, dual, edgesOfCells, problem] = source;
  std::vector<char> isCubic(complex.cellLevel.begin(), complex.cellLevel.end()), isBesideCut(complex.cellCount());
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    const uint32_t cell = dual.edges[e].cell;
    for (const uint32_t f : dual.faces[e]) {
      const uint32_t other = otherCell(complex, dual.edges[e], f);
      if (complex.cellLevel[other] < complex.cellLevel[cell]) isCubic[other] = 1;
      if (std::min(cell, other) < complex.cutCells) isBesideCut[cell] = isBesideCut[other] = 1;
    }
  }
  std::vector<uint32_t> cubic;
  for (const uint32_t c : cells) {
    if (c >= complex.cutCells && isCubic[c] && (besideCut || !isBesideCut[c])) cubic.push_back(c);
  }
  return cubic;
}

CubicFitter::CubicFitter(const FitSource& source, const FitData& data, std::vector<uint32_t> which, bool isReused, detail::Monitor& monitor)
    : source_(source), which_(std::move(which)) {
  std::erase_if(which_, [&](uint32_t c) { return !(data.cellSize[c] > 0); });
  std::vector<uint64_t> keys(which_.size());
  items_ = rowsOf(which_.size(), monitor.threads(), [&](size_t i, std::vector<uint32_t>& items) {
    gather(data, which_[i], items);
    if (isReused) keys[i] = sortByEquation(data, which_[i], items);
  });
  if (isReused)
    findPatterns(data, keys, monitor.threads());
  else
    patterns_.assign(which_.size(), kNone);
}

/// The cell's data and those of its neighbours, each once, and these.
void CubicFitter::gather(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const {
  const auto add = [&](uint32_t c) { items.insert(items.end(), data.cellData[c].begin(), data.cellData[c].end()); };
  add(cell);
  for (const uint32_t n : data.cellNeighbors[cell]) {
    add(n);
    if (source_.problem.mass.empty()) items.push_back(uint32_t(data.data.size()) + n);  // a mass changes sources from size to size
  }
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Cells with the same equations, but for rounding, get the same number, and have them in the same order.
uint64_t CubicFitter::sortByEquation(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const {
  const auto add = [](uint64_t& sum, double x) {
    const double rounded = std::floor(x * 0x1p36 + 0.5) + 0.0;
    uint64_t bits;
    std::memcpy(&bits, &rounded, sizeof bits);
    sum = detail::mixed(sum, bits);
  };
  std::vector<std::pair<uint64_t, uint32_t>> numbered;
  for (const uint32_t item : items) {
    const Equation equation = equationOf(data, item, cell);
    uint64_t number = 0;
    for (const double x : equation.row) add(number, x);
    add(number, equation.along), add(number, equation.weight);
    numbered.push_back({number, item});
  }
  std::sort(numbered.begin(), numbered.end());
  uint64_t key = 0;
  for (size_t i = 0; i < items.size(); ++i) key = detail::mixed(key, numbered[i].first), items[i] = numbered[i].second;
  return key;
}

void CubicFitter::findPatterns(const FitData& data, const std::vector<uint64_t>& keys, unsigned threads) {
  std::unordered_map<uint64_t, uint32_t> patterns;
  std::vector<size_t> first;
  for (size_t i = 0; i < keys.size(); ++i) {
    const auto found = patterns.find(keys[i]);
    const bool isNew = found == patterns.end() && first.size() < kMostPatterns;
    patterns_.push_back(isNew ? uint32_t(first.size()) : found == patterns.end() ? kNone : found->second);
    if (isNew) patterns.emplace(keys[i], patterns_.back()), first.push_back(i);
  }
  weights_.resize(first.size());
  forBlocks(first.size(), threads, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) weights_[p] = weightsOf(data, first[p]);
  });
}

std::vector<CubicFitter::Equation> CubicFitter::equationsOf(const FitData& data, size_t i) const {
  std::vector<Equation> equations;
  equations.reserve(items_[i].size());
  for (const uint32_t item : items_[i]) equations.push_back(equationOf(data, item, which_[i]));
  return equations;
}

CubicFitter::Weights CubicFitter::weightsOf(const FitData& data, size_t i) const {
  const std::vector<Equation> equations = equationsOf(data, i);
  const Factors factors(equations, kThirdsTowardsZero);
  Weights weights;
  for (const Equation& equation : equations) {
    Factors::Row right = equation.row;
    for (double& x : right) x *= equation.weight;
    weights.ofValues.push_back(factors.solve(right));
    for (size_t u = 0; u < kUnknowns; ++u) weights.ofMean[u] -= equation.along * weights.ofValues.back()[u];
  }
  return weights;
}

CubicFitter::Equation CubicFitter::equationOf(const FitData& data, uint32_t item, uint32_t cell) const {
  const size_t count = data.data.size();
  return item < count ? derivativeEquation(data, item, cell) : sourceEquation(data, uint32_t(item - count), cell);
}

/// A difference of phi is the mean derivative between its ends, of which the second derivative is that along the direction. What is given
/// on a whole side of an octree cell is the mean derivative there. What is far weighs less than for polynomials of degree two.
CubicFitter::Equation CubicFitter::derivativeEquation(const FitData& data, uint32_t id, uint32_t cell) const {
  const FitDatum& datum = data.data[id];
  const double size = data.cellSize[cell], *centroid = &source_.cells.cellCentroid[3 * size_t(cell)];
  const FitEquation lower = physics::equationOf(datum, centroid, size, id);
  const Point& n = datum.direction;
  Point r;
  for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) / size;
  Thirds thirds{};
  addTo(thirds, 0.5, productOf(n, r, r));
  const size_t edges = source_.dual.edges.size();
  const bool isEdge = data.ids[id] < edges;
  const size_t b = isEdge ? 0 : data.ids[id] - edges;
  const Boundary& boundary = source_.problem.boundary;
  if (isEdge || boundary.condition[b] == Condition::dirichlet) {
    const double half = datum.length / size / 2;
    addTo(thirds, half * half / 6, productOf(n, n, n));
    Point end = r;
    for (size_t d = 0; d < 3; ++d) end[d] += half * n[d];
    const bool isSpread = isEdge && source_.dual.faces[data.ids[id]].size() > 1;
    for (size_t d = 0; isSpread && d < 3; ++d) {
      addTo(thirds, datum.spread[d] / size, productOf(kAxes[d], kAxes[d], end));
      addTo(thirds, datum.spread[3 + d] / size, productOf(kAxes[d], kAxes[(d + 1) % 3], end));
    }
  } else if (const uint32_t h = boundary.halfFaces[b]; size_t(source_.cells.faceCells[h]) >= source_.cells.cutCells) {
    const Point spread = spreadOf(source_.cells, h / 2);
    for (size_t d = 0; d < 3; ++d) addTo(thirds, spread[d] / (size * size), productOf(n, kAxes[d], kAxes[d]));
  }
  Equation equation{{}, lower.along, lower.weight / (0.25 + dot(r, r))};
  std::copy(lower.row.begin(), lower.row.end(), equation.row.begin());
  std::copy(thirds.begin(), thirds.end(), equation.row.begin() + FitEquation::kUnknowns);
  return equation;
}

/// The Laplacian changes from cell to cell as the source does.
CubicFitter::Equation CubicFitter::sourceEquation(const FitData& data, uint32_t neighbor, uint32_t cell) const {
  const std::vector<double>& centroids = source_.cells.cellCentroid;
  Thirds thirds{};
  for (size_t d = 0; d < 3; ++d) {
    Point step{};
    step[d] = (centroids[3 * size_t(neighbor) + d] - centroids[3 * size_t(cell) + d]) / data.cellSize[cell];
    for (const Point& axis : kAxes) addTo(thirds, 1, productOf(step, axis, axis));
  }
  Equation equation{{}, 0, kSourceWeight};
  std::copy(thirds.begin(), thirds.end(), equation.row.begin() + FitEquation::kUnknowns);
  return equation;
}

void CubicFitter::fit(const CellFits::Known& known, detail::Monitor& monitor, CellFits& fits) const {
  if (fits.thirdOf.empty()) {
    fits.thirdOf.assign(source_.cells.cellCount(), CellFits::kNoThirds);
    for (size_t i = 0; i < which_.size(); ++i) fits.thirdOf[which_[i]] = uint32_t(i);
    fits.third.resize(which_.size());
  }
  forBlocks(which_.size(), monitor.threads(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Factors::Row x = patterns_[i] == kNone ? unknownsOf(known, i) : weighted(known, i, weights_[patterns_[i]]);
      const double size = known.data.cellSize[which_[i]];
      FitEquation::Row lower;
      std::copy(x.begin(), x.begin() + FitEquation::kUnknowns, lower.begin());
      fits.set(which_[i], lower, size, known.source.empty() ? 0 : known.source[which_[i]] / 3);
      for (size_t t = 0; t < fits.third[i].size(); ++t) fits.third[i][t] = x[FitEquation::kUnknowns + t] / (size * size);
    }
  });
}

/// The right side of an equation, but for the mean second derivative.
double CubicFitter::valueOf(const CellFits::Known& known, uint32_t item, uint32_t cell) const {
  const size_t count = known.data.data.size();
  if (item < count) return known.values[item];
  return known.source.empty() ? 0 : known.data.cellSize[cell] * (known.source[item - count] - known.source[cell]);
}

CubicFitter::Factors::Row CubicFitter::unknownsOf(const CellFits::Known& known, size_t i) const {
  const uint32_t cell = which_[i];
  const double bend = known.source.empty() ? 0 : known.source[cell] / 3 * known.data.cellSize[cell];
  const std::vector<Equation> equations = equationsOf(known.data, i);
  Factors::Row right{};
  for (size_t k = 0; k < equations.size(); ++k) {
    const auto& [row, along, weight] = equations[k];
    const double value = weight * (valueOf(known, items_[i][k], cell) - bend * along);
    for (size_t u = 0; u < kUnknowns; ++u) right[u] += row[u] * value;
  }
  return Factors(equations, kThirdsTowardsZero).solve(right);
}

CubicFitter::Factors::Row CubicFitter::weighted(const CellFits::Known& known, size_t i, const Weights& weights) const {
  const uint32_t cell = which_[i];
  const double bend = known.source.empty() ? 0 : known.source[cell] / 3 * known.data.cellSize[cell];
  Factors::Row x;
  for (size_t u = 0; u < kUnknowns; ++u) x[u] = bend * weights.ofMean[u];
  const auto items = items_[i];
  for (size_t k = 0; k < items.size(); ++k) {
    const double value = valueOf(known, items[k], cell);
    for (size_t u = 0; u < kUnknowns; ++u) x[u] += weights.ofValues[k][u] * value;
  }
  return x;
}

}  // namespace mandoline::physics
