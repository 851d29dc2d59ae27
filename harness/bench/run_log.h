// Where the wall time of a run goes: the harness's own spans and the trace.
#pragma once

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/base/spans.h"
#include "harness/gpu/submission_times.h"
#include "harness/output/result.h"

namespace ml {

class RunLog {
 public:
  explicit RunLog(bool trace) : trace_(trace), begin_(Clock::now()) {}

  void add(std::string_view name, double milliseconds) { spans_.add(name, milliseconds); }
  // A stretch of the harness's own work; these do not nest.
  Spans::Span span(std::string_view name) { return spans_.span(name); }

  // A lap whose samples are kept; all other wall time is what the bench costs beside.
  void add_timed_lap(double milliseconds) { timed_laps_ += milliseconds; }

  // Times of one sample for the trace: stages in order, from `at` on.
  void trace(const std::string& row, Clock::time_point at,
             const std::vector<std::pair<std::string, double>>& stages,
             const std::map<std::string, std::string>& arguments) {
    if (!trace_) return;
    double begin = milliseconds_between(begin_, at);
    for (const auto& [name, duration] : stages) {
      events_.push_back({name, row, begin, duration, arguments});
      begin += duration;
    }
  }
  // The device's spans of one submission, where they stand in it.
  void trace(Clock::time_point at, const std::vector<gpu::SubmissionTimes::Interval>& spans,
             const std::map<std::string, std::string>& arguments) {
    if (!trace_) return;
    const double begin = milliseconds_between(begin_, at);
    for (const gpu::SubmissionTimes::Interval& span : spans)
      events_.push_back({span.name, span.second_queue ? "gpu, second queue" : "gpu",
                         begin + std::max(span.begin, 0.0), span.end - span.begin, arguments});
  }
  const std::vector<TraceEvent>& events() const { return events_; }

  // Spans, wall time, the part of it outside the timed laps, and the part in no span.
  nlohmann::json summary() const {
    double wall = milliseconds_between(begin_, Clock::now()), accounted = 0;
    nlohmann::json spans = nlohmann::json::object();
    for (const auto& [name, sum] : spans_.sums()) {
      spans[name] = sum;
      accounted += sum;
    }
    return {{"wall_ms", wall},
            {"spans_ms", spans},
            {"timed_laps_ms", timed_laps_},
            {"outside_timed_laps_fraction", wall > 0 ? std::max(0.0, 1 - timed_laps_ / wall) : 0.0},
            {"overhead_fraction", wall > 0 ? std::max(0.0, 1 - accounted / wall) : 0.0}};
  }

 private:
  bool trace_;
  Clock::time_point begin_;
  Spans spans_;
  double timed_laps_ = 0;  // ms
  std::vector<TraceEvent> events_;
};

}  // namespace ml
