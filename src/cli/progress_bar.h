// How far a cut, or whatever else takes long, has come, on a terminal.
#pragma once

#include <chrono>

#include "cli/interrupt.h"
#include "mandoline/mandoline.h"

namespace mandoline::cli {

/// Draws on standard error if that is a terminal. While it lives, Ctrl-C cancels.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// For RunOptions::progress.
  bool update(const Progress& progress);

 private:
  void draw(const Progress& progress);

  DeferInterrupts defer_;
  bool visible_, drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace mandoline::cli
