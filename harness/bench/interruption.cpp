#include "harness/bench/interruption.h"

#include <csignal>

#include "harness/base/error.h"

namespace ml {
namespace {

volatile std::sig_atomic_t signal_seen = 0;

void on_signal(int signal) {
  if (signal_seen) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  signal_seen = signal;
}

}  // namespace

void watch_for_interruption() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() {
  return signal_seen != 0;
}

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted("interrupted; what was measured is kept");
}

}  // namespace ml
