#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/config/config.h"
#include "harness/frame/frame_options.h"
#include "harness/gpu/device.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

using nlohmann::json;

struct Row {
  std::string name, text;
};

// Counters and times of a result, for `list metrics`.
const std::vector<Row>& metrics() {
  static const std::vector<Row> rows{
      {"cpu_ms",
       "prepare() on the CPU by stage (cull, sort, bin, build, upload) and in total, [repeat][frame]"},
      {"gpu_ms",
       "the device's time by pass (bounds, regions, coarse, lists, shadow_maps, shade, composite, forward) "
       "and in "
       "total, first to last stamp of all queues, [repeat][frame]; on a software device this is CPU time"},
      {"overlap.ms", "for how long list building and shadow maps ran at the same time, [repeat][frame]"},
      {"overlap.overlapped", "whether they did in most samples; overlap.note says why not"},
      {"in_frustum", "lights left after culling against the view, per frame"},
      {"listed", "lights in the list that a pixel walks, mean over lit pixels"},
      {"tested", "lights whose volume was tested for a pixel, mean over lit pixels"},
      {"contributing", "lights that gave light to a pixel, mean over lit pixels"},
      {"nodes", "tree nodes visited for a pixel, mean over lit pixels"},
      {"lost", "contributing lights that were not evaluated, total; 0 for an exact algorithm"},
      {"mismatched_pixels", "pixels whose set of contributing lights is not the reference's"},
      {"lit_pixels", "pixels with a surface"},
      {"list_bytes", "bytes of lists and trees that the device reads"},
      {"list_cells", "cells of the grid with lights that hold a list"},
      {"tree_cells", "cells of the grid with lights that hold a tree"},
      {"list_pixels", "lit pixels that walked a list"},
      {"tree_pixels", "lit pixels that walked a tree"},
      {"overflow_tiles", "tiles whose demand was over an algorithm's caps"},
      {"overflow_lights", "lights over those caps"},
      {"coarse_lights",
       "lists built on the GPU: lights in a tile's list before fine pruning, mean over tiles"},
      {"fine_lights", "the same after fine pruning"},
      {"harness.timed_laps_ms", "wall time of the laps whose samples are kept"},
      {"harness.outside_timed_laps_fraction",
       "the bench's overhead: part of the run's wall time outside timed laps"},
      {"harness.overhead_fraction", "part of the run's wall time that is in no span"},
  };
  return rows;
}

std::vector<Row> effects() {
  std::vector<Row> rows{{"omni", "point lights; always there"}};
  for (const EffectInfo& info : effect_table)
    rows.push_back({info.name, info.key ? fmt::format("{} (effects.{}: auto | off)", info.help, info.key)
                                        : std::string(info.help)});
  for (const ShadingOptionInfo& info : shading_option_table()) rows.push_back({info.name, info.help});
  return rows;
}

json range_of(const ParameterInfo& info) {
  if (!info.choices.empty()) return info.choices;
  if (std::holds_alternative<bool>(info.fallback)) return json::array({false, true});
  if (std::holds_alternative<int64_t>(info.fallback))
    return json::array({static_cast<int64_t>(info.minimum), static_cast<int64_t>(info.maximum)});
  return json::array({info.minimum, info.maximum});
}

json algorithms_json() {
  json list = json::array();
  for (const AlgorithmEntry& entry : algorithm_registry()) {
    json parameters = json::array();
    for (const ParameterInfo& info : entry.parameters) {
      json fallback;
      std::visit([&](const auto& value) { fallback = value; }, info.fallback);
      parameters.push_back({{"name", info.name},
                            {"default", fallback},
                            {info.choices.empty() ? "range" : "choices", range_of(info)},
                            {"help", info.help}});
    }
    list.push_back({{"name", entry.info.name},
                    {"summary", entry.info.summary},
                    {"paper", entry.info.paper},
                    {"exact", entry.info.exact},
                    {"max_lights", entry.info.max_lights},
                    {"shapes", entry.info.shapes},
                    {"parameters", parameters}});
  }
  return list;
}

void print_algorithms() {
  for (const json& entry : algorithms_json()) {
    fmt::print("{:12} {}{}\n", entry["name"].get<std::string>(), entry["summary"].get<std::string>(),
               entry["exact"].get<bool>() ? "" : " (stochastic)");
    if (std::string paper = entry["paper"]; !paper.empty()) fmt::print("{:12} {}\n", "", paper);
    for (const json& parameter : entry["parameters"])
      fmt::print("{:12}   {} = {}  {}\n{:16} {}\n", "", parameter["name"].get<std::string>(),
                 parameter["default"].dump(),
                 parameter.contains("range") ? parameter["range"].dump() : parameter["choices"].dump(), "",
                 parameter["help"].get<std::string>());
  }
}

json rows_json(const std::vector<Row>& rows) {
  json list = json::array();
  for (const Row& row : rows) list.push_back({{"name", row.name}, {"summary", row.text}});
  return list;
}

void print_rows(const std::vector<Row>& rows) {
  size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  for (const Row& row : rows) fmt::print("{:{}}  {}\n", row.name, width, row.text);
}

std::vector<Row> rows_of(const std::string& what) {
  std::vector<Row> rows;
  if (what == "scenes")
    for (const SceneEntry& scene : scene_registry())
      rows.push_back({scene.description.name, scene.description.summary});
  else if (what == "configs")
    for (const ConfigInfo& info : known_configs()) rows.push_back({info.name, info.summary});
  else if (what == "devices")
    for (const gpu::DeviceInfo& info : gpu::list_devices())
      rows.push_back({fmt::format("{}: {}", info.index, info.name),
                      fmt::format("{}, Vulkan {}, {}, UUID {}, second queue: {}{}", info.type,
                                  info.api_version, info.driver, info.uuid, gpu::in_words(info.second_queue),
                                  info.missing.empty() ? "" : "; cannot be used, lacks " + info.missing)});
  else if (what == "metrics") {
    rows = metrics();
    for (const AlgorithmEntry& entry : algorithm_registry())
      for (const CounterInfo& counter : entry.info.counters)
        rows.push_back({counter.name, fmt::format("{} ({})", counter.help, entry.info.name)});
  } else
    rows = effects();
  return rows;
}

ExitCode list(const std::string& what, bool as_json) {
  const std::vector<std::string> known{"algorithms", "scenes", "configs", "devices", "metrics", "effects"};
  if (std::find(known.begin(), known.end(), what) == known.end())
    throw UsageError("list '" + what + "': unknown" + suggestion(what, known));
  if (what == "algorithms") {
    if (as_json)
      fmt::print("{}\n", algorithms_json().dump(2));
    else
      print_algorithms();
  } else if (std::vector<Row> rows = rows_of(what); as_json) {
    fmt::print("{}\n", rows_json(rows).dump(2));
  } else {
    print_rows(rows);
  }
  return ExitCode::done;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  auto what = std::make_shared<std::string>("algorithms");
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "list", "List algorithms with their parameters, scenes, configurations, devices, metrics or effects");
  command->add_option("WHAT", *what, "algorithms, scenes, configs, devices, metrics or effects")
      ->capture_default_str();
  command->add_flag("--json", *as_json, "As JSON");
  command->callback([what, as_json, &action] { action = [what, as_json] { return list(*what, *as_json); }; });
}

}  // namespace ml
