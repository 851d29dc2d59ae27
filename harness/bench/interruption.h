// SIGINT and SIGTERM. Long work looks at a flag between its steps and stops in good order. Where it does not
// come to that in time, in a driver's compiler or in a long dispatch, a thread that waits for the signals
// ends the process: whatever was measured is on the disk by then, for a result is written after every lap.
#pragma once

#include <chrono>

namespace ml {

// From the first signal to the end of the process by the waiting thread.
inline constexpr std::chrono::milliseconds interruption_grace{1500};

// Starts the waiting thread. To be called before any other thread is started, once: threads inherit that the
// signals are blocked in them. A second signal ends the process at once. Either way it ends with
// ExitCode::interrupted and one line on stderr.
void watch_for_interruption(std::chrono::milliseconds grace = interruption_grace);
bool interrupted();
// Throws Interrupted when a signal came.
void stop_if_interrupted();

// True for the first caller alone, of the waiting thread and whoever caught Interrupted: he tells the user.
bool may_tell_of_interruption();

// While one lives, the waiting thread holds the end of the process back, for a moment at most: for writing
// files that should not be left half done. They do not nest.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

}  // namespace ml
