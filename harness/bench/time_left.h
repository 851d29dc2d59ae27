// How long work will go on, from what its kinds of steps have cost so far.
//
// Work is planned in steps of several kinds, each with the seconds that it is expected to take. What a kind
// really costs shows only in its steps: their expectation is scaled by what those that are done took. Kinds
// of which nothing is done yet are scaled as the others were on the whole. So dear steps at the beginning
// (compiling, counting) do not stand for the cheap ones that follow.
#pragma once

#include <array>
#include <cstdint>

namespace ml {

enum class StepKind : uint8_t {
  programs,   // of one case: making and compiling them, and counting the first frame, in which drivers finish
              // that
  counting,   // of one further frame and case
  timing,     // of one frame and case, warm-up too
  pictures,   // of one frame and case
  reference,  // of one frame: what `verify` compares with
  proof,      // of one frame and case
};

class TimeLeft {
 public:
  // `expected`: s, > 0 in all.
  void plan(StepKind kind, double expected);
  // A step that was planned with `expected` is done, and took `seconds`.
  void add(StepKind kind, double expected, double seconds);
  double seconds_left() const;
  // Of all the time, as far as it is known by now; in [0, 1].
  double fraction_done() const;

 private:
  struct Sums {
    double planned = 0, done = 0,
           took = 0;  // s: expected of all steps, expected of those done, what these took
  };
  std::array<Sums, 6> kinds_;
};

}  // namespace ml
