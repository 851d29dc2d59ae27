#include "harness/bench/interruption.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <mutex>
#include <string>
#include <thread>

#include "harness/base/error.h"

namespace ml {
namespace {

constexpr const char* message = "interrupted; what was measured is kept";
constexpr std::chrono::milliseconds write_grace{300};

std::atomic<bool> signal_seen{false}, told{false};
std::timed_mutex writing;

[[noreturn]] void end_process() {
  // The mutex is never given back: nothing is begun any more.
  const bool quiet = writing.try_lock_for(write_grace);
  static_cast<void>(quiet);  // after that time it ends anyway
  if (may_tell_of_interruption()) {
    // After a line of progress, if the terminal shows one.
    const std::string line = fmt::format("{}manylights: {}\n", isatty(STDERR_FILENO) ? "\n" : "", message);
    if (write(STDERR_FILENO, line.data(), line.size()) < 0) _exit(static_cast<int>(ExitCode::interrupted));
  }
  _exit(static_cast<int>(ExitCode::interrupted));
}

void wait_for_signals(sigset_t signals, std::chrono::milliseconds grace) {
  int number = 0;
  while (sigwait(&signals, &number) != 0) {
  }
  signal_seen = true;
  timespec rest{};
  rest.tv_sec = static_cast<time_t>(grace.count() / 1000);
  rest.tv_nsec = static_cast<long>(grace.count() % 1000) * 1'000'000;
  while (sigtimedwait(&signals, nullptr, &rest) < 0 && errno == EINTR) {
  }
  end_process();
}

}  // namespace

void watch_for_interruption(std::chrono::milliseconds grace) {
  sigset_t signals;
  sigemptyset(&signals);
  for (int number : {SIGINT, SIGTERM}) {
    // A shell starts programs in the background with SIGINT ignored.
    std::signal(number, SIG_DFL);
    sigaddset(&signals, number);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_for_signals, signals, grace).detach();
}

bool interrupted() {
  return signal_seen;
}

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted(message);
}

bool may_tell_of_interruption() {
  return !told.exchange(true);
}

Uninterrupted::Uninterrupted() {
  writing.lock();
}

Uninterrupted::~Uninterrupted() {
  writing.unlock();
}

}  // namespace ml
