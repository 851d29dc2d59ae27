#include "harness/bench/estimate.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/bench/setup_run.h"

namespace ml {
namespace {

// Seconds per unit on two cores of the software device, from the spans of runs of `quick` and `light_counts`
// (harness.spans_ms over pixels, lights and laps).
constexpr double per_shaded_pixel = 0.04e-6;   // list walk and shading of a handful of lights
constexpr double per_frame_pixel = 0.8e-6;     // g-buffer, and finding the contributing lights of a pixel:
constexpr double per_pixel_light = 0.06e-9;    // more of it with more lights
constexpr double per_light = 0.04e-6;          // script, upload, prepare
constexpr double per_counted_pixel = 0.25e-6;  // counting lap: reading six counters back
constexpr double per_shadow_pixel = 3.1e-9;    // one pixel of a depth-only picture: 13 ms for 4 of 1024 px
constexpr double start = 1.0;                  // device, calibration
constexpr double per_setup = 0.3, per_case = 0.4;  // scene; programs

double shadow_pixels(const Setup& setup) {
  return 1.0 * setup.shading.shadow_maps * setup.shading.shadow_map_size * setup.shading.shadow_map_size;
}

double frame_seconds(const Setup& setup, const AlgorithmSpec& algorithm, const AlgorithmEntry& entry) {
  const double pixels = static_cast<double>(setup.width) * setup.height;
  double seconds =
      pixels * per_shaded_pixel + setup.lights.count * per_light + shadow_pixels(setup) * per_shadow_pixel;
  if (entry.further_seconds)
    seconds += entry.further_seconds(algorithm.parameters, setup.width, setup.height, setup.lights.count);
  return seconds;
}

}  // namespace

CaseSeconds case_seconds(const Config& config, const Case& item, const std::vector<Case>& cases) {
  const Setup& setup = config.setups[item.setup];
  const AlgorithmSpec& algorithm = setup.algorithms[item.algorithm];
  // Contributing lights are found for counting, and in every lap where a case needs their lists.
  double sharing = 0;
  bool every_lap = false;
  for (const Case& other : cases) {
    if (other.setup != item.setup) continue;
    ++sharing;
    every_lap |=
        find_algorithm(setup.algorithms[other.algorithm].name, other.id).info.needs_contributing_lists;
  }
  const double pixels = static_cast<double>(setup.width) * setup.height, lights = setup.lights.count;
  const double search =
      (pixels * (per_frame_pixel + lights * per_pixel_light) + lights * per_light) / sharing;
  const double frame = frame_seconds(setup, algorithm, find_algorithm(algorithm.name, item.id));
  return {per_case + per_setup / sharing, frame + search + pixels * per_counted_pixel,
          frame + (every_lap ? search : 0)};
}

Estimate estimate_run(const Config& config, const std::vector<Case>& cases) {
  Estimate estimate;
  estimate.seconds = start;
  const double laps = config.measure.warmup + config.measure.repeats;
  for (const Case& item : cases) {
    const Setup& setup = config.setups[item.setup];
    const CaseSeconds seconds = case_seconds(config, item, cases);
    estimate.seconds += seconds.programs + setup.camera.frames * (seconds.counting + laps * seconds.timing);
    // Depth 4, surface 8, result 16, counters 24, reference 8 and its copies 8, lists about 16 bytes a pixel.
    const double pixels = static_cast<double>(setup.width) * setup.height;
    estimate.memory_bytes =
        std::max(estimate.memory_bytes,
                 static_cast<uint64_t>(pixels * 84 + setup.lights.count * 200.0 + shadow_pixels(setup) * 4));
  }
  return estimate;
}

std::string describe_cases(const Config& config, const std::vector<Case>& cases) {
  std::string text;
  for (const Case& item : cases) {
    const Setup& setup = config.setups[item.setup];
    const AlgorithmSpec& spec = setup.algorithms[item.algorithm];
    text += fmt::format("{}\n    {} {}, {} lights, {}x{}, {} frames\n", item.id, spec.name,
                        parameters_json(spec.parameters).dump(), setup.lights.count, setup.width,
                        setup.height, setup.camera.frames);
  }
  Estimate estimate = estimate_run(config, cases);
  text += fmt::format(
      "{} cases, {} warm-up and {} measured laps: about {:.0f} s and {:.0f} MB on two cores of a software "
      "device\n",
      cases.size(), config.measure.warmup, config.measure.repeats, estimate.seconds,
      static_cast<double>(estimate.memory_bytes) / 1e6 + 200);
  return text;
}

}  // namespace ml
