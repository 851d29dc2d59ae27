// Named stretches of CPU time, in milliseconds. The names become the keys of `cpu_ms` in the result.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace ml {

using Clock = std::chrono::steady_clock;

inline double milliseconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

// Sums of the spans of one frame. Not thread-safe: spans are opened by the thread that runs prepare().
class Spans {
 public:
  // Measures from its construction to its destruction, and adds to the sum of its name.
  class Span {
   public:
    Span(Spans& spans, std::string_view name) : spans_(spans), name_(name), begin_(Clock::now()) {}
    ~Span() { spans_.add(name_, milliseconds_between(begin_, Clock::now())); }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    Spans& spans_;
    std::string_view name_;
    Clock::time_point begin_;
  };

  // `name` must outlive the span (a literal).
  [[nodiscard]] Span span(std::string_view name) { return Span(*this, name); }

  void add(std::string_view name, double milliseconds) {
    auto found = sums_.find(name);
    if (found == sums_.end()) found = sums_.emplace(std::string(name), 0.0).first;
    found->second += milliseconds;
  }
  const std::map<std::string, double, std::less<>>& sums() const { return sums_; }
  // Sets every sum to 0 and keeps the names, so that a steady frame allocates nothing.
  void clear() {
    for (auto& [name, sum] : sums_) sum = 0;
  }

 private:
  std::map<std::string, double, std::less<>> sums_;
};

}  // namespace ml
