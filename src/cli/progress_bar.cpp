#include "cli/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace mandoline::cli {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);

enum class Shown { onTerminal, always, never } shown = Shown::onTerminal;

bool isVisible() { return shown == Shown::onTerminal ? isatty(STDERR_FILENO) != 0 : shown == Shown::always; }

}  // namespace

void showProgress(bool show) { shown = show ? Shown::always : Shown::never; }

ProgressBar::ProgressBar() : visible_(isVisible()), next_(std::chrono::steady_clock::now() + kInterval) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

bool ProgressBar::update(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (visible_ && now >= next_) {
    draw(progress);
    next_ = now + kInterval;
  }
  return !interrupted();
}

void ProgressBar::draw(const Progress& progress) {
  constexpr int kWidth = 40;
  const double stageDone = progress.total > 0 ? double(progress.done) / double(progress.total) : 0;
  const double done = (progress.stageIndex + stageDone) / progress.stageCount;
  std::string bar(kWidth, ' ');
  bar.replace(0, size_t(done * kWidth), std::string(size_t(done * kWidth), '='));
  std::fprintf(stderr, "\r[%s] %3d%% %s\x1b[K", bar.c_str(), int(100 * done), progress.stage);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace mandoline::cli
