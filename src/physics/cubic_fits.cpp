#include "physics/cubic_fits.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "base/mix.h"
#include "physics/face_box.h"
#include "physics/node_loops.h"
#include "physics/rows_of.h"

namespace mandoline::physics {
namespace {

/// Less than for polynomials of degree two, since third derivatives weigh less.
constexpr double kThirdsTowardsZero = 3e-6;
/// Of what sources tell, which is known better than derivatives are.
constexpr double kSourceWeight = 3;

/// Stands for numbers, but for rounding.
class Key {
 public:
  void mix(uint64_t word) { value_ = detail::mixed(value_, word); }
  void add(double x) {
    const double rounded = x + 0x1.8p16;  // to 36 bits after the point, unless it is large
    uint64_t bits;
    std::memcpy(&bits, &rounded, sizeof bits);
    mix(bits);
  }
  void addStep(const double* from, const double* to, double size) {
    for (size_t d = 0; d < 3; ++d) add((to[d] - from[d]) / size);
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

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
  const auto gatherAll = [&](const auto& f) { items_ = rowsOf(which_.size(), monitor.threads(), f); };
  if (!isReused) {
    gatherAll([&](size_t i, std::vector<uint32_t>& items) { gather(data, which_[i], items); });
    patterns_.assign(which_.size(), kNone);
    return;
  }
  const Shapes shapes = shapesOf(data, monitor.threads());
  std::vector<uint64_t> keys(which_.size());
  gatherAll([&](size_t i, std::vector<uint32_t>& items) { keys[i] = gatherByShape(data, shapes, which_[i], items); });
  findPatterns(data, keys, monitor.threads());
}

/// The cell's data and those of its neighbours, each once, and these.
void CubicFitter::gather(const FitData& data, uint32_t cell, std::vector<uint32_t>& items) const {
  const auto add = [&](uint32_t c) { items.insert(items.end(), data.cellData[c].begin(), data.cellData[c].end()); };
  add(cell);
  for (const uint32_t n : data.cellNeighbors[cell]) {
    add(n);
    if (hasSources()) items.push_back(uint32_t(data.data.size()) + n);
  }
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Those of the cells and their neighbours.
CubicFitter::Shapes CubicFitter::shapesOf(const FitData& data, unsigned threads) const {
  std::vector<char> isWanted(source_.cells.cellCount());
  for (const uint32_t c : which_) {
    isWanted[c] = 1;
    for (const uint32_t n : data.cellNeighbors[c]) isWanted[n] = 1;
  }
  Shapes shapes;
  shapes.keys.resize(isWanted.size());
  shapes.data = rowsOf(isWanted.size(), threads, [&](size_t c, std::vector<uint32_t>& row) {
    if (!isWanted[c]) return;
    std::vector<std::pair<uint64_t, uint32_t>> numbered;
    for (const uint32_t id : data.cellData[c]) numbered.push_back({keyOf(data, id, uint32_t(c)), id});
    std::sort(numbered.begin(), numbered.end());
    for (const auto& [key, id] : numbered) shapes.keys[c] = detail::mixed(shapes.keys[c], key), row.push_back(id);
  });
  return shapes;
}

/// Of all that its equation in the cell is made of.
uint64_t CubicFitter::keyOf(const FitData& data, uint32_t id, uint32_t cell) const {
  const FitDatum& datum = data.data[id];
  const double size = data.cellSize[cell];
  Key key;
  key.addStep(&source_.cells.cellCentroid[3 * size_t(cell)], datum.point.data(), size);
  for (const double x : datum.direction) key.add(x);
  key.add(datum.length / size), key.add(datum.weight / (size * size));
  const bool isMean = isOfSeveral(data, id), isDifference = isBetweenPoints(data, id);
  key.mix(isMean ? 2 : isDifference ? 1 : 0);
  for (size_t i = 0; isMean && i < datum.spread.size(); ++i) key.add(datum.spread[i] / size);
  if (isDifference) return key.value();
  for (const double x : spreadOnSide(data, id)) key.add(x / (size * size));
  return key.value();
}

/// The same as gather(), in an order that follows from shapes. Returns a key: cells with the same equations, but for rounding, have the
/// same.
uint64_t CubicFitter::gatherByShape(const FitData& data, const Shapes& shapes, uint32_t cell, std::vector<uint32_t>& items) const {
  const std::vector<double>& centroids = source_.cells.cellCentroid;
  const double size = data.cellSize[cell];
  std::vector<std::pair<uint64_t, uint32_t>> around;
  for (const uint32_t n : data.cellNeighbors[cell]) {
    Key key;
    key.addStep(&centroids[3 * size_t(cell)], &centroids[3 * size_t(n)], size);
    key.add(data.cellSize[n] / size), key.mix(shapes.keys[n]);
    around.push_back({key.value(), n});
  }
  std::sort(around.begin(), around.end());
  Key key;
  const auto add = [&](uint32_t item) {
    const bool isNew = std::find(items.begin(), items.end(), item) == items.end();
    if (isNew) items.push_back(item);
    key.mix(isNew);
  };
  key.mix(shapes.keys[cell]);
  for (const uint32_t id : shapes.data[cell]) add(id);
  for (const auto& [keyOfNeighbor, n] : around) {
    key.mix(keyOfNeighbor);
    if (hasSources()) add(uint32_t(data.data.size()) + n);
    for (const uint32_t id : shapes.data[n]) add(id);
  }
  return key.value();
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
  using Packs = std::array<Pack<kAtOnce>, kUnknowns>;
  for (size_t begin = 0; begin < equations.size(); begin += kAtOnce) {
    Packs right{};
    const size_t count = std::min(kAtOnce, equations.size() - begin);
    for (size_t k = 0; k < count; ++k) {
      for (size_t u = 0; u < kUnknowns; ++u) right[u].of[k] = equations[begin + k].weight * equations[begin + k].row[u];
    }
    const Packs unknowns = factors.solve(right);
    weights.ofValues.emplace_back();
    for (size_t k = 0; k < count; ++k) {
      for (size_t u = 0; u < kUnknowns; ++u) {
        weights.ofValues.back()[k][u] = unknowns[u].of[k];
        weights.ofMean[u] -= equations[begin + k].along * unknowns[u].of[k];
      }
    }
  }
  return weights;
}

CubicFitter::Equation CubicFitter::equationOf(const FitData& data, uint32_t item, uint32_t cell) const {
  const size_t count = data.data.size();
  return item < count ? derivativeEquation(data, item, cell) : sourceEquation(data, uint32_t(item - count), cell);
}

bool CubicFitter::isOfSeveral(const FitData& data, uint32_t id) const {
  return data.ids[id] < source_.dual.edges.size() && source_.dual.faces[data.ids[id]].size() > 1;
}

bool CubicFitter::isBetweenPoints(const FitData& data, uint32_t id) const {
  const size_t edges = source_.dual.edges.size();
  return data.ids[id] < edges || source_.problem.boundary.condition[data.ids[id] - edges] == Condition::dirichlet;
}

Point CubicFitter::spreadOnSide(const FitData& data, uint32_t id) const {
  const uint32_t h = source_.problem.boundary.halfFaces[data.ids[id] - source_.dual.edges.size()];
  return size_t(source_.cells.faceCells[h]) < source_.cells.cutCells ? Point{} : spreadOf(source_.cells, h / 2);
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
  if (isBetweenPoints(data, id)) {
    const double half = datum.length / size / 2;
    addTo(thirds, half * half / 6, productOf(n, n, n));
    Point end = r;
    for (size_t d = 0; d < 3; ++d) end[d] += half * n[d];
    const bool isMean = isOfSeveral(data, id);
    for (size_t d = 0; isMean && d < 3; ++d) {
      addTo(thirds, datum.spread[d] / size, productOf(kAxes[d], kAxes[d], end));
      addTo(thirds, datum.spread[3 + d] / size, productOf(kAxes[d], kAxes[(d + 1) % 3], end));
    }
  } else {
    const Point spread = spreadOnSide(data, id);
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
  for (size_t begin = 0; begin < items.size(); begin += kAtOnce) {
    double values[kAtOnce] = {};
    for (size_t k = 0; k < std::min(kAtOnce, items.size() - begin); ++k) values[k] = valueOf(known, items[begin + k], cell);
    const auto& [a, b, c, d] = weights.ofValues[begin / kAtOnce];
    for (size_t u = 0; u < kUnknowns; ++u) x[u] += values[0] * a[u] + values[1] * b[u] + values[2] * c[u] + values[3] * d[u];
  }
  return x;
}

}  // namespace mandoline::physics
