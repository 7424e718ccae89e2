#include "mesh/resolve/charts.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

using Corners = std::array<uint32_t, 3>;

/// Finds the charts of one range of triangles after the other, on one thread. Triangles count from the first of the range on. All about one
/// is in 8 numbers beside each other: side 8 t + i of triangle t leads from its corner i to the next.
class ChartGrower {
 public:
  explicit ChartGrower(const SortedMesh& mesh) : points_(mesh.points), firstOpen_(mesh.points.size(), kNone) {}

  /// Gives their number; they are numbered by their first triangles.
  uint32_t run(std::span<const Corners> triangles, std::span<uint32_t> charts) {
    constexpr uint32_t kApart = 256;  // the first seeds: charts that start beside each other hinder each other
    chart_ = 0;
    numbers_.resize(8 * triangles.size());
    uint32_t* at = numbers_.data();
    for (const auto& [a, b, c] : triangles) {
      const uint32_t numbers[8] = {a, b, c, a, kNone, kNone, kNone, kNone};
      std::copy(numbers, numbers + 8, at);
      at += 8;
    }
    findTwins();
    const uint32_t count = uint32_t(triangles.size());
    for (uint32_t first = 0; first < kApart; ++first) {
      for (uint32_t t = first; t < count; t += kApart) {
        if (chartOf(8 * t) == kNone) grow(8 * t);
      }
    }
    return numberInOrder(charts);
  }

 private:
  uint32_t start(uint32_t side) const { return numbers_.data()[side]; }
  uint32_t end(uint32_t side) const { return numbers_.data()[side + 1]; }
  uint32_t& twin(uint32_t side) { return numbers_.data()[side + 4]; }
  uint32_t& chartOf(uint32_t side) { return numbers_.data()[side | 7]; }

  /// Finds per side its twin: a side that runs between the same ends in the opposite direction and has this side as its twin. A few at
  /// crowded vertices may have none.
  void findTwins() {
    constexpr int kMostLooks = 32;
    uint32_t* const firstOpen = firstOpen_.data();  // sides without twins are chained, by where they start
    for (uint32_t first = 0; first < numbers_.size(); first += 8) {
      for (uint32_t side = first; side < first + 3; ++side) {
        const uint32_t from = start(side), to = end(side);
        uint32_t* link = &firstOpen[to];
        for (int i = 0; i < kMostLooks && *link != kNone && end(*link) != from; ++i) link = &twin(*link);
        const uint32_t other = *link;
        if (other != kNone && end(other) == from) {
          *link = twin(other);
          twin(other) = side;
          twin(side) = other;
        } else {
          twin(side) = firstOpen[from];
          firstOpen[from] = side;
        }
      }
    }
    for (uint32_t first = 0; first < numbers_.size(); first += 8) {
      for (uint32_t side = first; side < first + 3; ++side) {
        for (uint32_t open = std::exchange(firstOpen[start(side)], kNone); open != kNone;) open = std::exchange(twin(open), kNone);
      }
    }
  }

  uint32_t numberInOrder(std::span<uint32_t> charts) {
    newNumbers_.assign(chart_, kNone);
    uint32_t count = 0, side = 0;
    for (uint32_t& chart : charts) {
      uint32_t& number = newNumbers_[chartOf(side)];
      if (number == kNone) number = count++;
      chart = number;
      side += 8;
    }
    return count;
  }

  /// From a triangle, given by its first side.
  void grow(uint32_t seed) {
    chartOf(seed) = chart_;
    if (look(seed)) {
      grown_.assign(1, seed);
      for (size_t i = 0; i < grown_.size(); ++i) {
        const uint32_t first = grown_[i];
        for (uint32_t side = first; side < first + 3; ++side) {
          const uint32_t joining = twin(side);
          if (joining != kNone && chartOf(joining) == kNone) add(joining);
        }
      }
    }
    ++chart_;
  }

  /// Chooses how to look at a triangle, and its middle for the centre; false if rounding blurs it.
  bool look(uint32_t seed) {
    const uint32_t* v = &numbers_[seed];
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
    const Point2 x = seen(v[0]), y = seen(v[1]), z = seen(v[2]);
    centre_ = {(x.x + y.x + z.x) / 3, (x.y + y.y + z.y) / 3};
    return surelyTurnsLeft(x, y, centre_) && surelyTurnsLeft(y, z, centre_) && surelyTurnsLeft(z, x, centre_);
  }

  /// Adds the triangle of a side whose twin is in the outline, which is of no chart so far, if the outline stays as it has to be. What
  /// comes of each test is hard to predict: so all are made, and their results taken together.
  void add(uint32_t joining) {
    const uint32_t first = joining & ~7u, i = joining & 3;
    const uint32_t next = first + (i == 2 ? 0 : i + 1), last = first + (i == 0 ? 2 : i - 1);
    const Point2 a = seen(start(joining)), b = seen(start(next)), c = seen(start(last));
    const int keeps = int(surelyTurnsLeft(a, b, c)) & (int(joins(next)) | int(surelyTurnsLeft(b, c, centre_))) &
                      (int(joins(last)) | int(surelyTurnsLeft(c, a, centre_)));
    if (!keeps) return;
    chartOf(first) = chart_;
    grown_.push_back(first);
  }

  /// Whether the twin of a side, of a triangle of no chart, is in the chart.
  bool joins(uint32_t side) {
    const uint32_t other = twin(side);
    return chartOf(other == kNone ? side : other) == chart_;
  }

  Point2 seen(uint32_t corner) const {
    const Point& p = points_.data()[corner];
    return {p.data()[axes_[0]], p.data()[axes_[1]]};
  }

  const LargeVector<Point>& points_;
  std::vector<uint32_t> firstOpen_;   // per point: a side that starts there and has no twin so far
  LargeVector<uint32_t> numbers_;     // of each triangle its corners, the first one again, the twins of its sides, and its chart
  std::vector<uint32_t> grown_;       // the triangles of the chart, by their first sides
  std::vector<uint32_t> newNumbers_;  // per chart, in the order in which they grew
  uint32_t chart_ = 0;
  std::array<size_t, 2> axes_{};  // seen as x and y
  Point2 centre_{};
};

}  // namespace

void ChartFinder::begin(const SortedMesh& mesh) {
  constexpr size_t kMost = 1 << 15;  // triangles of a range
  mesh_ = &mesh;
  charts_.chartOf.resize(mesh.triangles.size());
  charts_.triangles.items.resize(mesh.triangles.size());
  ends_.resize((mesh.triangles.size() + kMost - 1) / kMost);
  hasBegun_ = true;
}

void ChartFinder::help() {
  if (!hasBegun_ || next_ >= ends_.size()) return;
  ChartGrower grower(*mesh_);
  const std::span<const Corners> triangles(mesh_->triangles);
  for (size_t r; (r = next_++) < ends_.size();) {
    const std::span<uint32_t> charts = rangeOf(r);
    const uint32_t first = uint32_t(charts.data() - charts_.chartOf.data());
    const uint32_t count = grower.run(triangles.subspan(first, charts.size()), charts);
    uint32_t* const byChart = charts_.triangles.items.data() + first;
    std::vector<uint32_t>& ends = ends_[r] = std::vector<uint32_t>(count, 0);
    for (const uint32_t chart : charts) ++ends[chart];
    toOffsets(ends);
    for (uint32_t t = 0; t < charts.size(); ++t) byChart[ends[charts[t]]++] = first + t;
  }
}

Charts ChartFinder::take() {
  for (size_t r = 0; r < ends_.size(); ++r) {
    const std::span<uint32_t> charts = rangeOf(r);
    for (uint32_t& chart : charts) chart += uint32_t(charts_.count);
    for (const uint32_t end : ends_[r]) charts_.triangles.offsets.push_back(uint32_t(charts.data() - charts_.chartOf.data()) + end);
    charts_.count += ends_[r].size();
  }
  return std::move(charts_);
}

std::span<uint32_t> ChartFinder::rangeOf(size_t r) {
  const size_t triangles = charts_.chartOf.size(), first = triangles * r / ends_.size();
  return std::span(charts_.chartOf).subspan(first, triangles * (r + 1) / ends_.size() - first);
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
