#include "harness/bench/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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

Progress::Progress(std::string title, uint64_t total, bool quiet)
    : title_(std::move(title)),
      total_(std::max<uint64_t>(total, 1)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      begin_(Clock::now()),
      printed_(begin_) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::advance(uint64_t steps, const std::string& what) {
  done_ = std::min(done_ + steps, total_);
  // A terminal line is renewed five times a second; a log gets a line every ten seconds.
  double wait = terminal_ ? 200 : 10000;
  bool last = done_ == total_;
  if (quiet_ || (!last && milliseconds_between(printed_, Clock::now()) < wait)) return;
  print(what, last);
}

void Progress::print(const std::string& what, bool last) {
  printed_ = Clock::now();
  double elapsed = milliseconds_between(begin_, printed_) / 1000;
  double left = elapsed / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  std::string line = fmt::format("{}: {:3.0f} %, {} {}  {}", title_,
                                 100.0 * static_cast<double>(done_) / static_cast<double>(total_),
                                 duration(last ? elapsed : left), last ? "in all" : "left", last ? "" : what);
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
