#include "harness/bench/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/bench/setup_run.h"

namespace ml {
namespace {

// Seconds per unit on two cores of the software device, from the spans of a run of `quick` (harness.spans_ms
// over pixels, lights and laps).
constexpr double per_shaded_pixel = 0.064e-6;    // list walk and shading of a handful of lights
constexpr double per_brute_force_test = 4.6e-9;  // one light for one pixel: 609 ms for 1024 at 480x270
constexpr double per_frame_pixel = 0.46e-6;      // g-buffer, and finding the contributing lights of a pixel
constexpr double per_light = 0.04e-6;            // script, upload, prepare
constexpr double per_counted_pixel = 0.09e-6;    // counting lap: reading six counters back
constexpr double per_shadow_pixel = 3.1e-9;      // one pixel of a depth-only picture: 13 ms for 4 of 1024 px
constexpr double start = 1.0;                    // device, calibration, scene

}  // namespace

Estimate estimate_run(const Config& config, const std::vector<Case>& cases) {
  Estimate estimate;
  estimate.seconds = start;
  std::set<size_t> setups;
  double laps = 1.0 + config.measure.warmup + config.measure.repeats;
  for (const Case& item : cases) {
    const Setup& setup = config.setups[item.setup];
    const AlgorithmInfo& info = find_algorithm(setup.algorithms[item.algorithm].name, item.id).info;
    double pixels = static_cast<double>(setup.width) * setup.height, frames = setup.camera.frames,
           lights = setup.lights.count;
    double shade = info.reference_only ? pixels * lights * per_brute_force_test : pixels * per_shaded_pixel;
    const double shadow_pixels =
        1.0 * setup.shading.shadow_maps * setup.shading.shadow_map_size * setup.shading.shadow_map_size;
    shade += shadow_pixels * per_shadow_pixel;
    estimate.seconds += frames * (laps * (shade + lights * per_light) + pixels * per_counted_pixel);
    if (setups.insert(item.setup).second) {
      estimate.seconds += frames * laps * (pixels * per_frame_pixel + lights * per_light);
      // Depth 4, surface 8, result 16, counters 24, reference 8 and its copies 8, lists about 16 bytes a
      // pixel.
      auto bytes = static_cast<uint64_t>(pixels * 84 + lights * 200 + shadow_pixels * 4);
      estimate.memory_bytes = std::max(estimate.memory_bytes, bytes);
    }
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
