// Runs each stage of prepare() once after a warm-up, scalar and fast, for scripts/count_instructions.py: it
// runs this program under callgrind, which begins a new count at every reading of the clock. Prints a line
// for each span in the order in which they are opened: `FORM STAGE`, or `- -` where nothing is to be counted.
#include <fmt/format.h>

#include <initializer_list>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/trees/reference_trees.h"
#include "hybrid_settings.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

constexpr uint32_t lights = 4096;

void print(const char* form, std::initializer_list<const char*> stages, bool warm_up) {
  for (const char* stage : stages) fmt::print("{} {}\n", warm_up ? "-" : form, warm_up ? "-" : stage);
}

// The hybrid's stages, all lights in view.
void hybrid() {
  auto input = view_input(lights, 1);
  ReferenceLists lists;
  ReferenceTrees cell_trees;
  TreePrepare prepare("hybrid", hybrid_froxels(), {});
  HeapMemory memory;
  Spans spans;
  for (bool warm_up : {true, false}) {
    lists.build(input->frame, hybrid_froxels(), spans);
    print("scalar", {"cull", "sort", "bin"}, warm_up);
    {
      auto span = spans.span("build");
      cell_trees.build(lists, {});
    }
    print("scalar", {"build"}, warm_up);
    prepare.prepare(input->frame, memory, spans);
    print("fast", {"cull", "sort", "bin", "build", "upload"}, warm_up);
  }
}

// What is within `bin`.
void bounds() {
  auto input = view_input(lights, 1);
  const BoundsConstants constants(input->frame.view, FroxelGrid::make(input->frame.view, 48, 16, 5, 0));
  VisibleLights visible;
  visible.reserve(lights);
  visible.count = simd::cull(input->frame.lights, 0, lights, constants, visible);
  std::vector<LightBox> boxes;
  reserve_padded(boxes, visible.count);
  FroxelPairs pairs;
  reserve_pairs(pairs, simd::bound(visible, constants, boxes.data()));
  BoxOffsets offsets;
  offsets.build(constants.grid);
  BallTest test;
  test.build(constants);
  Spans spans;
  for (bool warm_up : {true, false}) {
    {
      auto span = spans.span("bounds");
      scalar::bound(visible, constants, boxes.data());
    }
    print("scalar", {"bounds"}, warm_up);
    {
      auto span = spans.span("bounds");
      simd::bound(visible, constants, boxes.data());
    }
    print("fast", {"bounds"}, warm_up);
    {
      auto span = spans.span("ball_test");
      scalar::emit_tested(visible, boxes.data(), nullptr, 0, visible.count, constants, test, nullptr, pairs);
    }
    print("scalar", {"ball_test"}, warm_up);
    {
      auto span = spans.span("ball_test");
      simd::emit_tested(visible, boxes.data(), nullptr, 0, visible.count, constants, test, offsets, nullptr,
                        pairs);
    }
    print("fast", {"ball_test"}, warm_up);
  }
}

// Few lights that cover dozens of froxels each, so that lists are made row by row.
void list_rows() {
  Camera camera;
  camera.projection = Projection::perspective(1.0471976f, static_cast<float>(width) / height, 0.1f, 500);
  Random random(1);
  std::vector<Light> large(256);
  for (Light& light : large) {
    light.position = {random.uniform(-20, 20), random.uniform(-10, 10), -random.uniform(20, 40)};
    light.radius = 8;
  }
  Input input(large, camera, 1);
  FroxelSettings settings = hybrid_froxels();
  settings.order = FroxelSettings::Order::index;
  ReferenceLists reference;
  FroxelLists lists("clustered");
  HeapMemory memory;
  Spans spans;
  for (bool warm_up : {true, false}) {
    reference.build(input.frame, settings, spans);
    print("scalar", {"few_cull", "sweep"}, warm_up);
    lists.build(input.frame, settings, memory, 0, spans);
    print("fast", {"few_cull", "sweep"}, warm_up);
  }
  if (!lists.built_by_rows()) throw std::logic_error("the lists were not made row by row");
}

}  // namespace

int main() {
  hybrid();
  bounds();
  list_rows();
}
