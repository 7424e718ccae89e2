#include "mesh/resolve/charts.h"

#include <utility>

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

/// Per side, 3 per triangle, its twin: a side that runs between the same ends in the opposite direction and has this side as its twin. A
/// few at crowded vertices may have none.
std::vector<uint32_t> findTwins(const SortedMesh& mesh) {
  constexpr int kMostLooks = 32;
  const uint32_t sides = uint32_t(3 * mesh.triangles.size());
  std::vector<uint32_t> twins(sides),
      firstOpen(mesh.points.size(), kNone);  // sides without twins, by where they start, are chained in twins
  for (uint32_t side = 0; side < sides; ++side) {
    const auto endsOf = [&](uint32_t s) {
      const uint32_t i = s % 3;
      const auto& v = mesh.triangles[s / 3];
      return std::array{v[i], v[i == 2 ? 0 : i + 1]};
    };
    const auto [from, to] = endsOf(side);
    uint32_t* link = &firstOpen[to];
    for (int i = 0; i < kMostLooks && *link != kNone && endsOf(*link)[1] != from; ++i) link = &twins[*link];
    const uint32_t other = *link;
    if (other != kNone && endsOf(other)[1] == from) {
      *link = twins[other];
      twins[other] = side;
      twins[side] = other;
    } else {
      twins[side] = firstOpen[from];
      firstOpen[from] = side;
    }
  }
  for (uint32_t open : firstOpen) {
    while (open != kNone) open = std::exchange(twins[open], kNone);
  }
  return twins;
}

class ChartGrower {
 public:
  explicit ChartGrower(const SortedMesh& mesh) : mesh_(mesh), twins_(findTwins(mesh)), charts_(mesh.triangles.size(), kNone) {}

  Charts run() {
    constexpr uint32_t kApart = 256;  // the first seeds: charts that start beside each other hinder each other
    for (uint32_t first = 0; first < kApart; ++first) {
      for (uint32_t t = first; t < charts_.size(); t += kApart) {
        if (charts_[t] == kNone) grow(t);
      }
    }
    return numberInOrder();
  }

 private:
  /// Numbers charts by their first triangles.
  Charts numberInOrder() {
    std::vector<uint32_t> numbers(chart_, kNone);
    uint32_t count = 0;
    for (uint32_t& chart : charts_) {
      if (numbers[chart] == kNone) numbers[chart] = count++;
      chart = numbers[chart];
    }
    return {count, std::move(charts_)};
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
    const auto& v = mesh_.triangles[seed];
    const Point &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
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
    const auto& v = mesh_.triangles[triangle];
    const auto seen = [&](uint32_t corner) { return Point2{mesh_.points[corner][axes_[0]], mesh_.points[corner][axes_[1]]}; };
    return {seen(v[0]), seen(v[1]), seen(v[2])};
  }

  const SortedMesh& mesh_;
  std::vector<uint32_t> twins_, charts_, grown_;  // grown_: the triangles of the chart
  uint32_t chart_ = 0;
  std::array<size_t, 2> axes_{};  // seen as x and y
  Point2 centre_{};
};

}  // namespace

Charts findCharts(const SortedMesh& mesh) { return ChartGrower(mesh).run(); }

}  // namespace mandoline::detail
