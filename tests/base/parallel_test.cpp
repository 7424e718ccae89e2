#include "base/parallel.h"

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "catch.h"
#include "mandoline/status.h"

using namespace mandoline;
using namespace mandoline::detail;

TEST_CASE("Of items that fail the lowest one's failure is thrown, in whatever order they come", "[parallel]") {
  std::vector<uint32_t> descending(100);
  for (uint32_t i = 0; i < 100; ++i) descending[i] = 99 - i;
  for (const unsigned threads : {1u, 2u, 5u}) {
    RunOptions options;
    options.threads = threads;
    Monitor monitor(options, 1);
    std::atomic<int> runs{0};
    const auto fail = [&](size_t, uint32_t item) {
      ++runs;
      if (item % 10 == 7) throw std::runtime_error(std::to_string(item));
    };
    CHECK_THROWS_WITH(runItems(descending, monitor, fail), "7");
    CHECK(runs >= 10);
  }
}

TEST_CASE("Each item runs once, and no two at once have the same thread's number", "[parallel]") {
  std::vector<uint32_t> items(1000);
  std::iota(items.begin(), items.end(), 0u);
  RunOptions options;
  options.threads = 4;
  size_t reports = 0;
  options.progress = [&](const Progress& progress) {
    ++reports;
    return progress.done <= progress.total;
  };
  Monitor monitor(options, 1);
  std::vector<std::atomic<int>> runs(items.size()), busy(4);
  std::atomic<bool> isShared = false;
  runItems(items, monitor, [&](size_t thread, uint32_t item) {
    if (++busy.at(thread) != 1) isShared = true;
    ++runs[item];
    --busy[thread];
  });
  CHECK_FALSE(isShared);
  for (const auto& count : runs) CHECK(count == 1);
  CHECK(reports == items.size());
}

TEST_CASE("Each chunk and each item runs once, on any number of threads", "[parallel]") {
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    RunOptions options;
    options.threads = threads;
    Monitor monitor(options, 1);
    for (const size_t count : {0u, 1u, 2u, 5u, 16u, 17u}) {
      std::vector<std::atomic<int>> chunks(count), items(count);
      runChunks(
          count, count, monitor, [&](size_t chunk, size_t, size_t) { ++chunks[chunk]; }, 1);
      std::vector<uint32_t> order(count);
      std::iota(order.begin(), order.end(), 0u);
      runItems(order, monitor, [&](size_t, uint32_t item) { ++items[item]; });
      for (size_t i = 0; i < count; ++i) CHECK((chunks[i] == 1 && items[i] == 1));
    }
  }
}
