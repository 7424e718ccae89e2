// Gauss-Seidel on all threads.
#include "physics/sweep_order.h"

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

TEST_CASE("sweep order: coupled nodes are visited in their order, and backwards, on any number of threads", "[poisson]") {
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
  std::vector<double> expected(count);
  for (size_t i = 0; i < count; ++i) update(expected, i);
  for (size_t i = count; i-- > 0;) update(expected, i);
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
