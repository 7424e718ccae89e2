// Gauss-Seidel on all threads.
#include "physics/sweep_order.h"

#include <algorithm>
#include <numeric>

#include "catch.h"

using namespace mandoline;

namespace {

/// Nodes that are coupled with some just before them, and with others at any distance.
std::vector<std::vector<uint32_t>> lowerNodes(uint32_t count) {
  std::vector<std::vector<uint32_t>> lower(count);
  uint32_t random = 1;
  for (uint32_t i = 1; i < count; ++i) {
    random = random * 1664525 + 1013904223;
    lower[i].push_back(i - 1);
    if (random % 64 == 0) lower[i].push_back(i > 5000 ? i - 5000 : 0);
    if (random % 1024 == 0) lower[i].push_back((random >> 10) % i);
  }
  return lower;
}

}  // namespace

TEST_CASE("sweep order: nodes that are coupled are visited in its order, and backwards, on any number of threads", "[poisson]") {
  const uint32_t count = 100'000;
  const auto lower = lowerNodes(count);
  std::vector<std::vector<uint32_t>> higher(count);
  for (uint32_t i = 0; i < count; ++i) {
    for (const uint32_t j : lower[i]) higher[j].push_back(i);
  }
  const physics::SweepOrder order(count, [&](size_t i, const auto& visit) {
    for (const uint32_t j : lower[i]) visit(j);
  });
  const auto update = [&](std::vector<double>& x, size_t i) {
    double sum = 1;
    for (const uint32_t j : lower[i]) sum += x[j];
    for (const uint32_t j : higher[i]) sum += x[j];
    x[i] = sum / 7;
  };
  std::vector<uint32_t> nodes(count);
  std::iota(nodes.begin(), nodes.end(), 0u);
  std::sort(nodes.begin(), nodes.end(), [&](uint32_t i, uint32_t j) { return order.isBefore(i, j); });
  std::vector<double> expected(count);
  for (size_t k = 0; k < count; ++k) update(expected, nodes[k]);
  for (size_t k = count; k-- > 0;) update(expected, nodes[k]);
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    std::vector<double> x(count);
    order.forwards(threads, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) update(x, i);
    });
    order.backwards(threads, [&](size_t begin, size_t end) {
      for (size_t i = end; i-- > begin;) update(x, i);
    });
    CHECK(x == expected);
  }
}

TEST_CASE("sweep order: of blocks in a row every second one comes first, so that half of them can be done at once", "[poisson]") {
  const uint32_t count = 20 * physics::kBlock;
  const physics::SweepOrder order(count, [&](size_t i, const auto& visit) {
    if (i > 0) visit(i - 1);
  });
  for (size_t a = 0; a < 20; ++a) {
    for (size_t b = 0; b < 20; ++b) {
      const bool isBefore = a % 2 == b % 2 ? a < b : a % 2 == 0;
      CHECK(order.isBefore(a * physics::kBlock, b * physics::kBlock + 1) == (isBefore || a == b));
    }
  }
}
