// With the gradient g at the centroid and the symmetric matrix H of second derivatives, whose trace is t = source - slope . g: weighted
// least squares of n . (g + H r) - value over the data in and around the cell, where H = t / 3 + a matrix without a trace.
#include "physics/cell_fits.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace mandoline::physics {
namespace {

using Row = FitFactors::Row;  // g; xx, yy, xy, yz, xz of H without its trace, times the cell's size
constexpr size_t kUnknowns = FitFactors::kUnknowns;

/// What a datum tells of a cell's polynomial: row * unknowns + along * size * (a third of the source) = value.
struct Equation {
  Row row;
  double along, weight;
};

/// Inline, since fits are a tenth quicker so.
inline Equation equationOf(const CellComplex& cells, const FitData& data, uint32_t id, size_t cell) {
  const FitDatum& datum = data.data[id];
  const double *centroid = &cells.cellCentroid[3 * cell], size = data.cellSize[cell];
  const Point& n = datum.direction;
  double r[3], square = 0, along = 0;
  for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) / size, square += r[d] * r[d], along += n[d] * r[d];
  const double nearness = 1 / (0.25 + square), weight = datum.weight / (size * size) * nearness * nearness;
  Row row{n[0],
          n[1],
          n[2],
          n[0] * r[0] - n[2] * r[2],
          n[1] * r[1] - n[2] * r[2],
          n[0] * r[1] + n[1] * r[0],
          n[1] * r[2] + n[2] * r[1],
          n[0] * r[2] + n[2] * r[0]};
  for (size_t d = 0; d < 3 && !data.slope.empty(); ++d) row[d] -= along * size * data.slope[3 * cell + d] / 3;
  return {row, along, weight};
}

void gatherData(const FitData& data, uint32_t cell, std::vector<uint32_t>& ids) {
  ids.assign(data.cellData[cell].begin(), data.cellData[cell].end());
  for (const uint32_t n : data.cellNeighbors[cell]) ids.insert(ids.end(), data.cellData[n].begin(), data.cellData[n].end());
  detail::sortUnique(ids);
}

}  // namespace

FitFactors::FitFactors(const CellComplex& cells, const FitData& data, uint32_t cell, std::span<const uint32_t> ids) {
  std::array<Row, kUnknowns> matrix{};  // lower triangle
  for (const uint32_t id : ids) {
    const auto [row, along, weight] = equationOf(cells, data, id, cell);
    for (size_t i = 0; i < kUnknowns; ++i) {
      for (size_t j = 0; j <= i; ++j) matrix[i][j] += weight * row[i] * row[j];
    }
  }
  constexpr double kTowardsZero = 1e-4;
  double trace = 0;
  for (size_t i = 0; i < kUnknowns; ++i) trace += matrix[i][i];
  for (size_t i = 3; i < kUnknowns; ++i) matrix[i][i] += kTowardsZero * trace;
  for (size_t j = 0; j < kUnknowns; ++j) {  // Cholesky: matrix = L D L^T
    const bool isOpen = !(matrix[j][j] > 1e-13 * trace);
    pivot_[j] = isOpen ? 0 : 1 / matrix[j][j];
    for (size_t i = j + 1; i < kUnknowns; ++i) {
      const double factor = at(i, j) = matrix[i][j] * pivot_[j];
      for (size_t k = j + 1; k <= i; ++k) matrix[i][k] -= factor * matrix[k][j];
    }
  }
}

FitFactors::Row FitFactors::solve(Row x) const {
  for (size_t j = 0; j < kUnknowns; ++j) {
    for (size_t i = j + 1; i < kUnknowns; ++i) x[i] -= at(i, j) * x[j];
  }
  for (size_t j = kUnknowns; j-- > 0;) {
    x[j] *= pivot_[j];
    for (size_t i = j + 1; i < kUnknowns; ++i) x[j] -= at(i, j) * x[i];
  }
  return x;
}

CellFits::CellFits(size_t cellCount) : gradient(3 * cellCount), second(6 * cellCount) {}

void CellFits::fit(const CellComplex& cells, const Known& known, uint32_t c, const FitFactors& factors, std::span<const uint32_t> ids) {
  const double size = known.data.cellSize[c];
  double mean = known.source.empty() ? 0 : known.source[c] / 3;
  Row right{};
  for (const uint32_t id : ids) {
    const auto [row, along, weight] = equationOf(cells, known.data, id, c);
    const double value = weight * (known.values[id] - mean * size * along);
    for (size_t i = 0; i < kUnknowns; ++i) right[i] += row[i] * value;
  }
  const Row x = factors.solve(right);
  std::copy(x.begin(), x.begin() + 3, &gradient[3 * c]);
  for (size_t d = 0; d < 3 && !known.data.slope.empty(); ++d) mean -= x[d] * known.data.slope[3 * c + d] / 3;
  const double found[6] = {x[3], x[4], -x[3] - x[4], x[5], x[6], x[7]};
  for (size_t j = 0; j < 6; ++j) second[6 * c + j] = found[j] / size + (j < 3 ? mean : 0);
}

CellFits fitAll(const CellComplex& cells, const CellFits::Known& known, detail::Monitor& monitor) {
  CellFits fits(cells.cellCount());
  detail::forChunks<std::vector<uint32_t>>(cells.cellCount(), monitor, [&](std::vector<uint32_t>& ids, size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) {
      if (!(known.data.cellSize[c] > 0)) continue;
      gatherData(known.data, uint32_t(c), ids);
      fits.fit(cells, known, uint32_t(c), FitFactors(cells, known.data, uint32_t(c), ids), ids);
    }
  });
  return fits;
}

CellFitter::CellFitter(const CellComplex& cells, FitData data, std::vector<uint32_t> which, detail::Monitor& monitor)
    : cells_(cells), data_(std::move(data)) {
  std::erase_if(which, [&](uint32_t c) { return !(data_.cellSize[c] > 0); });
  which_ = std::move(which);
  struct Part {
    detail::Csr<uint32_t> ids;
    std::vector<FitFactors> factors;
    std::vector<uint32_t> gathered;
  };
  const auto parts = detail::forChunks<Part>(which_.size(), monitor, [&](Part& part, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      gatherData(data_, which_[i], part.gathered);
      part.factors.emplace_back(cells, data_, which_[i], part.gathered);
      part.ids.items.insert(part.ids.items.end(), part.gathered.begin(), part.gathered.end());
      part.ids.endGroup();
    }
  });
  for (const Part& part : parts) {
    ids_.append(part.ids);
    factors_.insert(factors_.end(), part.factors.begin(), part.factors.end());
  }
}

CellFits CellFitter::fit(const std::vector<double>& values, const std::vector<double>& source, detail::Monitor& monitor) const {
  CellFits fits(cells_.cellCount());
  detail::forChunks<std::monostate>(which_.size(), monitor, [&](std::monostate&, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) fits.fit(cells_, {data_, values, source}, which_[i], factors_[i], ids_[i]);
  });
  return fits;
}

}  // namespace mandoline::physics
