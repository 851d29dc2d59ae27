#include "harness/bench/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace ml {
namespace {

std::string duration(double seconds) {
  auto whole = static_cast<long>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

}  // namespace

Progress::Progress(std::string title, bool quiet)
    : title_(std::move(title)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      begin_(Clock::now()),
      advanced_(begin_),
      printed_(begin_) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::plan(StepKind kind, double expected_seconds, uint64_t steps) {
  time_.plan(kind, expected_seconds * static_cast<double>(steps));
  steps_ += steps;
}

void Progress::advance(StepKind kind, double expected_seconds, const std::string& what) {
  const Clock::time_point now = Clock::now();
  time_.add(kind, expected_seconds, milliseconds_between(advanced_, now) / 1000);
  advanced_ = now;
  ++done_;
  // A terminal line is renewed five times a second; a log gets a line every ten seconds.
  const double wait = terminal_ ? 200 : 10000;
  const bool last = done_ == steps_;
  if (quiet_ || (!last && milliseconds_between(printed_, now) < wait)) return;
  print(what, last);
}

void Progress::print(const std::string& what, bool last) {
  printed_ = Clock::now();
  std::string line =
      fmt::format("{}: {:3.0f} %, {} {}  {}", title_, 100 * (last ? 1 : time_.fraction_done()),
                  duration(last ? milliseconds_between(begin_, printed_) / 1000 : time_.seconds_left()),
                  last ? "in all" : "left", last ? "" : what);
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%.118s", line.c_str());
    line_open_ = !last;
    if (last) std::fputc('\n', stderr);
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
  std::fflush(stderr);
}

}  // namespace ml
