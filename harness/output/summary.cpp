#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "harness/measure/statistics.h"
#include "harness/output/result.h"

namespace ml {
namespace {

// Every sample of the laps that are done.
std::vector<double> samples(const SampleTable& table, const CaseResult& one, const char* name) {
  return table.first(one.repeats_done).all(name);
}

bool is_shading(const std::string& pass) {
  return pass == "shade" || pass == "composite" || pass == "forward";
}

// The device's passes of one kind together, in the same order of samples.
template <typename Predicate>
std::vector<double> summed_samples(const CaseResult& one, Predicate wanted) {
  std::vector<double> sums;
  for (const auto& [name, table] : one.gpu_ms.tables()) {
    if (!wanted(name)) continue;
    const std::vector<double> values = samples(one.gpu_ms, one, name.c_str());
    sums.resize(std::max(sums.size(), values.size()));
    for (size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
  }
  return sums;
}

std::vector<double> shading_samples(const CaseResult& one) {
  return summed_samples(one, is_shading);
}

// List building: every pass before shading.
std::vector<double> cull_samples(const CaseResult& one) {
  return summed_samples(one, [](const std::string& name) {
    return !is_shading(name) && name != "total" && name != "transfer" && name != "shadow_maps";
  });
}

std::string milliseconds(double value) {
  return fmt::format("{:.{}f}", value, value < 10 ? 3 : value < 100 ? 2 : 1);
}

std::string median_ms(const std::vector<double>& values) {
  return values.empty() ? "-" : milliseconds(median(values));
}

std::string median_and_quartiles(const std::vector<double>& values) {
  if (values.empty()) return "-";
  return fmt::format("{} [{} {}]", milliseconds(median(values)), milliseconds(quantile(values, 0.25)),
                     milliseconds(quantile(values, 0.75)));
}

std::optional<double> counter_sum(const CaseResult& one, const char* name) {
  auto found = one.counters.find(name);
  if (found == one.counters.end() || found->second.empty()) return {};
  double sum = 0;
  for (double value : found->second) sum += value;
  return sum;
}

std::string counter_mean(const CaseResult& one, const char* name) {
  auto sum = counter_sum(one, name);
  return sum ? fmt::format("{:.2f}", *sum / static_cast<double>(one.counters.at(name).size())) : "-";
}

std::string bytes(const CaseResult& one) {
  auto sum = counter_sum(one, "list_bytes");
  if (!sum) return "-";
  double mean = *sum / static_cast<double>(one.counters.at("list_bytes").size());
  return mean < 1024          ? fmt::format("{:.0f} B", mean)
         : mean < 1024 * 1024 ? fmt::format("{:.1f} KiB", mean / 1024)
                              : fmt::format("{:.1f} MiB", mean / (1024 * 1024));
}

// Parameters by algorithm that have more than one value among the cases: what a reader needs to tell its
// lines apart.
std::map<std::string, std::set<std::string>> differing_parameters(const std::vector<CaseResult>& cases) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> values;
  for (const CaseResult& one : cases)
    for (const auto& [key, value] : one.parameters.items()) values[one.algorithm][key].insert(value.dump());
  std::map<std::string, std::set<std::string>> result;
  for (const auto& [algorithm, parameters] : values)
    for (const auto& [key, seen] : parameters)
      if (seen.size() > 1) result[algorithm].insert(key);
  return result;
}

std::string label(const CaseResult& one, const std::set<std::string>& differing) {
  std::string text = one.algorithm;
  for (const std::string& key : differing) {
    if (!one.parameters.contains(key)) continue;
    const nlohmann::json& value = one.parameters[key];
    text += fmt::format(" {}={}", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text;
}

bool same_setup(const CaseResult& a, const CaseResult& b) {
  return a.scene == b.scene && a.lights == b.lights && a.width == b.width && a.height == b.height &&
         a.effects == b.effects && a.frames == b.frames;
}

// Shading time of the perfect lists over this algorithm's: 1 is as good as any list can be. Unknown without
// exactly one `ideal` case of the setup (a sweep over something that a case does not show makes several).
std::string efficiency(const Result& result, const CaseResult& one) {
  const CaseResult* ideal = nullptr;
  for (const CaseResult& other : result.cases) {
    if (other.algorithm != "ideal" || !same_setup(one, other)) continue;
    if (ideal) return "-";
    ideal = &other;
  }
  if (!ideal) return "-";
  auto best = shading_samples(*ideal), own = shading_samples(one);
  if (best.empty() || own.empty() || !(median(own) > 0)) return "-";
  return fmt::format("{:.2f}", median(best) / median(own));
}

std::string device_text(const nlohmann::json& context, const char* key) {
  auto device = context.find("device");
  if (device == context.end() || !device->is_object() || !device->contains(key) ||
      !(*device)[key].is_string())
    return "";
  return (*device)[key];
}

using Row = std::vector<std::string>;

std::string aligned(const std::vector<Row>& rows, size_t left_columns) {
  std::vector<size_t> width(rows.front().size());
  for (const Row& row : rows)
    for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (size_t c = 0; c < row.size(); ++c) {
      if (c > 0) line += "  ";
      line += c < left_columns || c + 1 == row.size() ? fmt::format("{:<{}}", row[c], width[c])
                                                      : fmt::format("{:>{}}", row[c], width[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string footnote(const Result& result, bool any_suspect) {
  std::string type = device_text(result.context, "type"), name = device_text(result.context, "name");
  std::string driver = device_text(result.context, "driver");
  std::string device = (name.empty() ? "unknown" : name) + (driver.empty() ? "" : ", " + driver);
  std::string text = fmt::format("device: {} ({})\n", device, type.empty() ? "type unknown" : type);
  if (type == "cpu")
    text += "It is a software driver: its times are CPU time of this machine's cores, not a GPU's.\n";
  text +=
      "Times are medians over frames and repeats, [quartiles]; counters are means over frames, per lit "
      "pixel. eff.: shade time of "
      "ideal / of this.\n";
  if (any_suspect)
    text += "! timing suspect: spans, stamps and fence disagree; see timing_note in the result.\n";
  if (!result.complete) text += "The run is not complete.\n";
  return text;
}

}  // namespace

std::string summary_table(const Result& result) {
  std::string type = device_text(result.context, "type");
  std::string unit = type == "cpu"  ? "ms (cpu device)"
                     : type.empty() ? "ms (device)"
                                    : fmt::format("ms ({} gpu)", type);
  if (type == "other" || type == "virtual") unit = fmt::format("ms ({} device)", type);
  std::vector<Row> rows{
      {"algorithm", "scene", "lights", "picture", "prepare", "cull", "shade", "total", "tested", "contrib.",
       "listed", "lists", "lost", "eff.", ""},
      {"", "", "", "px", "ms (cpu)", unit, unit, unit, "/px", "/px", "/px", "/frame", "", "", ""}};
  auto differing = differing_parameters(result.cases);
  bool any_suspect = false;
  for (const CaseResult& one : result.cases) {
    any_suspect |= one.timing_suspect;
    auto lost = counter_sum(one, "lost");
    rows.push_back({label(one, differing[one.algorithm]), one.scene, std::to_string(one.lights),
                    fmt::format("{}x{}", one.width, one.height),
                    median_and_quartiles(samples(one.cpu_ms, one, "total")), median_ms(cull_samples(one)),
                    median_ms(shading_samples(one)), median_ms(samples(one.gpu_ms, one, "total")),
                    counter_mean(one, "tested"), counter_mean(one, "contributing"),
                    counter_mean(one, "listed"), bytes(one), lost ? fmt::format("{:.0f}", *lost) : "-",
                    efficiency(result, one), one.timing_suspect ? "!" : ""});
  }
  return aligned(rows, 2) + "\n" + footnote(result, any_suspect);
}

}  // namespace ml
