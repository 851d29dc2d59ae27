// prepare() of every algorithm that has work on the CPU, as the program runs it: through the registry,
// 1920x1080, 48 px tiles and 16 slices where there is a grid. `view`: all lights are in view; `canyon`: most
// are culled.
#include <benchmark/benchmark.h>

#include <string>

#include "algorithms/algorithm.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

struct Subject {
  std::string name, algorithm;
  std::vector<std::pair<std::string, ParameterValue>> parameters;
};

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list{
      {"clustered", "clustered", {{"tile", int64_t{48}}}},
      {"clustered/refined", "clustered", {{"tile", int64_t{48}}, {"refinement", true}}},
      {"light_tree", "light_tree", {{"tile", int64_t{48}}}},
      {"hybrid", "hybrid", {{"tile", int64_t{48}}}},
      {"light_bvh/refit", "light_bvh", {{"update", std::string("refit")}}},
      {"light_bvh/rebuild", "light_bvh", {{"update", std::string("rebuild")}}},
      {"fine_pruned", "fine_pruned", {}},
  };
  return list;
}

void prepare(benchmark::State& state, const Subject& subject, MakeInput make, unsigned threads) {
  auto input = make(static_cast<uint32_t>(state.range(0)), threads);
  const AlgorithmEntry& entry = find_algorithm(subject.algorithm, "benchmark");
  Parameters parameters(entry.parameters);
  for (const auto& [name, value] : subject.parameters)
    parameters.set(entry.parameters, name, value, "benchmark");
  auto algorithm = entry.create(parameters);
  HeapMemory memory;
  Spans spans;
  // The first frame is not like the others: buffers grow, trees are built.
  algorithm->prepare(input->frame, memory, spans);
  spans.clear();
  for (auto _ : state) {
    ++input->frame.index;
    input->frame.step = Step::next;
    algorithm->prepare(input->frame, memory, spans);
  }
  state.counters["in_view"] = static_cast<double>(algorithm->counters().in_frustum);
  report_stages(state, spans);
}

void register_all() {
  for (const Subject& subject : subjects())
    for (unsigned threads : {1u, 2u})
      for (bool view : {true, false}) {
        const std::string name =
            subject.name + (view ? "/view" : "/canyon") + (threads == 2 ? "/two_threads" : "");
        const MakeInput make = view ? view_input : canyon_input;
        benchmark::RegisterBenchmark(name.c_str(),
                                     [=](benchmark::State& state) { prepare(state, subject, make, threads); })
            ->RangeMultiplier(4)
            ->Range(8192, 262144)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      }
}

}  // namespace

int main(int argc, char** argv) {
  register_all();
  return ml::bench_inputs::run(argc, argv);
}
