// Tasks of different kinds, on all threads.
#pragma once

#include <functional>
#include <numeric>
#include <span>

#include "base/parallel.h"

namespace mandoline::detail {

/// Runs all, each on one thread. Failures are thrown as by runItems().
inline void runTasks(std::span<const std::function<void()>> tasks, Monitor& monitor) {
  std::vector<uint32_t> order(tasks.size());
  std::iota(order.begin(), order.end(), 0u);
  runItems(order, monitor, [&](size_t, uint32_t task) { tasks[task](); });
}

/// Runs both, each on one thread.
inline void runBoth(FunctionRef<void()> one, FunctionRef<void()> other, Monitor& monitor) {
  if (monitor.threads() == 1) {
    one();
    other();
    return;
  }
  runItems({0, 1}, monitor, [&](size_t, uint32_t task) { task == 0 ? one() : other(); });
}

}  // namespace mandoline::detail
