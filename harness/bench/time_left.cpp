#include "harness/bench/time_left.h"

#include <algorithm>

namespace ml {

void TimeLeft::plan(StepKind kind, double expected) {
  kinds_[static_cast<size_t>(kind)].planned += expected;
}

void TimeLeft::add(StepKind kind, double expected, double seconds) {
  Sums& sums = kinds_[static_cast<size_t>(kind)];
  sums.done += expected;
  sums.took += seconds;
}

double TimeLeft::seconds_left() const {
  double done = 0, took = 0;
  for (const Sums& sums : kinds_) {
    done += sums.done;
    took += sums.took;
  }
  const double usual = done > 0 ? took / done : 1;
  // The first step of a kind alone may be an odd one: some of the others' experience stands beside it.
  constexpr double others = 0.005;
  double left = 0;
  for (const Sums& sums : kinds_) {
    if (sums.planned <= sums.done) continue;
    const double experience = others * sums.planned;
    left += (sums.planned - sums.done) * (sums.took + experience * usual) / (sums.done + experience);
  }
  return left;
}

double TimeLeft::fraction_done() const {
  double took = 0, left = seconds_left();
  for (const Sums& sums : kinds_) took += sums.took;
  if (left <= 0) return 1;
  return took / (took + left);
}

}  // namespace ml
