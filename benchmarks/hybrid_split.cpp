// Prints how the hybrid's prepare() is divided among its stages, beside the paper's figures (Tiled Light
// Trees, section 4.1): medians over frames, in per cent of their sum.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hybrid_settings.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

struct Stage {
  const char* name;
  double paper;  // per cent
};
constexpr std::array<Stage, 5> stages{{{"bin", 50}, {"build", 25}, {"sort", 12}, {"upload", 7}, {"cull", 3}}};

void print_row(const char* lights_name, MakeInput make, uint32_t lights, unsigned threads) {
  auto input = make(lights, threads);
  TreePrepare prepare("hybrid", hybrid_froxels(), {});
  HeapMemory memory;
  std::array<std::vector<double>, stages.size()> samples;
  constexpr int warm_up = 5, frames = 51;
  for (int frame = 0; frame < warm_up + frames; ++frame) {
    Spans spans;
    prepare.prepare(input->frame, memory, spans);
    if (frame < warm_up) continue;
    for (size_t i = 0; i < stages.size(); ++i)
      samples[i].push_back(spans.sums().find(stages[i].name)->second);
  }
  double sum = 0;
  for (auto& values : samples) {
    std::ranges::nth_element(values, values.begin() + frames / 2);
    sum += values[frames / 2];
  }
  fmt::print("{:<8}{:>8}{:>9}{:>9.3f}", lights_name, lights, threads, sum);
  for (const auto& values : samples) fmt::print("{:>9.1f}", 100 * values[frames / 2] / sum);
  fmt::print("\n");
}

}  // namespace

int main() {
  fmt::print("hybrid, 1920x1080, 48 px tiles, 16 slices, {}, {}\n\n", simd::target_name(), ML_BUILD_TYPE);
  fmt::print("{:<8}{:>8}{:>9}{:>9}", "lights", "number", "threads", "ms");
  for (const Stage& stage : stages) fmt::print("{:>7} %", stage.name);
  fmt::print("\n{:<34}", "the paper");
  for (const Stage& stage : stages) fmt::print("{:>9.0f}", stage.paper);
  fmt::print("\n");
  for (unsigned threads : {1u, 2u})
    for (uint32_t lights : {8192u, 65536u, 262144u}) {
      print_row("view", view_input, lights, threads);
      print_row("canyon", canyon_input, lights, threads);
    }
}
