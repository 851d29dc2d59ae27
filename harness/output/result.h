// result.json: schema 1, one file that is valid after every finished step of a run.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/measure/samples.h"

namespace ml {

inline constexpr int result_schema_version = 1;

// Whether lists that the device builds were built beside other work (shading.list_queue: compute).
struct OverlapResult {
  std::string list_queue = "graphics";  // as configured
  bool overlapped = false;              // by the stamps: in most samples both ran at the same time
  std::string note;                     // why not
  SampleTable ms;                       // "both": for how long; empty where it was not measured
};

// What became of the lights of the level's file, or of those that a placement was asked for.
struct LightAccountResult {
  bool of_file = false;
  uint32_t total = 0, used = 0, dark = 0, left_out = 0;  // total = used + dark + rejected + left_out
};

// One case's numbers. Counters are one per frame.
struct CaseResult {
  std::string id, algorithm, scene;
  nlohmann::json parameters = nlohmann::json::object();
  uint32_t lights = 0;
  uint32_t width = 0, height = 0;
  std::vector<std::string> effects;
  std::map<std::string, std::string> passes;  // the algorithm's own, and what for: lists, shading or post
  std::vector<uint32_t> frames;
  SampleTable cpu_ms, gpu_ms;
  std::map<std::string, std::vector<double>> counters;
  nlohmann::json accuracy = nlohmann::json::object();
  nlohmann::json rejected_lights = nlohmann::json::object();  // reason -> count
  LightAccountResult light_account;
  std::vector<std::string> notes;       // what the level asks for and does not get
  uint32_t frames_without_surface = 0;  // of `frames`
  std::map<std::string, uint64_t> memory_bytes;
  OverlapResult overlap;
  bool timing_suspect = false;
  std::string timing_note;  // why it is suspect
  // The counters contradict themselves, or lights were lost that no cap of the user's cut off.
  bool invalid = false;
  std::string invalid_note;  // how
  uint32_t repeats_done = 0;
  std::vector<std::string> heatmaps, images;  // relative to the result's folder
};

struct Result {
  nlohmann::json context = nlohmann::json::object();
  nlohmann::json config = nlohmann::json::object();
  bool complete = false;  // false while running and after an interruption
  nlohmann::json harness =
      nlohmann::json::object();  // where the run's wall time went: spans in ms, overhead fraction
  std::vector<nlohmann::json>
      earlier_cases;  // of an earlier run that is resumed, as its file has them; they come first
  std::vector<CaseResult> cases;
};

// The document, times cut to the repeats that are done, parts of the context that nobody filled in present
// but empty. JSON knows no NaN and no infinity: in context, config, accuracy and harness they become null
// ("there is no number"); among times and counters they are a programmer error (std::logic_error naming the
// place).
nlohmann::json to_json(const Result& result);
// A case of a valid document.
CaseResult case_from_json(const nlohmann::json& one);
// Checks against the schema built into the program, then writes whole or not at all. Throws SystemError; a
// result that its own schema refuses is a programmer error and throws std::logic_error.
void write_result(const Result& result, const std::filesystem::path& file);
// Reads and checks a result: the schema, and what no schema can say (result_violations). Throws UsageError
// naming file and JSON path.
nlohmann::json read_result(const std::filesystem::path& file);

const nlohmann::json& result_schema();

// All violations of `schema` by `document`, one line each ("$.cases[0].lights: ..."); empty when valid.
// (valijson)
std::vector<std::string> schema_violations(const nlohmann::json& schema, const nlohmann::json& document);

// The same against the result schema, and beyond it: case ids are unique; every time has a row for each of
// `repeats_done`, and a number for each frame; counters have one for each frame (fewer only while the result
// is not complete).
std::vector<std::string> result_violations(const nlohmann::json& document);

// Chrome trace events (opens in Perfetto): one process, rows "cpu" and "gpu".
struct TraceEvent {
  std::string name, row;
  double begin_ms = 0, duration_ms = 0;          // since the run began
  std::map<std::string, std::string> arguments;  // case, frame, repeat
};
void write_trace(const std::vector<TraceEvent>& events, const std::string& device_note,
                 const std::filesystem::path& file);

// A table for people: one line a case, earlier ones too, medians, with the device's type beside every time.
// `width`: letters that a line may have, beyond which the columns fold into several tables; 0: any number.
std::string summary_table(const Result& result, size_t width = 0);

}  // namespace ml
