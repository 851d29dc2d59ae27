#include "harness/output/result.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "embedded/result_schema_text.h"
#include "harness/base/error.h"
#include "harness/base/file.h"

namespace ml {
namespace {

using nlohmann::json;

// A copy in which numbers that JSON cannot hold are null.
json without_infinities(const json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return nullptr;
  if (!value.is_structured()) return value;
  json copy = value;
  for (json& part : copy) part = without_infinities(part);
  return copy;
}

void require_finite(double value, const CaseResult& one, const std::string& name) {
  if (!std::isfinite(value))
    throw std::logic_error("case " + one.id + ": " + name + " has a number that is not finite");
}

json times(const SampleTable& table, const CaseResult& one) {
  json result = json::object();
  for (const auto& [name, laps] : table.tables()) {
    json rows = json::array();
    for (size_t i = 0; i < laps.size() && i < one.repeats_done; ++i) {
      for (double sample : laps[i]) require_finite(sample, one, name);
      rows.push_back(laps[i]);
    }
    result[name] = std::move(rows);
  }
  return result;
}

SampleTable samples(const json& one, const char* group) {
  SampleTable table(one.at("repeats_done").get<uint32_t>(), static_cast<uint32_t>(one.at("frames").size()));
  for (const auto& [name, laps] : one.at(group).items())
    for (uint32_t repeat = 0; repeat < table.repeats(); ++repeat)
      for (uint32_t frame = 0; frame < table.frames(); ++frame)
        table.set(name, repeat, frame, laps.at(repeat).at(frame));
  return table;
}

json overlap_json(const CaseResult& one) {
  json samples = times(one.overlap.ms, one);
  return {{"list_queue", one.overlap.list_queue},
          {"overlapped", one.overlap.overlapped},
          {"note", one.overlap.note},
          {"ms", samples.contains("both") ? samples["both"] : json::array()}};
}

json case_json(const CaseResult& one) {
  json counters = json::object();
  for (const auto& [name, numbers] : one.counters) {
    json list = json::array();
    for (double number : numbers) {
      require_finite(number, one, name);
      // Whole numbers without ".0": counts read as counts.
      if (number == std::floor(number) && std::abs(number) < 0x1p53)
        list.push_back(static_cast<int64_t>(number));
      else
        list.push_back(number);
    }
    counters[name] = std::move(list);
  }
  return {{"id", one.id},
          {"algorithm", one.algorithm},
          {"parameters", without_infinities(one.parameters)},
          {"scene", one.scene},
          {"lights", one.lights},
          {"resolution", {one.width, one.height}},
          {"effects", one.effects},
          {"frames", one.frames},
          {"repeats_done", one.repeats_done},
          {"cpu_ms", times(one.cpu_ms, one)},
          {"gpu_ms", times(one.gpu_ms, one)},
          {"counters", std::move(counters)},
          {"passes", one.passes},
          {"accuracy", without_infinities(one.accuracy)},
          {"memory_bytes", one.memory_bytes},
          {"rejected_lights", one.rejected_lights},
          {"light_account",
           {{"of_file", one.light_account.of_file},
            {"total", one.light_account.total},
            {"used", one.light_account.used},
            {"dark", one.light_account.dark},
            {"left_out", one.light_account.left_out}}},
          {"notes", one.notes},
          {"frames_without_surface", one.frames_without_surface},
          {"invalid", one.invalid},
          {"invalid_note", one.invalid_note},
          {"overlap", overlap_json(one)},
          {"timing_suspect", one.timing_suspect},
          {"timing_note", one.timing_note},
          {"files", {{"heatmaps", one.heatmaps}, {"images", one.images}}}};
}

// Fills in keys that `target` lacks, objects within objects too.
void fill_in(json& target, const json& defaults) {
  for (const auto& [key, value] : defaults.items()) {
    if (!target.contains(key))
      target[key] = value;
    else if (value.is_object() && target[key].is_object())
      fill_in(target[key], value);
  }
}

void check_laps(const json& one, const json& laps, const std::string& path,
                std::vector<std::string>& violations) {
  size_t frames = one["frames"].size(), repeats = one["repeats_done"].get<size_t>();
  if (laps.size() != repeats)
    violations.push_back(
        fmt::format("{}: expected {} repeats, as in repeats_done, found {}", path, repeats, laps.size()));
  for (size_t lap = 0; lap < laps.size(); ++lap)
    if (laps[lap].size() != frames)
      violations.push_back(
          fmt::format("{}[{}]: expected {} frames, found {}", path, lap, frames, laps[lap].size()));
}

void check_rows(const json& one, const std::string& where, const char* group,
                std::vector<std::string>& violations) {
  for (const auto& [name, laps] : one[group].items())
    check_laps(one, laps, fmt::format("{}.{}.{}", where, group, name), violations);
}

void check_case(const json& one, const std::string& where, bool complete,
                std::vector<std::string>& violations) {
  check_rows(one, where, "cpu_ms", violations);
  check_rows(one, where, "gpu_ms", violations);
  if (one.contains("overlap") && !one["overlap"]["ms"].empty())
    check_laps(one, one["overlap"]["ms"], where + ".overlap.ms", violations);
  size_t frames = one["frames"].size();
  for (const auto& [name, numbers] : one["counters"].items())
    if (complete ? numbers.size() != frames : numbers.size() > frames)
      violations.push_back(
          fmt::format("{}.counters.{}: expected {} frames, found {}", where, name, frames, numbers.size()));
}

}  // namespace

CaseResult case_from_json(const json& one) {
  CaseResult result;
  one.at("id").get_to(result.id);
  one.at("algorithm").get_to(result.algorithm);
  one.at("scene").get_to(result.scene);
  result.parameters = one.at("parameters");
  one.at("lights").get_to(result.lights);
  result.width = one.at("resolution").at(0);
  result.height = one.at("resolution").at(1);
  one.at("effects").get_to(result.effects);
  if (one.contains("passes")) one.at("passes").get_to(result.passes);
  one.at("frames").get_to(result.frames);
  one.at("repeats_done").get_to(result.repeats_done);
  result.cpu_ms = samples(one, "cpu_ms");
  result.gpu_ms = samples(one, "gpu_ms");
  one.at("counters").get_to(result.counters);
  result.accuracy = one.at("accuracy");
  one.at("memory_bytes").get_to(result.memory_bytes);
  result.rejected_lights = one.at("rejected_lights");
  // Results of before it was counted have none of these.
  if (one.contains("light_account")) {
    const json& account = one.at("light_account");
    result.light_account = {account.at("of_file"), account.at("total"), account.at("used"),
                            account.at("dark"), account.at("left_out")};
  }
  result.notes = one.value("notes", result.notes);
  result.frames_without_surface = one.value("frames_without_surface", 0u);
  result.invalid = one.value("invalid", false);
  result.invalid_note = one.value("invalid_note", "");
  one.at("timing_suspect").get_to(result.timing_suspect);
  one.at("timing_note").get_to(result.timing_note);
  one.at("files").at("heatmaps").get_to(result.heatmaps);
  one.at("files").at("images").get_to(result.images);
  return result;
}

json to_json(const Result& result) {
  json context = without_infinities(result.context);
  fill_in(context, {{"commit", ""},
                    {"dirty", false},
                    {"build", json::object()},
                    {"host", json::object()},
                    {"device", {{"name", ""}, {"type", "other"}, {"driver", ""}}},
                    {"environment", json::object()},
                    {"calibration", json::object()}});
  json cases = json::array();
  for (const json& one : result.earlier_cases) cases.push_back(one);
  for (const CaseResult& one : result.cases) cases.push_back(case_json(one));
  return {{"schema", result_schema_version},
          {"complete", result.complete},
          {"context", std::move(context)},
          {"config", without_infinities(result.config)},
          {"harness", without_infinities(result.harness)},
          {"cases", std::move(cases)}};
}

void write_result(const Result& result, const std::filesystem::path& file) {
  json document = to_json(result);
  if (auto violations = result_violations(document); !violations.empty())
    throw std::logic_error("the result breaks its own schema: " + violations.front());
  // Device names and paths need not be UTF-8; what is not is replaced, rather than losing the run.
  write_file(file, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

json read_result(const std::filesystem::path& file) {
  std::string text = read_text_file(file, size_t{1} << 30);
  json document;
  try {
    document = json::parse(text);
  } catch (const json::exception& problem) {
    throw UsageError(file.string() + ": expected JSON: " + problem.what());
  }
  if (document.is_object() && document.contains("schema") && document["schema"].is_number_integer() &&
      document["schema"] != result_schema_version)
    throw UsageError(fmt::format("{}: $.schema: expected version {}, found {}", file.string(),
                                 result_schema_version, document["schema"].dump()));
  if (auto violations = result_violations(document); !violations.empty()) {
    std::string more = violations.size() > 1 ? fmt::format(" (and {} more)", violations.size() - 1) : "";
    throw UsageError(file.string() + ": " + violations.front() + more);
  }
  return document;
}

const json& result_schema() {
  static const json schema = json::parse(result_schema_text);
  return schema;
}

std::vector<std::string> result_violations(const json& document) {
  std::vector<std::string> violations = schema_violations(result_schema(), document);
  if (!violations.empty()) return violations;
  std::set<std::string> ids;
  for (size_t i = 0; i < document["cases"].size(); ++i) {
    const json& one = document["cases"][i];
    std::string where = fmt::format("$.cases[{}]", i);
    if (!ids.insert(one["id"].get<std::string>()).second)
      violations.push_back(fmt::format("{}.id: '{}' is there twice", where, one["id"].get<std::string>()));
    check_case(one, where, document["complete"].get<bool>(), violations);
  }
  return violations;
}

}  // namespace ml
