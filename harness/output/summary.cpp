#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "harness/measure/statistics.h"
#include "harness/output/result.h"
#include "harness/output/text_table.h"

namespace ml {
namespace {

using Laps = std::vector<std::vector<double>>;  // ms, [repeat][frame]

// The laps that are done; none where nothing has that name.
Laps laps_of(const SampleTable& table, const CaseResult& one, std::string_view name) {
  const auto found = table.tables().find(name);
  if (found == table.tables().end()) return {};
  Laps laps = found->second;
  laps.resize(std::min<size_t>(laps.size(), one.repeats_done));
  return laps;
}

// Those of the harness's shading loop, and those that the algorithm says to be such.
bool is_shading(const CaseResult& one, const std::string& pass) {
  const auto declared = one.passes.find(pass);
  if (declared != one.passes.end()) return declared->second == "shading";
  return pass == "shade" || pass == "composite" || pass == "forward";
}

// What an algorithm declares as work on the finished picture is in the total alone.
bool is_post(const CaseResult& one, const std::string& pass) {
  const auto declared = one.passes.find(pass);
  return declared != one.passes.end() && declared->second == "post";
}

// The device's passes of one kind together, without those inside others ("shade/trace"), whose time is in
// theirs.
template <typename Predicate>
Laps summed(const CaseResult& one, Predicate wanted) {
  Laps sums;
  for (const auto& [name, table] : one.gpu_ms.tables()) {
    if (name.find('/') != std::string::npos || !wanted(name)) continue;
    const Laps laps = laps_of(one.gpu_ms, one, name);
    sums.resize(std::max(sums.size(), laps.size()));
    for (size_t i = 0; i < laps.size(); ++i) {
      sums[i].resize(std::max(sums[i].size(), laps[i].size()));
      for (size_t frame = 0; frame < laps[i].size(); ++frame) sums[i][frame] += laps[i][frame];
    }
  }
  return sums;
}

Laps shading(const CaseResult& one) {
  return summed(one, [&](const std::string& name) { return is_shading(one, name); });
}

// List building: every pass before shading.
Laps culling(const CaseResult& one) {
  return summed(one, [&](const std::string& name) {
    return !is_shading(one, name) && !is_post(one, name) && name != "total" && name != "transfer" &&
           name != "shadow_maps";
  });
}

std::string milliseconds(double value) {
  return fmt::format("{:.{}f}", value, value < 10 ? 3 : value < 100 ? 2 : 1);
}

std::string median_ms(const Laps& laps) {
  const double value = median_time(laps).value;
  return std::isfinite(value) ? milliseconds(value) : "-";
}

// "1.250 [1.240 1.270]" for 95 %, "1.250 (1.240..1.270)" for the range of few repeats. One lap says nothing
// of its spread.
template <typename Text>
std::string with_spread(const Interval& interval, Text text) {
  if (!std::isfinite(interval.value)) return "-";
  if (interval.repeats < 2) return text(interval.value);
  return fmt::format(fmt::runtime(interval.is_95() ? "{} [{} {}]" : "{} ({}..{})"), text(interval.value),
                     text(interval.low), text(interval.high));
}

std::string median_and_spread(const Laps& laps) {
  return with_spread(median_time(laps), milliseconds);
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

// Nodes of trees, where there are any.
std::string nodes(const CaseResult& one) {
  return counter_sum(one, "nodes").value_or(0) > 0 ? counter_mean(one, "nodes") : "-";
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

// How the pixels of a case of `ideal` walk; results from before it could be chosen are by pixels.
std::string walk_of(const CaseResult& ideal) {
  return ideal.parameters.value("walk", "pixel");
}

// The case of `ideal` with which one of its setup is compared: of the ways to walk that were measured the one
// that was faster over the whole run. Null where there is none, or one way twice (a sweep over something that
// a case does not show).
const CaseResult* ideal_of(const std::vector<CaseResult>& cases, const CaseResult& one) {
  std::map<std::string, const CaseResult*> by_walk;
  for (const CaseResult& other : cases)
    if (other.algorithm == "ideal" && same_setup(one, other) &&
        !by_walk.emplace(walk_of(other), &other).second)
      return nullptr;
  const CaseResult* best = nullptr;
  double best_ms = std::numeric_limits<double>::infinity();
  for (const auto& [walk, ideal] : by_walk) {
    const double ms = median_time(shading(*ideal)).value;
    if (best && !(ms < best_ms)) continue;
    best = ideal;
    if (std::isfinite(ms)) best_ms = ms;
  }
  return best;
}

// Shading time of the perfect lists over this algorithm's, paired lap by lap and frame by frame: 1 is as good
// as any list can be.
Interval efficiency(const std::vector<CaseResult>& cases, const CaseResult& one) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const CaseResult* ideal = ideal_of(cases, one);
  if (!ideal) return {unknown, unknown, unknown, 0};
  if (ideal == &one) return {1, 1, 1, 0};
  return paired_ratio(shading(*ideal), shading(one));
}

// Which of the ways to walk `ideal` is compared with, where several were measured in one setup.
std::string faster_ideal(const std::vector<CaseResult>& cases) {
  std::set<std::string> measured, faster;
  for (const CaseResult& one : cases) {
    if (one.algorithm != "ideal") continue;
    measured.insert(walk_of(one));
    if (const CaseResult* ideal = ideal_of(cases, one)) faster.insert(walk_of(*ideal));
  }
  if (measured.size() < 2 || faster.empty()) return "";
  return faster.size() == 1 ? fmt::format(" with walk={}, the faster", *faster.begin())
                            : " with the walk that is faster in its setup, where eff. is 1.00";
}

std::string two_digits(double ratio) {
  return fmt::format("{:.2f}", ratio);
}

// What stands after the medians, by how many repeats the cases have.
std::string spread_text(const std::vector<CaseResult>& cases) {
  bool interval = false;
  std::set<uint32_t> few;
  for (const CaseResult& one : cases) {
    interval |= one.repeats_done >= min_repeats_for_95;
    if (one.repeats_done > 1 && one.repeats_done < min_repeats_for_95) few.insert(one.repeats_done);
  }
  std::string text;
  if (interval) text += ", [95 % interval]";
  if (!few.empty())
    text += fmt::format(", (min..max of n = {} repeats: too few for an interval)", fmt::join(few, ", "));
  return text;
}

std::string device_text(const nlohmann::json& context, const char* key) {
  auto device = context.find("device");
  if (device == context.end() || !device->is_object() || !device->contains(key) ||
      !(*device)[key].is_string())
    return "";
  return (*device)[key];
}

std::string footnote(const Result& result, const std::vector<CaseResult>& cases) {
  auto any = [&](bool CaseResult::*flag) {
    return std::any_of(cases.begin(), cases.end(), [&](const CaseResult& one) { return one.*flag; });
  };
  std::string type = device_text(result.context, "type"), name = device_text(result.context, "name");
  std::string driver = device_text(result.context, "driver");
  std::string device = (name.empty() ? "unknown" : name) + (driver.empty() ? "" : ", " + driver);
  std::string text = fmt::format("device: {} ({})\n", device, type.empty() ? "type unknown" : type);
  if (type == "cpu")
    text += "It is a software driver: its times are CPU time of this machine's cores, not a GPU's.\n";
  text += fmt::format("Times are medians over frames and repeats{}.\n", spread_text(cases));
  text +=
      "Counters are means over frames, per lit pixel; lost: lights that pixels should have got and did not, "
      "in "
      "all.\n"
      "eff.: shade time of ideal" +
      faster_ideal(cases) + " / of this, median over frames of the same laps' ratios.\n";
  // Beyond rounding and beyond the spread of the laps.
  std::set<std::string> beaten;
  for (const CaseResult& one : cases)
    if (efficiency(cases, one).low > 1.005) beaten.insert(walk_of(*ideal_of(cases, one)));
  if (beaten.contains("pixel"))
    text +=
        "eff. above 1: ideal goes pixel by pixel, and is no bound for pixels that fetch their lights "
        "together; ideal with walk=subgroup is.\n";
  if (beaten.contains("subgroup"))
    text += "eff. above 1: ideal with walk=subgroup is no bound for pixels that walk alone.\n";
  if (any(&CaseResult::invalid))
    text +=
        "!! invalid: the counters contradict themselves, or lights are lost; see invalid_note in the "
        "result.\n";
  if (any(&CaseResult::timing_suspect))
    text += "! timing suspect: spans, stamps and fence disagree; see timing_note in the result.\n";
  if (!result.complete) text += "The run is not complete.\n";
  return text;
}

}  // namespace

std::string summary_table(const Result& result, size_t width) {
  std::string type = device_text(result.context, "type");
  std::string unit = type == "cpu"  ? "ms (cpu device)"
                     : type.empty() ? "ms (device)"
                                    : fmt::format("ms ({} gpu)", type);
  if (type == "other" || type == "virtual") unit = fmt::format("ms ({} device)", type);
  std::vector<CaseResult> cases;
  for (const nlohmann::json& earlier : result.earlier_cases) cases.push_back(case_from_json(earlier));
  cases.insert(cases.end(), result.cases.begin(), result.cases.end());
  TextTable table;
  table.labels = 4;
  table.grouped = 3;
  table.headings = {
      {"algorithm", "scene", "lights", "picture", "prepare", "cull", "shade", "eff.", "total", "tested",
       "contrib.", "listed", "nodes", "lists", "lost"},
      {"", "", "", "px", "ms (cpu)", unit, unit, "", unit, "/px", "/px", "/px", "/px", "/frame", ""}};
  auto differing = differing_parameters(cases);
  for (const CaseResult& one : cases) {
    auto lost = counter_sum(one, "lost");
    table.rows.push_back({label(one, differing[one.algorithm]) + (one.invalid          ? " !!"
                                                                  : one.timing_suspect ? " !"
                                                                                       : ""),
                          one.scene, std::to_string(one.lights), fmt::format("{}x{}", one.width, one.height),
                          median_and_spread(laps_of(one.cpu_ms, one, "total")), median_ms(culling(one)),
                          median_and_spread(shading(one)), with_spread(efficiency(cases, one), two_digits),
                          median_ms(laps_of(one.gpu_ms, one, "total")), counter_mean(one, "tested"),
                          counter_mean(one, "contributing"), counter_mean(one, "listed"), nodes(one),
                          bytes(one), lost ? fmt::format("{:.0f}", *lost) : "-"});
  }
  return (width == 0 ? whole_table(table) : folded_table(table, width)) + "\n" + footnote(result, cases);
}

}  // namespace ml
