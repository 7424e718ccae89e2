// Shows on a terminal how far a cut or another long call has come.
#pragma once

#include <chrono>
#include <type_traits>

#include "cli/interrupt.h"
#include "mandoline/status.h"

namespace mandoline::cli {

/// From now on progress is shown, or not, whether or not standard error is a terminal.
void showProgress(bool shown);

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

/// Calls work(RunOptions) and shows how far it has come. Throws Interrupted.
template <class Work>
auto withProgress(unsigned threads, const Work& work) {
  ProgressBar bar;
  const RunOptions options{threads, [&](const Progress& progress) { return bar.update(progress); }};
  try {
    if constexpr (std::is_void_v<decltype(work(options))>) {
      work(options);
      throwIfInterrupted();
    } else {
      auto result = work(options);
      throwIfInterrupted();
      return result;
    }
  } catch (const CallError&) {
    throwIfInterrupted();
    throw;
  }
}

}  // namespace mandoline::cli
