// prepare() of clustered shading: the fast path against plain scalar code as the papers describe it,
// 1920x1080, 48 px tiles, 16 slices.
#include <benchmark/benchmark.h>

#include "algorithms/froxels/reference_lists.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

FroxelSettings settings_for(bool refinement) {
  FroxelSettings settings;
  settings.tile = 48;
  settings.refinement = refinement;
  return settings;
}

void plain_scalar(benchmark::State& state, MakeInput make) {
  auto input = make(static_cast<uint32_t>(state.range(0)), 1);
  ReferenceLists lists;
  FroxelSettings settings = settings_for(false);
  lists.build(input->frame, settings);  // the first frame takes memory
  for (auto _ : state) lists.build(input->frame, settings);
  report(state, input->frame.lights.count(), lists.entries().size());
}

void fast(benchmark::State& state, MakeInput make, unsigned threads, bool refinement) {
  auto input = make(static_cast<uint32_t>(state.range(0)), threads);
  FroxelLists lists{"clustered"};
  FroxelSettings settings = settings_for(refinement);
  Spans spans;
  lists.build(input->frame, settings, uint64_t{1} << 28, spans);
  spans.clear();
  for (auto _ : state) lists.build(input->frame, settings, uint64_t{1} << 28, spans);
  report(state, input->frame.lights.count(), lists.entries().size());
  report_stages(state, spans);
}

#define SIZES RangeMultiplier(2)->Range(8192, 262144)->Unit(benchmark::kMillisecond)

BENCHMARK_CAPTURE(plain_scalar, view, view_input)->SIZES;
BENCHMARK_CAPTURE(fast, view, view_input, 1u, false)->SIZES;
BENCHMARK_CAPTURE(fast, view_two_threads, view_input, 2u, false)->SIZES->UseRealTime();
BENCHMARK_CAPTURE(fast, view_refined, view_input, 1u, true)->Arg(65536)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain_scalar, canyon, canyon_input)->SIZES;
BENCHMARK_CAPTURE(fast, canyon, canyon_input, 1u, false)->SIZES;

}  // namespace

int main(int argc, char** argv) {
  return ml::bench_inputs::run(argc, argv);
}
