// prepare() of the hybrid and of light trees: the fast path against plain scalar code as the paper describes
// it (radix sort included), 1920x1080, 48 px tiles, 16 slices.
#include "algorithms/trees/tree_prepare.h"

#include <benchmark/benchmark.h>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/trees/reference_trees.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

FroxelSettings froxels(bool tiles) {
  FroxelSettings settings;
  settings.tile = 48;
  if (tiles) settings.slices = 1;
  settings.order = FroxelSettings::Order::depth;
  return settings;
}

TreeSettings trees(bool tiles) {
  TreeSettings settings;
  if (tiles) settings.threshold = std::numeric_limits<float>::infinity();
  return settings;
}

void plain_scalar(benchmark::State& state, MakeInput make, bool tiles) {
  auto input = make(static_cast<uint32_t>(state.range(0)), 1);
  ReferenceLists lists;
  ReferenceTrees cell_trees;
  std::vector<gpu_data::TreeNode> nodes;
  const auto frame = [&] {
    lists.build(input->frame, froxels(tiles));
    cell_trees.build(lists, trees(tiles));
    nodes = cell_trees.nodes();  // the upload
    benchmark::DoNotOptimize(nodes.data());
  };
  frame();  // on both sides the first frame, which takes memory, does not count
  for (auto _ : state) frame();
  report(state, input->frame.lights.count(), lists.entries().size());
}

void prepare_frames(benchmark::State& state, MakeInput make, unsigned threads, const FroxelSettings& froxels,
                    const TreeSettings& trees) {
  auto input = make(static_cast<uint32_t>(state.range(0)), threads);
  TreePrepare prepare("hybrid", froxels, trees);
  HeapMemory memory;
  Spans spans;
  prepare.prepare(input->frame, memory, spans);
  spans.clear();
  for (auto _ : state) prepare.prepare(input->frame, memory, spans);
  report(state, input->frame.lights.count(), prepare.lists().entries().size());
  report_stages(state, spans);
}

void fast(benchmark::State& state, MakeInput make, unsigned threads, bool tiles) {
  prepare_frames(state, make, threads, froxels(tiles), trees(tiles));
}

// The hybrid where no cell becomes a tree: what is left of its growth.
void lists(benchmark::State& state, MakeInput make) {
  TreeSettings settings = trees(false);
  settings.threshold = 0;
  prepare_frames(state, make, 1, froxels(false), settings);
}

#define SIZES RangeMultiplier(2)->Range(8192, 262144)->Unit(benchmark::kMillisecond)

BENCHMARK_CAPTURE(plain_scalar, hybrid_view, view_input, false)->SIZES;
BENCHMARK_CAPTURE(fast, hybrid_view, view_input, 1u, false)->SIZES;
BENCHMARK_CAPTURE(fast, hybrid_view_two_threads, view_input, 2u, false)->SIZES->UseRealTime();
BENCHMARK_CAPTURE(lists, hybrid_view, view_input)->SIZES;
BENCHMARK_CAPTURE(plain_scalar, hybrid_canyon, canyon_input, false)->SIZES;
BENCHMARK_CAPTURE(fast, hybrid_canyon, canyon_input, 1u, false)->SIZES;
BENCHMARK_CAPTURE(fast, hybrid_canyon_two_threads, canyon_input, 2u, false)->SIZES->UseRealTime();
BENCHMARK_CAPTURE(plain_scalar, hybrid_citadel, citadel_input, false)->SIZES;
BENCHMARK_CAPTURE(fast, hybrid_citadel, citadel_input, 1u, false)->SIZES;
BENCHMARK_CAPTURE(plain_scalar, light_tree_canyon, canyon_input, true)->SIZES;
BENCHMARK_CAPTURE(fast, light_tree_canyon, canyon_input, 1u, true)->SIZES;

}  // namespace

int main(int argc, char** argv) {
  return ml::bench_inputs::run(argc, argv);
}
