// What the benchmark measures: fresh processes that cut once each, alternating with fresh processes of the lower bound, so that page
// faults count and both see the same machine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace mandoline::bench {

struct Job {
  std::string name, path;
  int64_t n;
};

/// Of one stage; ms by the clock.
struct StageRow {
  std::string name;
  double ms = 0, onTwoThreads = 0, pageFaults = 0;

  /// What of the time on two threads a second one does not shorten, in ms.
  double serialMs() const { return std::clamp(2 * onTwoThreads - ms, 0.0, onTwoThreads); }
};

/// The measurements of one job: medians over the repetitions. Times are processor time, those with "wall" by the clock.
struct Row {
  Job job;
  size_t triangles = 0, cutCells = 0;
  double lowerBoundMs = 0, cutMs = 0, wallMs = 0, wallMsOnTwo = 0, peakBytes = 0, outputBytes = 0;
  double comparedMs = 0;  ///< of the program to compare with, if there is one
  double wasmMs = 0;      ///< in WebAssembly, if that is measured
  std::vector<StageRow> stages;

  double ratio() const { return cutMs / lowerBoundMs; }
  double speedUp() const { return wallMs / wallMsOnTwo; }
};

/// The first argument with which this program is called to cut once; the mesh's path, N and the number of threads (by default 1) follow.
inline constexpr const char* kCutOnce = "--cut-once";

/// Cuts in this process and prints what measure() reads. Throws if the mesh can't be read or cut.
void cutOnce(const std::string& path, int64_t n, unsigned threads);

struct Programs {
  std::string bench, lowerBound;  ///< paths, of this program and of the lower bound
  std::string compared;           ///< path of another build of this program to compare with, or empty
  std::string wasm;               ///< what cuts in WebAssembly, as words for the shell, or empty; see kHelp of bench.cpp
};

/// Throws if a program fails, with its messages on standard error, or if WebAssembly makes another number of cut-cells.
Row measure(const Programs& programs, const Job& job, int64_t repetitions);

}  // namespace mandoline::bench
