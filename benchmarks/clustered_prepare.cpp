// prepare() of clustered shading: the fast path against plain scalar code as the papers describe it,
// 1920x1080, 48 px tiles, 16 slices.
//
// Two light sets: `view` has every light in the view, at depths spread as the slices are, with radii that
// give about 4.5 froxels a light; `canyon` is the canyon scene at its overlook, where most lights are culled.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "algorithms/clustered/reference_lists.h"
#include "harness/base/random.h"
#include "harness/frame/frame_input.h"

namespace {

using namespace ml;

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

std::unique_ptr<Input> view_input(uint32_t count, unsigned threads) {
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

std::unique_ptr<Input> canyon_input(uint32_t count, unsigned threads) {
  static const Scene scene = [] {
    SceneSpec spec;
    spec.procedural = "canyon";
    return load_scene(spec);
  }();
  LightSpec spec;
  spec.count = count;
  LightSet set(spec, scene);
  Camera camera = scene.path("default").sample(90, 120, width, height, scene.near, scene.far);
  return std::make_unique<Input>(set.base(), camera, threads);
}

ClusterSettings settings_for(bool refinement) {
  ClusterSettings settings;
  settings.tile = 48;
  settings.refinement = refinement;
  return settings;
}

void report(benchmark::State& state, size_t lights, size_t entries) {
  state.counters["ns_per_light"] =
      benchmark::Counter(static_cast<double>(lights),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["froxels_per_light"] = static_cast<double>(entries) / static_cast<double>(lights);
}

using MakeInput = std::unique_ptr<Input> (*)(uint32_t, unsigned);

void plain_scalar(benchmark::State& state, MakeInput make) {
  auto input = make(static_cast<uint32_t>(state.range(0)), 1);
  ReferenceLists lists;
  ClusterSettings settings = settings_for(false);
  for (auto _ : state) lists.build(input->frame, settings);
  report(state, input->frame.lights.count(), lists.indices().size());
}

void fast(benchmark::State& state, MakeInput make, unsigned threads, bool refinement) {
  auto input = make(static_cast<uint32_t>(state.range(0)), threads);
  ClusterLists lists;
  ClusterSettings settings = settings_for(refinement);
  Spans spans;
  for (auto _ : state) lists.build(input->frame, settings, uint64_t{1} << 28, spans);
  report(state, input->frame.lights.count(), lists.indices().size());
  for (const auto& [name, ms] : spans.sums())
    state.counters[name + "_ns_per_light"] =
        ms * 1e6 / static_cast<double>(state.iterations()) / static_cast<double>(state.range(0));
}

BENCHMARK_CAPTURE(plain_scalar, view, view_input)
    ->RangeMultiplier(2)
    ->Range(8192, 65536)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fast, view, view_input, 1u, false)
    ->RangeMultiplier(2)
    ->Range(8192, 65536)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fast, view_two_threads, view_input, 2u, false)
    ->Arg(65536)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(fast, view_refined, view_input, 1u, true)->Arg(65536)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain_scalar, canyon, canyon_input)
    ->RangeMultiplier(2)
    ->Range(8192, 65536)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fast, canyon, canyon_input, 1u, false)
    ->RangeMultiplier(2)
    ->Range(8192, 65536)
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("build_type", ML_BUILD_TYPE);
  benchmark::AddCustomContext("simd", ml::simd::target_name());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
