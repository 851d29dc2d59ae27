// The lists of a froxel grid, here and in Filament (Debian's 1.9): the same camera, the same lights in view,
// grids of 32 x 16 x 16 = 8192 froxels from 5 to 100 m. One process, interleaved; the table at the end has
// medians and ratios.
//
// Filament's froxelizer is private: what is timed is Renderer::render() of a scene of nothing but lights on
// the driver that does nothing, less the same without lights. It gathers the lights, culls them and fills
// froxels, as the other side does here from the scene's lights on. Its jobs run on threads of its own, whose
// number its interface does not set; prepare() has one thread. Times are wall time; the process's CPU time
// stands beside them.
#include <benchmark/benchmark.h>
#include <filament/Camera.h>
#include <filament/Engine.h>
#include <filament/LightManager.h>
#include <filament/Renderer.h>
#include <filament/Scene.h>
#include <filament/View.h>
#include <filament/Viewport.h>
#include <fmt/format.h>
#include <utils/EntityManager.h>

#include <ctime>
#include <filesystem>
#include <map>
#include <string>

#include "algorithms/algorithm.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

// 512 tiles of 32 px are what Filament makes of this picture for its 8192 froxels.
constexpr uint32_t picture_width = 1024, picture_height = 512, tile = 32, slices = 16;
constexpr float grid_near = 5, grid_far = 100, near_plane = 0.1f;
constexpr double fov_degrees = 60;
// This version crashes on multiples of 16 lights, and takes 255 at most.
constexpr int light_numbers[] = {100, 255};
constexpr int radii[] = {3, 10, 30};  // m

Camera camera() {
  Camera camera;
  camera.projection =
      Projection::perspective(static_cast<float>(fov_degrees * 3.14159265358979323846 / 180),
                              static_cast<float>(picture_width) / picture_height, near_plane, grid_far);
  return camera;
}

// Centres in the view, as many in each part of the picture and of its depth.
std::vector<Light> lights_in_view(int number, int radius) {
  const Projection window = camera().projection;
  Random random(1);
  std::vector<Light> lights(static_cast<size_t>(number));
  for (Light& light : lights) {
    const float depth = random.uniform(1, grid_far);
    const float x = random.uniform(window.left, window.right), y = random.uniform(window.bottom, window.top);
    light.position = {x * depth, y * depth, -depth};
    light.radius = static_cast<float>(radius);
  }
  return lights;
}

double process_cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Wall time of `body` for the iteration, CPU time of all threads added to `cpu`.
template <typename Body>
void time_iteration(benchmark::State& state, double& cpu, Body&& body) {
  const double cpu_before = process_cpu_seconds();
  const auto before = Clock::now();
  body();
  state.SetIterationTime(milliseconds_between(before, Clock::now()) * 1e-3);
  cpu += process_cpu_seconds() - cpu_before;
}

class FilamentScene {
 public:
  explicit FilamentScene(const std::vector<Light>& lights) {
    using namespace filament;
    swap_chain_ = engine().createSwapChain(picture_width, picture_height);
    renderer_ = engine().createRenderer();
    scene_ = engine().createScene();
    view_ = engine().createView();
    auto& entities = utils::EntityManager::get();
    eye_ = entities.create();
    filament::Camera* eye = engine().createCamera(eye_);
    eye->setProjection(fov_degrees, double{picture_width} / picture_height, near_plane, grid_far,
                       filament::Camera::Fov::VERTICAL);
    view_->setCamera(eye);
    view_->setScene(scene_);
    view_->setViewport({0, 0, picture_width, picture_height});
    view_->setDynamicLightingOptions(grid_near, grid_far);
    view_->setPostProcessingEnabled(false);
    for (const Light& light : lights) {
      const utils::Entity entity = entities.create();
      const glm::vec3 at(light.position);
      LightManager::Builder(LightManager::Type::POINT)
          .position({at.x, at.y, at.z})
          .falloff(light.radius)
          .intensity(1000.0f)
          .build(engine(), entity);
      scene_->addEntity(entity);
      lights_.push_back(entity);
    }
  }
  ~FilamentScene() {
    auto& entities = utils::EntityManager::get();
    for (utils::Entity light : lights_) {
      engine().destroy(light);
      entities.destroy(light);
    }
    engine().destroy(view_);
    engine().destroy(scene_);
    engine().destroy(renderer_);
    engine().destroyCameraComponent(eye_);
    entities.destroy(eye_);
    engine().destroy(swap_chain_);
    engine().flushAndWait();
  }
  FilamentScene(const FilamentScene&) = delete;
  FilamentScene& operator=(const FilamentScene&) = delete;

  void run(benchmark::State& state) {
    double cpu = 0;
    for (auto _ : state) {
      if (!renderer_->beginFrame(swap_chain_)) return state.SkipWithError("Filament skipped a frame");
      time_iteration(state, cpu, [&] { renderer_->render(view_); });
      renderer_->endFrame();
      engine().flushAndWait();
    }
    state.counters["cpu_ms"] = 1e3 * cpu / static_cast<double>(state.iterations());
  }

  static filament::Engine& engine() {
    static filament::Engine* made = filament::Engine::create(filament::Engine::Backend::NOOP);
    return *made;
  }

 private:
  filament::SwapChain* swap_chain_;
  filament::Renderer* renderer_;
  filament::Scene* scene_;
  filament::View* view_;
  utils::Entity eye_;
  std::vector<utils::Entity> lights_;
};

void filament_render(benchmark::State& state, int number, int radius) {
  FilamentScene scene(lights_in_view(number, radius));
  scene.run(state);
}

void clustered_prepare(benchmark::State& state, int number, int radius) {
  const AlgorithmEntry& entry = find_algorithm("clustered", "benchmark");
  Parameters parameters(entry.parameters);
  const auto set = [&](const char* name, const ParameterValue& value) {
    parameters.set(entry.parameters, name, value, "benchmark");
  };
  set("tile", int64_t{tile});
  set("slices", int64_t{slices});
  set("zmin", double{grid_near});
  set("zmax", double{grid_far});
  auto algorithm = entry.create(parameters);
  const std::vector<Light> lights = lights_in_view(number, radius);
  Threads threads(1);
  FrameLightStorage storage;
  FrameInput frame;
  frame.view = view_data(camera(), picture_width, picture_height, static_cast<uint32_t>(lights.size()));
  frame.threads = &threads;
  HeapMemory memory;
  Spans spans;
  double cpu = 0;
  for (auto _ : state)
    time_iteration(state, cpu, [&] {
      storage.fill(lights, camera().position);
      frame.lights = storage.lights();
      algorithm->prepare(frame, memory, spans);
    });
  state.counters["cpu_ms"] = 1e3 * cpu / static_cast<double>(state.iterations());
  for (const auto& [stage, ms] : spans.sums())
    state.counters[stage + "_ms"] = ms / static_cast<double>(state.iterations());
  state.counters["in_view"] = static_cast<double>(algorithm->counters().in_frustum);
  state.counters["list_bytes"] = static_cast<double>(algorithm->counters().list_bytes);
}

std::string name_of(const char* side, int number, int radius) {
  return fmt::format("{}/{}_lights/{}_m", side, number, radius);
}

// Passes everything on to the console and keeps the medians for the table.
class Medians final : public benchmark::ConsoleReporter {
 public:
  Medians() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.aggregate_name == "median") {
        std::string name = run.run_name.function_name;
        seconds_[name] = run.GetAdjustedRealTime();
        cpu_ms_[name] = run.counters.at("cpu_ms");
      }
    ConsoleReporter::ReportRuns(runs);
  }
  void print() const {
    fmt::print("\n{:>7}{:>8}{:>15}{:>17}{:>15}{:>8}\n", "lights", "radius", "clustered ms", "Filament ms",
               "its CPU ms", "ratio");
    for (int number : light_numbers)
      for (int radius : radii) {
        const std::string none = name_of("filament", 0, 0), theirs = name_of("filament", number, radius),
                          ours = name_of("clustered", number, radius);
        if (!seconds_.contains(none) || !seconds_.contains(theirs) || !seconds_.contains(ours)) continue;
        const double wall = seconds_.at(theirs) - seconds_.at(none), own = seconds_.at(ours);
        fmt::print("{:>7}{:>6} m{:>15.4f}{:>17.4f}{:>15.4f}{:>8.1f}\n", number, radius, own, wall,
                   cpu_ms_.at(theirs) - cpu_ms_.at(none), wall / own);
      }
    const auto tasks = std::filesystem::directory_iterator("/proc/self/task");
    fmt::print(
        "Filament less its frame without lights; its engine made this process {} threads, clustered has 1\n",
        std::distance(begin(tasks), end(tasks)));
  }

 private:
  std::map<std::string, double> seconds_, cpu_ms_;  // seconds_: in the unit of the benchmarks, ms
};

void add(const std::string& name, void (*body)(benchmark::State&, int, int), int number, int radius) {
  benchmark::RegisterBenchmark(name.c_str(), body, number, radius)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("build_type", ML_BUILD_TYPE);
  benchmark::AddCustomContext("vector_target", simd::target_name());
  // What is asked for on the command line comes after, and wins.
  std::vector<std::string> words{argv[0], "--benchmark_enable_random_interleaving=true",
                                 "--benchmark_repetitions=15", "--benchmark_min_time=0.02",
                                 "--benchmark_report_aggregates_only=true"};
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  add(name_of("filament", 0, 0), filament_render, 0, 0);
  for (int number : light_numbers)
    for (int radius : radii) {
      add(name_of("filament", number, radius), filament_render, number, radius);
      add(name_of("clustered", number, radius), clustered_prepare, number, radius);
    }
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  medians.print();
  filament::Engine* engine = &FilamentScene::engine();
  filament::Engine::destroy(&engine);
  return 0;
}
