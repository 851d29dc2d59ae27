// The stages of prepare(), each by itself: the code that runs beside plain scalar code as the papers describe
// it. All lights are in view; 1920x1080, 48 px tiles, 16 slices.
#include <benchmark/benchmark.h>

#include <string>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/trees/reference_trees.h"
#include "hybrid_settings.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

double seconds_of(const Spans& spans, const std::string& stage) {
  return spans.sums().find(stage)->second * 1e-3;
}

// Whole frames are prepared, and the stage's own span is the time that counts.
void fast(benchmark::State& state, const std::string& stage, unsigned threads) {
  auto input = view_input(static_cast<uint32_t>(state.range(0)), threads);
  TreePrepare prepare("hybrid", hybrid_froxels(), {});
  HeapMemory memory;
  Spans spans;
  for (auto _ : state) {
    spans.clear();
    prepare.prepare(input->frame, memory, spans);
    state.SetIterationTime(seconds_of(spans, stage));
  }
  report(state, input->frame.lights.count(), prepare.lists().entries().size());
}

template <typename Element>
void upload(UploadMemory& memory, uint32_t slot, const std::vector<Element>& from) {
  std::span<std::byte> to = memory.map(slot, from.size() * sizeof(Element));
  std::copy(from.begin(), from.end(), reinterpret_cast<Element*>(to.data()));
}

void scalar(benchmark::State& state, const std::string& stage) {
  auto input = view_input(static_cast<uint32_t>(state.range(0)), 1);
  ReferenceLists lists;
  ReferenceTrees cell_trees;
  HeapMemory memory;
  Spans spans;
  for (auto _ : state) {
    spans.clear();
    lists.build(input->frame, hybrid_froxels(), spans);
    {
      auto span = spans.span("build");
      cell_trees.build(lists, {});
    }
    {
      auto span = spans.span("upload");
      upload(memory, 0, cell_trees.cells());
      upload(memory, 1, cell_trees.nodes());
      upload(memory, 2, cell_trees.lights());
    }
    state.SetIterationTime(seconds_of(spans, stage));
  }
  report(state, input->frame.lights.count(), lists.entries().size());
}

// What is within the span `bin`: the froxel boxes of the lights, and the froxels that a box's refinement
// leaves.
struct Boxes {
  std::unique_ptr<Input> input;
  BoundsConstants constants;
  VisibleLights visible;
  std::vector<LightBox> boxes;
  uint64_t pairs = 0;
  explicit Boxes(uint32_t lights)
      : input(view_input(lights, 1)),
        constants(input->frame.view, FroxelGrid::make(input->frame.view, 48, 16, 5, 0)) {
    visible.reserve(lights);
    visible.count = simd::cull(input->frame.lights, 0, lights, constants, visible);
    reserve_padded(boxes, visible.count);
    pairs = simd::bound(visible, constants, boxes.data());
  }
};

using Bound = uint64_t (*)(const VisibleRun&, const BoundsConstants&, LightBox*);

void bounds(benchmark::State& state, Bound bound) {
  Boxes given(static_cast<uint32_t>(state.range(0)));
  for (auto _ : state) {
    bound(given.visible, given.constants, given.boxes.data());
    benchmark::DoNotOptimize(given.boxes.data());
    benchmark::ClobberMemory();
  }
  report(state, given.visible.count, given.pairs);
}

enum class Narrowing { none, rows, ball_scalar, ball };

void refine(benchmark::State& state, Narrowing narrowing) {
  Boxes given(static_cast<uint32_t>(state.range(0)));
  RefinementPlanes planes;
  planes.build(given.constants);
  BallTest test;
  test.build(given.constants);
  BoxOffsets offsets;
  offsets.build(given.constants.grid);
  FroxelPairs pairs;
  reserve_pairs(pairs, given.pairs);
  for (auto _ : state) {
    const LightBox* boxes = given.boxes.data();
    const size_t count = given.visible.count;
    switch (narrowing) {
      case Narrowing::none:
        simd::emit(boxes, nullptr, count, given.constants.grid, offsets, pairs);
        break;
      case Narrowing::rows:
        emit_refined(given.visible, boxes, nullptr, 0, count, given.constants, planes, pairs);
        break;
      case Narrowing::ball_scalar:
        scalar::emit_tested(given.visible, boxes, nullptr, 0, count, given.constants, test, nullptr, pairs);
        break;
      case Narrowing::ball:
        simd::emit_tested(given.visible, boxes, nullptr, 0, count, given.constants, test, offsets, nullptr,
                          pairs);
        break;
    }
    benchmark::DoNotOptimize(pairs.cell.data());
    benchmark::ClobberMemory();
  }
  report(state, given.visible.count, pairs.count);
}

void register_all() {
  const auto sized = [](benchmark::internal::Benchmark* made) {
    return made->RangeMultiplier(4)->Range(8192, 262144)->Unit(benchmark::kMicrosecond);
  };
  for (const std::string stage : {"cull", "sort", "bin", "build", "upload"}) {
    const auto timed = [&](const std::string& name, auto body) {
      sized(benchmark::RegisterBenchmark((stage + "/" + name).c_str(), body))->UseManualTime()->MinTime(0.05);
    };
    timed("scalar", [stage](benchmark::State& state) { scalar(state, stage); });
    timed("fast", [stage](benchmark::State& state) { fast(state, stage, 1); });
    timed("fast/two_threads", [stage](benchmark::State& state) { fast(state, stage, 2); });
  }
  sized(benchmark::RegisterBenchmark("bounds/scalar", bounds, scalar::bound));
  sized(benchmark::RegisterBenchmark("bounds/fast", bounds, simd::bound));
  sized(benchmark::RegisterBenchmark("refine/without", refine, Narrowing::none));
  sized(benchmark::RegisterBenchmark("refine/with", refine, Narrowing::rows));
  sized(benchmark::RegisterBenchmark("ball_test/scalar", refine, Narrowing::ball_scalar));
  sized(benchmark::RegisterBenchmark("ball_test/fast", refine, Narrowing::ball));
}

}  // namespace

int main(int argc, char** argv) {
  register_all();
  return ml::bench_inputs::run(argc, argv);
}
