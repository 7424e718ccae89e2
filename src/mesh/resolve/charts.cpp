#include "mesh/resolve/charts.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

using Corners = std::array<uint32_t, 3>;

/// Finds the charts of one range of triangles after the other, on one thread. Triangles count from the first of the range on; side 4 t + i
/// of triangle t leads from its corner i to the next.
class ChartGrower {
 public:
  explicit ChartGrower(const SortedMesh& mesh) : points_(mesh.points), firstOpen_(mesh.points.size(), kNone) {}

  /// Gives their number; they are numbered by their first triangles.
  uint32_t run(std::span<const Corners> triangles, std::span<uint32_t> charts) {
    constexpr uint32_t kApart = 256;  // the first seeds: charts that start beside each other hinder each other
    charts_ = charts;
    chart_ = 0;
    corners_.resize(4 * triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      corners_[4 * t] = corners_[4 * t + 3] = a;
      corners_[4 * t + 1] = b;
      corners_[4 * t + 2] = c;
    }
    findTwins();
    std::fill(charts_.begin(), charts_.end(), kNone);
    for (uint32_t first = 0; first < kApart; ++first) {
      for (uint32_t t = first; t < charts_.size(); t += kApart) {
        if (charts_[t] == kNone) grow(t);
      }
    }
    return numberInOrder();
  }

 private:
  /// Finds per side its twin: a side that runs between the same ends in the opposite direction and has this side as its twin. A few at
  /// crowded vertices may have none.
  void findTwins() {
    constexpr int kMostLooks = 32;
    twins_.resize(corners_.size());
    const uint32_t* const corners = corners_.data();
    uint32_t *const twins = twins_.data(), *const firstOpen = firstOpen_.data();  // sides without twins are chained, by where they start
    for (uint32_t first = 0; first < corners_.size(); first += 4) {
      for (uint32_t side = first; side < first + 3; ++side) {
        const uint32_t from = corners[side], to = corners[side + 1];
        uint32_t* link = &firstOpen[to];
        for (int i = 0; i < kMostLooks && *link != kNone && corners[*link + 1] != from; ++i) link = &twins[*link];
        const uint32_t other = *link;
        if (other != kNone && corners[other + 1] == from) {
          *link = twins[other];
          twins[other] = side;
          twins[side] = other;
        } else {
          twins[side] = firstOpen[from];
          firstOpen[from] = side;
        }
      }
    }
    for (const uint32_t from : corners_) {
      for (uint32_t open = std::exchange(firstOpen[from], kNone); open != kNone;) open = std::exchange(twins[open], kNone);
    }
  }

  uint32_t numberInOrder() {
    numbers_.assign(chart_, kNone);
    uint32_t count = 0;
    for (uint32_t& chart : charts_) {
      if (numbers_[chart] == kNone) numbers_[chart] = count++;
      chart = numbers_[chart];
    }
    return count;
  }

  void grow(uint32_t seed) {
    charts_[seed] = chart_;
    if (look(seed)) {
      grown_.assign(1, seed);
      for (size_t i = 0; i < grown_.size(); ++i) {
        const uint32_t first = 4 * grown_[i];
        for (uint32_t side = first; side < first + 3; ++side) {
          if (twins_[side] != kNone && charts_[twins_[side] / 4] == kNone) add(twins_[side]);
        }
      }
    }
    ++chart_;
  }

  /// Chooses how to look at a triangle, and its middle for the centre; false if rounding blurs it.
  bool look(uint32_t seed) {
    const uint32_t* v = &corners_[4 * seed];
    const Point &a = points_[v[0]], &b = points_[v[1]], &c = points_[v[2]];
    double largest = 0;
    for (size_t d = 0; d < 3; ++d) {
      const size_t p = (d + 1) % 3, q = (d + 2) % 3;
      const double area = (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
      if (std::fabs(area) <= std::fabs(largest)) continue;
      largest = area;
      axes_ = area > 0 ? std::array{p, q} : std::array{q, p};
    }
    if (largest == 0) return false;
    const auto [x, y, z] = cornersOf(seed);
    centre_ = {(x.x + y.x + z.x) / 3, (x.y + y.y + z.y) / 3};
    return surelyTurnsLeft(x, y, centre_) && surelyTurnsLeft(y, z, centre_) && surelyTurnsLeft(z, x, centre_);
  }

  /// Adds the triangle of a side whose twin is in the outline, which is of no chart so far, if the outline stays as it has to be.
  void add(uint32_t joining) {
    const uint32_t triangle = joining / 4;
    const auto corners = cornersOf(triangle);
    if (!surelyTurnsLeft(corners[0], corners[1], corners[2])) return;
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t twin = twins_[4 * triangle + i];
      const bool joins = twin != kNone && charts_[twin / 4] == chart_;  // as that of the side that joins does
      if (!joins && !surelyTurnsLeft(corners[i], corners[i == 2 ? 0 : i + 1], centre_)) return;
    }
    charts_[triangle] = chart_;
    grown_.push_back(triangle);
  }

  std::array<Point2, 3> cornersOf(uint32_t triangle) const {
    const uint32_t* v = &corners_[4 * triangle];
    const auto seen = [&](uint32_t corner) { return Point2{points_[corner][axes_[0]], points_[corner][axes_[1]]}; };
    return {seen(v[0]), seen(v[1]), seen(v[2])};
  }

  const LargeVector<Point>& points_;
  std::vector<uint32_t> firstOpen_;  // per point: a side that starts there and has no twin so far
  std::span<uint32_t> charts_;
  std::vector<uint32_t> corners_;  // per side: where it starts; behind the sides of a triangle, where the last one ends
  std::vector<uint32_t> twins_;    // per side
  std::vector<uint32_t> grown_;    // the triangles of the chart
  std::vector<uint32_t> numbers_;  // per chart, in the order in which they grew
  uint32_t chart_ = 0;
  std::array<size_t, 2> axes_{};  // seen as x and y
  Point2 centre_{};
};

}  // namespace

void ChartFinder::begin(const SortedMesh& mesh) {
  constexpr size_t kMost = 1 << 15;  // triangles of a range
  mesh_ = &mesh;
  charts_.chartOf.resize(mesh.triangles.size());
  counts_.resize((mesh.triangles.size() + kMost - 1) / kMost);
  hasBegun_ = true;
}

void ChartFinder::help() {
  if (!hasBegun_ || next_ >= counts_.size()) return;
  ChartGrower grower(*mesh_);
  const std::span<const Corners> triangles(mesh_->triangles);
  for (size_t r; (r = next_++) < counts_.size();) {
    const std::span<uint32_t> charts = rangeOf(r);
    counts_[r] = grower.run(triangles.subspan(size_t(charts.data() - charts_.chartOf.data()), charts.size()), charts);
  }
}

Charts ChartFinder::take() {
  for (size_t r = 0; r < counts_.size(); ++r) {
    for (uint32_t& chart : rangeOf(r)) chart += uint32_t(charts_.count);
    charts_.count += counts_[r];
  }
  return std::move(charts_);
}

std::span<uint32_t> ChartFinder::rangeOf(size_t r) {
  const size_t triangles = charts_.chartOf.size(), first = triangles * r / counts_.size();
  return std::span(charts_.chartOf).subspan(first, triangles * (r + 1) / counts_.size() - first);
}

Charts findCharts(const SortedMesh& mesh, Monitor& monitor) {
  ChartFinder finder;
  finder.begin(mesh);
  std::vector<uint32_t> helpers(monitor.threads());
  std::iota(helpers.begin(), helpers.end(), 0u);
  runItems(helpers, monitor, [&](size_t, uint32_t) { finder.help(); });
  return finder.take();
}

}  // namespace mandoline::detail
