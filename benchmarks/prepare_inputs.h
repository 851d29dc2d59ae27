// What the benchmarks of prepare() share: light sets, memory to upload to, and how results are reported.
//
// Three light sets: `view` has every light in the view, at depths spread as the slices are, with radii that
// give about 4 froxels a light, however many there are; `canyon` and `citadel` are levels, the one at its
// overlook, where most lights are culled.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/froxels/binning.h"
#include "algorithms/heap_memory.h"
#include "algorithms/vector_target.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/frame/frame_input.h"
#include "scenes/load_scene.h"

namespace ml::bench_inputs {

constexpr uint32_t width = 1920, height = 1080;

struct Input {
  Threads threads;
  FrameLightStorage storage;
  FrameInput frame;
  Input(const std::vector<Light>& lights, const Camera& camera, unsigned thread_count)
      : threads(thread_count) {
    storage.fill(lights, camera.position);
    frame.view = view_data(camera, width, height, static_cast<uint32_t>(lights.size()));
    frame.lights = storage.lights();
    frame.threads = &threads;
  }
};

using MakeInput = std::unique_ptr<Input> (*)(uint32_t, unsigned);

inline std::unique_ptr<Input> view_input(uint32_t count, unsigned threads) {
  Camera camera;
  camera.projection = Projection::perspective(1.0471976f, static_cast<float>(width) / height, 0.1f, 500);
  Random random(1);
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    float depth = 5 * std::pow(100.0f, random.uniform());
    float x = random.uniform(camera.projection.left, camera.projection.right) * depth;
    float y = random.uniform(camera.projection.bottom, camera.projection.top) * depth;
    light.position = {x, y, -depth};
    light.radius = depth * 0.0085f * pareto_radius(random.uniform(), 1, 32);
  }
  return std::make_unique<Input>(lights, camera, threads);
}

inline Scene procedural(const char* name) {
  SceneSpec spec;
  spec.procedural = name;
  return load_scene(spec);
}

// The level's own lights (fewer are larger, so that each point has as many), from one point of its path.
inline std::unique_ptr<Input> level_input(const Scene& scene, uint32_t count, unsigned threads,
                                          uint32_t frame) {
  LightSpec spec;
  spec.count = count;
  LightSet set(spec, scene);
  Camera camera = scene.path("default").sample(frame, 120, width, height, scene.near, scene.far);
  return std::make_unique<Input>(set.base(), camera, threads);
}

inline std::unique_ptr<Input> canyon_input(uint32_t count, unsigned threads) {
  static const Scene scene = procedural("canyon");
  return level_input(scene, count, threads, 90);
}

inline std::unique_ptr<Input> citadel_input(uint32_t count, unsigned threads) {
  static const Scene scene = procedural("citadel");
  return level_input(scene, count, threads, 30);
}

inline void report(benchmark::State& state, size_t lights, size_t entries) {
  state.counters["ns_per_light"] =
      benchmark::Counter(static_cast<double>(lights),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["cells_per_light"] = static_cast<double>(entries) / static_cast<double>(lights);
}

inline void report_stages(benchmark::State& state, const Spans& spans) {
  for (const auto& [name, ms] : spans.sums())
    state.counters[name + "_ns_per_light"] =
        ms * 1e6 / static_cast<double>(state.iterations()) / static_cast<double>(state.range(0));
}

// Google Benchmark's options, and --target=NAME: the instruction set that vector code uses, instead of the
// best.
inline int run(int argc, char** argv) {
  constexpr std::string_view option = "--target=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(option)) continue;
    try {
      simd::use_target(std::string(argument.substr(option.size())));
    } catch (const UsageError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return 2;
    }
    std::copy(argv + i + 1, argv + argc, argv + i);
    --argc;
    break;
  }
  benchmark::AddCustomContext("build_type", ML_BUILD_TYPE);
  benchmark::AddCustomContext("vector_target", simd::target_name());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace ml::bench_inputs
