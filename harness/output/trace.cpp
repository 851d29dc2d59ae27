// Trace events as Chrome's tracing and Perfetto read them: "Trace Event Format", duration events ("X") in
// microseconds.
#include <algorithm>
#include <cmath>

#include "harness/base/file.h"
#include "harness/output/result.h"

namespace ml {
namespace {

using nlohmann::json;

// Milliseconds to microseconds with whole nanoseconds: short numbers in the file.
double microseconds(double milliseconds) {
  return std::isfinite(milliseconds) ? std::round(milliseconds * 1e6) / 1e3 : 0;
}

json metadata(const char* name, int thread, json arguments) {
  return {{"name", name}, {"ph", "M"}, {"pid", 1}, {"tid", thread}, {"args", std::move(arguments)}};
}

std::string line(const json& event) {
  return event.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

void write_trace(const std::vector<TraceEvent>& events, const std::string& device_note,
                 const std::filesystem::path& file) {
  std::vector<std::string> rows{"cpu", "gpu"};
  for (const TraceEvent& event : events)
    if (std::find(rows.begin(), rows.end(), event.row) == rows.end()) rows.push_back(event.row);

  std::string text = "{\"displayTimeUnit\":\"ms\",\"otherData\":" +
                     line({{"device", device_note}, {"program", "manylights"}}) + ",\"traceEvents\":[\n" +
                     line(metadata("process_name", 0, json::object({{"name", "manylights"}})));
  for (size_t i = 0; i < rows.size(); ++i) {
    int thread = static_cast<int>(i) + 1;
    std::string name = rows[i] == "gpu" && !device_note.empty() ? "gpu (" + device_note + ")" : rows[i];
    text += ",\n" + line(metadata("thread_name", thread, json::object({{"name", name}})));
    text += ",\n" + line(metadata("thread_sort_index", thread, json::object({{"sort_index", thread}})));
  }
  for (const TraceEvent& event : events) {
    auto row = std::find(rows.begin(), rows.end(), event.row) - rows.begin();
    text += ",\n" + line({{"name", event.name},
                          {"cat", event.row},
                          {"ph", "X"},
                          {"pid", 1},
                          {"tid", row + 1},
                          {"ts", microseconds(event.begin_ms)},
                          {"dur", microseconds(event.duration_ms)},
                          {"args", event.arguments}});
  }
  write_file(file, text + "\n]}\n");
}

}  // namespace ml
