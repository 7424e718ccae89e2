// What the benchmark measures: fresh processes that cut once each, alternating with fresh processes of the lower bound, so that page
// faults count and both see the same machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mandoline::bench {

struct Job {
  std::string name, path;
  int64_t n;
};

/// The measurements of one job: medians over the repetitions.
struct Row {
  Job job;
  size_t triangles = 0, cutCells = 0;
  double lowerBoundMs = 0, cutMs = 0, peakBytes = 0, outputBytes = 0;
  std::vector<std::string> stages;
  std::vector<double> stageMs;

  double ratio() const { return cutMs / lowerBoundMs; }
};

/// The first argument with which this program is called to cut once; the mesh's path and N follow.
inline constexpr const char* kCutOnce = "--cut-once";

/// Cuts in this process, on one thread, and prints what measure() reads. Throws if the mesh can't be read or cut.
void cutOnce(const std::string& path, int64_t n);

/// Paths of this program and of the lower bound.
struct Programs {
  std::string bench, lowerBound;
};

/// Throws if a program fails, with its messages on standard error.
Row measure(const Programs& programs, const Job& job, int64_t repetitions);

}  // namespace mandoline::bench
