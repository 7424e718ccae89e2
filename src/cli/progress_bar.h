// How far a cut has come, on a terminal; and Ctrl-C, which ends it.
#pragma once

#include <chrono>

#include "mandoline/mandoline.h"

namespace mandoline::cli {

/// While it lives, Ctrl-C cancels the cut instead of ending the program; a second one ends it. Draws on standard error if that is a
/// terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// For CutOptions::progress.
  bool update(const Progress& progress);

 private:
  void draw(const Progress& progress);

  bool visible_, drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace mandoline::cli
