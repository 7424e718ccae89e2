#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace mandoline::cli {
namespace {

volatile std::sig_atomic_t pending = 0, deferred = 0;  // signal handlers see globals only

void onSignal(int signal) {
  if (!deferred || pending) _exit(128 + signal);
  pending = signal;
}

}  // namespace

void handleInterrupts() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = onSignal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

DeferInterrupts::DeferInterrupts() { deferred = deferred + 1; }
DeferInterrupts::~DeferInterrupts() { deferred = deferred - 1; }

bool interrupted() { return pending != 0; }

void throwIfInterrupted() {
  if (pending) throw Interrupted{int(pending)};
}

}  // namespace mandoline::cli
