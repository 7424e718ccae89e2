#include "mesh/resolve/charts.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

using Corners = std::array<uint32_t, 3>;

/// Finds the charts of one range of triangles after the other, on one thread. Triangles and sides, 3 per triangle, count from those of the
/// range on.
class ChartGrower {
 public:
  explicit ChartGrower(const SortedMesh& mesh) : points_(mesh.points), firstOpen_(mesh.points.size(), kNone) {}

  /// Gives their number; they are numbered by their first triangles.
  uint32_t run(std::span<const Corners> triangles, std::span<uint32_t> charts) {
    constexpr uint32_t kApart = 256;  // the first seeds: charts that start beside each other hinder each other
    triangles_ = triangles;
    charts_ = charts;
    chart_ = 0;
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
    const uint32_t sides = uint32_t(3 * triangles_.size());
    twins_.resize(sides);  // sides without twins, by where they start, are chained in it
    for (uint32_t side = 0; side < sides; ++side) {
      const auto endsOf = [&](uint32_t s) {
        const uint32_t i = s % 3;
        const Corners& v = triangles_[s / 3];
        return std::array{v[i], v[i == 2 ? 0 : i + 1]};
      };
      const auto [from, to] = endsOf(side);
      uint32_t* link = &firstOpen_[to];
      for (int i = 0; i < kMostLooks && *link != kNone && endsOf(*link)[1] != from; ++i) link = &twins_[*link];
      const uint32_t other = *link;
      if (other != kNone && endsOf(other)[1] == from) {
        *link = twins_[other];
        twins_[other] = side;
        twins_[side] = other;
      } else {
        twins_[side] = firstOpen_[from];
        firstOpen_[from] = side;
      }
    }
    for (const Corners& v : triangles_) {
      for (const uint32_t from : v) {
        for (uint32_t open = std::exchange(firstOpen_[from], kNone); open != kNone;) open = std::exchange(twins_[open], kNone);
      }
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
        for (uint32_t side = 3 * grown_[i]; side < 3 * grown_[i] + 3; ++side) {
          if (twins_[side] != kNone) add(twins_[side]);
        }
      }
    }
    ++chart_;
  }

  /// Chooses how to look at a triangle, and its middle for the centre; false if rounding blurs it.
  bool look(uint32_t seed) {
    const Corners& v = triangles_[seed];
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

  /// Adds the triangle of a side whose twin is in the outline, if the outline stays as it has to be.
  void add(uint32_t joining) {
    const uint32_t triangle = joining / 3;
    if (charts_[triangle] != kNone) return;
    const auto corners = cornersOf(triangle);
    if (!surelyTurnsLeft(corners[0], corners[1], corners[2])) return;
    for (size_t i = 0; i < 3; ++i) {
      if (3 * triangle + i == joining) continue;
      const uint32_t twin = twins_[3 * triangle + i];
      const bool joins = twin != kNone && charts_[twin / 3] == chart_;
      if (!joins && !surelyTurnsLeft(corners[i], corners[i == 2 ? 0 : i + 1], centre_)) return;
    }
    charts_[triangle] = chart_;
    grown_.push_back(triangle);
  }

  std::array<Point2, 3> cornersOf(uint32_t triangle) const {
    const Corners& v = triangles_[triangle];
    const auto seen = [&](uint32_t corner) { return Point2{points_[corner][axes_[0]], points_[corner][axes_[1]]}; };
    return {seen(v[0]), seen(v[1]), seen(v[2])};
  }

  const std::vector<Point>& points_;
  std::vector<uint32_t> firstOpen_;  // per point: a side that starts there and has no twin so far
  std::span<const Corners> triangles_;
  std::span<uint32_t> charts_;
  std::vector<uint32_t> twins_, grown_, numbers_;  // grown_: the triangles of the chart
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
