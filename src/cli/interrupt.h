// Ctrl-C and other requests to stop.
#pragma once

namespace mandoline::cli {

/// A signal asked to stop; thrown by throwIfInterrupted().
struct Interrupted {
  int signal;
};

/// From now on SIGINT, SIGTERM and SIGHUP end the program with exit code 128 + signal, unless they are ignored already, as in background
/// jobs. A file that reaches a limit of its size is then one that can't be written, as on a full disk, and no signal.
void handleInterrupts();

/// While one lives, the first signal is only remembered, so that unfinished files can be removed. The second one ends the program.
class DeferInterrupts {
 public:
  DeferInterrupts();
  ~DeferInterrupts();
  DeferInterrupts(const DeferInterrupts&) = delete;
  DeferInterrupts& operator=(const DeferInterrupts&) = delete;
};

bool interrupted();
void throwIfInterrupted();

}  // namespace mandoline::cli
