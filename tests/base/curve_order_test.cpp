// What is near along the curve, and what becomes of points that no curve goes through.
#include "base/curve_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "catch.h"

using namespace mandoline::detail;

namespace {

std::vector<uint32_t> orderOf(const std::vector<Point>& points) {
  std::vector<uint32_t> order;
  for (const KeyedItem& item : orderAlongCurve(points, [](size_t i) { return uint32_t(i); })) order.push_back(item.item);
  return order;
}

std::vector<Point> randomPoints(size_t count) {
  std::mt19937 random{7};
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Point> points(count);
  for (Point& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

}  // namespace

TEST_CASE("corners of a cube are passed by x first, then y, then z", "[curve]") {
  std::vector<Point> corners;
  for (const int i : {5, 2, 7, 0, 3, 6, 1, 4}) corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  CHECK(orderOf(corners) == std::vector<uint32_t>{3, 6, 1, 4, 7, 0, 5, 2});
}

TEST_CASE("equal points, and such that differ in their last bits alone, are passed by their ids where the curve passes them", "[curve]") {
  std::vector<Point> points = randomPoints(100);
  points.insert(points.end(), 50, {0.25, 0.25, 0.25});
  const std::vector<KeyedItem> order = orderAlongCurve(points, [](size_t i) { return uint32_t(1000 - i); });
  std::vector<uint32_t> equal;
  for (const KeyedItem& item : order) {
    if (item.item >= 100) equal.push_back(item.item);
  }
  CHECK(equal.size() == 50);
  CHECK(std::is_sorted(equal.begin(), equal.end(), std::greater<>()));
}

TEST_CASE("coordinates that are not finite are passed where 0 is, and each point once", "[curve]") {
  std::vector<Point> points = randomPoints(200), zeros = points;
  const double infinity = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < points.size(); i += 3) {
    points[i][i % 2] = std::array{infinity, -infinity, std::nan("")}[i % 9 / 3];
    zeros[i][i % 2] = 0;
  }
  std::vector<uint32_t> order = orderOf(points);
  CHECK(order == orderOf(zeros));
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < order.size(); ++i) REQUIRE(order[i] == i);
}

TEST_CASE("coordinates at both ends of what numbers hold are ordered without overflow", "[curve]") {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  CHECK(orderOf({{most, 0, 0}, {0, 0, 0}, {-most, 0, 0}}) == std::vector<uint32_t>{2, 1, 0});
  CHECK(orderOf({{least, 0, 0}, {-least, 0, 0}}).size() == 2);
  CHECK(orderOf({}).empty());
}
