// With the gradient g at the centroid and the symmetric matrix H of second derivatives, whose trace is t = source - slope . g: weighted
// least squares of n . (g + H r) - value over the data in and around the cell, where H = t / 3 + a matrix without a trace.
#include "physics/cell_fits.h"

#include <algorithm>
#include <numeric>

#include "base/large_array.h"
#include "physics/cell_fitter.h"
#include "physics/node_loops.h"

namespace mandoline::physics {
namespace {

using Row = FitEquation::Row;

inline FitEquation equationOf(const CellComplex& cells, const FitData& data, uint32_t id, size_t cell) {
  const double size = data.cellSize[cell];
  FitEquation equation = equationOf(data.data[id], &cells.cellCentroid[3 * cell], size, id);
  for (size_t d = 0; d < 3 && !data.slope.empty(); ++d) equation.row[d] -= equation.along * size * data.slope[3 * cell + d] / 3;
  return equation;
}

/// That of a cell's normal equations: the sum of their rows, times what `bend`, a third of the source times the size, leaves of their
/// values. The same as from these equations, which take three times as long to make.
Row rightSide(const CellFits::Known& known, size_t cell, double bend, std::span<const uint32_t> ids) {
  const FitData& data = known.data;
  const double size = data.cellSize[cell], inverse = 1 / size;
  const Point centroid = pointAt(known.cells.cellCentroid, cell);
  Point first{}, squares{}, mixed{};
  double alongs = 0;
  for (const uint32_t id : ids) {
    if (bend == 0 && known.values[id] == 0) continue;  // a wall, of which a cell may have many pieces
    const FitDatum& datum = data.data[id];
    const Point& n = datum.direction;
    Point r;
    for (size_t d = 0; d < 3; ++d) r[d] = (datum.point[d] - centroid[d]) * inverse;
    const double nearness = inverse / (0.25 + dot(r, r));
    Point s;
    for (size_t d = 0; d < 3; ++d) s[d] = datum.spread[d] * inverse + n[d] * r[d];
    const double along = s[0] + s[1] + s[2], value = datum.weight * nearness * nearness * (known.values[id] - bend * along);
    alongs += value * along;
    for (size_t d = 0; d < 3; ++d) {
      const size_t next = (d + 1) % 3;
      first[d] += value * n[d], squares[d] += value * s[d];
      mixed[d] += value * (datum.spread[3 + d] * inverse + n[d] * r[next] + n[next] * r[d]);
    }
  }
  for (size_t d = 0; d < 3 && !data.slope.empty(); ++d) first[d] -= alongs * size * data.slope[3 * cell + d] / 3;
  return {first[0], first[1], first[2], squares[0] - squares[2], squares[1] - squares[2], mixed[0], mixed[1], mixed[2]};
}

/// What is known of one cell after the other.
class Equations {
 public:
  Equations(const CellComplex& cells, const FitData& data) : cells_(cells), data_(data) {}

  /// The cell's data, each once: its own, then those of its neighbours.
  const std::vector<uint32_t>& gather(uint32_t cell) {
    isGathered_.resize(data_.data.size());
    ids_.clear();
    add(cell);
    for (const uint32_t n : data_.cellNeighbors[cell]) add(n);
    for (const uint32_t id : ids_) isGathered_[id] = false;
    return ids_;
  }
  const std::vector<FitEquation>& of(uint32_t cell, std::span<const uint32_t> ids) {
    equations_.clear();
    for (const uint32_t id : ids) equations_.push_back(equationOf(cells_, data_, id, cell));
    return equations_;
  }

 private:
  void add(uint32_t cell) {
    for (const uint32_t id : data_.cellData[cell]) {
      if (isGathered_[id]) continue;
      isGathered_[id] = true;
      ids_.push_back(id);
    }
  }

  const CellComplex& cells_;
  const FitData& data_;
  std::vector<bool> isGathered_;  // per datum
  std::vector<uint32_t> ids_;
  std::vector<FitEquation> equations_;
};

/// Runs f(equations, i) for 0..n on all threads.
template <class F>
void forCells(const CellComplex& cells, const FitData& data, size_t n, detail::Monitor& monitor, const F& f) {
  std::vector<uint32_t> blocks(blockCount(n));
  std::iota(blocks.begin(), blocks.end(), 0u);
  std::vector<Equations> equations(monitor.threads(), Equations(cells, data));
  detail::runItems(blocks, monitor, [&](size_t thread, uint32_t block) {
    for (size_t i = block * kBlock; i < std::min((block + 1) * kBlock, n); ++i) f(equations[thread], i);
  });
}

}  // namespace

CellFits::CellFits(size_t cellCount, unsigned threads) {
  detail::makeLargeOnThreads(gradient, 3 * cellCount, threads);
  detail::makeLargeOnThreads(second, 6 * cellCount, threads);
}

void CellFits::set(size_t cell, const Row& x, double size, double mean) {
  std::copy(x.begin(), x.begin() + 3, &gradient[3 * cell]);
  const double found[6] = {x[3], x[4], -x[3] - x[4], x[5], x[6], x[7]};
  for (size_t j = 0; j < 6; ++j) second[6 * cell + j] = found[j] / size + (j < 3 ? mean : 0);
}

void CellFits::fit(const Known& known, uint32_t c, const FitFactors& factors, std::span<const uint32_t> ids) {
  double mean = known.source.empty() ? 0 : known.source[c] / 3;
  const double size = known.data.cellSize[c];
  const Row x = factors.solve(rightSide(known, c, mean * size, ids));
  for (size_t d = 0; d < 3 && !known.data.slope.empty(); ++d) mean -= x[d] * known.data.slope[3 * c + d] / 3;
  set(c, x, size, mean);
}

void fitCells(std::span<const uint32_t> which, const CellFits::Known& known, detail::Monitor& monitor, CellFits& fits) {
  forCells(known.cells, known.data, which.size(), monitor, [&](Equations& equations, size_t i) {
    const uint32_t c = which[i];
    if (!(known.data.cellSize[c] > 0)) return;
    const std::vector<uint32_t>& ids = equations.gather(c);
    fits.fit(known, c, FitFactors(equations.of(c, ids)), ids);
  });
}

CellFitter::CellFitter(const FitSource& source, FitData data, std::vector<uint32_t> which, std::vector<uint32_t> cubic,
                       detail::Monitor& monitor)
    : cells_(source.cells),
      data_(std::move(data)),
      cubic_(source, data_, cubic, true, monitor),
      fits_(cells_.cellCount(), monitor.threads()) {
  std::erase_if(which, [&](uint32_t c) { return !(data_.cellSize[c] > 0) || std::binary_search(cubic.begin(), cubic.end(), c); });
  which_ = std::move(which);
  std::vector<std::vector<uint32_t>> ids(which_.size());
  factors_.resize(which_.size());
  forCells(cells_, data_, which_.size(), monitor, [&](Equations& equations, size_t i) {
    ids[i] = equations.gather(which_[i]);
    factors_[i] = FitFactors(equations.of(which_[i], ids[i]));
  });
  for (const std::vector<uint32_t>& ofCell : ids) {
    ids_.items.insert(ids_.items.end(), ofCell.begin(), ofCell.end());
    ids_.endGroup();
  }
}

const CellFits& CellFitter::fit(const std::vector<double>& values, const std::vector<double>& source, detail::Monitor& monitor) {
  const CellFits::Known known{cells_, data_, values, source};
  forBlocks(which_.size(), monitor.threads(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) fits_.fit(known, which_[i], factors_[i], ids_[i]);
  });
  cubic_.fit(known, monitor, fits_);
  return fits_;
}

}  // namespace mandoline::physics
