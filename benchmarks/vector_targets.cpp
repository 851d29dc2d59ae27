// Prints what each stage of prepare() costs with every instruction set that the processor has for vector
// code, beside plain scalar code as the papers describe it: the least of many interleaved frames, one thread,
// in nanoseconds a light.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>

#include "algorithms/froxels/reference_lists.h"
#include "algorithms/trees/reference_trees.h"
#include "hybrid_settings.h"
#include "prepare_inputs.h"

namespace {

using namespace ml;
using namespace ml::bench_inputs;

constexpr std::array<const char*, 5> stages{"cull", "sort", "bin", "build", "upload"};
constexpr const char* plain_scalar = "scalar";

// One way of preparing frames, and the least time of each stage.
class Row {
 public:
  Row(std::string name, bool trees, const TreeSettings& cell_trees)
      : name_(std::move(name)),
        trees_(trees),
        tree_settings_(cell_trees),
        prepare_("hybrid", froxels(), cell_trees) {
    least_.fill(std::numeric_limits<double>::infinity());
  }

  const std::string& name() const { return name_; }
  double stage(size_t s) const { return least_[s]; }
  double total() const { return std::accumulate(least_.begin(), least_.end(), 0.0); }

  void frame(const FrameInput& frame) {
    Spans spans;
    if (name_ == plain_scalar) {
      reference(frame, spans);
    } else {
      simd::use_target(name_);
      if (trees_)
        prepare_.prepare(frame, memory_, spans);
      else
        lists_.build(frame, froxels(), memory_, 0, spans);
      simd::use_target("");
    }
    for (size_t s = 0; s < stages.size(); ++s) {
      const auto found = spans.sums().find(stages[s]);
      const double ms = found == spans.sums().end() ? 0 : found->second;
      least_[s] = std::min(least_[s], ms);
    }
  }

 private:
  FroxelSettings froxels() const {
    FroxelSettings settings = hybrid_froxels();
    if (!trees_) settings.order = FroxelSettings::Order::index;
    return settings;
  }
  void reference(const FrameInput& frame, Spans& spans) {
    reference_lists_.build(frame, froxels(), spans);
    if (!trees_) return;
    auto span = spans.span("build");
    reference_trees_.build(reference_lists_, tree_settings_);
  }

  std::string name_;
  bool trees_;
  TreeSettings tree_settings_;
  TreePrepare prepare_;
  FroxelLists lists_{"clustered"};
  ReferenceLists reference_lists_;
  ReferenceTrees reference_trees_;
  HeapMemory memory_;
  std::array<double, stages.size()> least_{};
};

void print_table(const char* title, MakeInput make, uint32_t lights, bool trees) {
  auto input = make(lights, 1);
  std::vector<Row> rows;
  for (const std::string& target : simd::target_names()) rows.emplace_back(target, trees, TreeSettings{});
  rows.emplace_back(plain_scalar, trees, TreeSettings{});
  // The first frame takes memory, and each row finds the caches full of what the one before it left there.
  for (int round = 0; round < 21; ++round)
    for (Row& row : rows)
      for (int frame = 0; frame < 4; ++frame) row.frame(input->frame);
  fmt::print("\n{}, {} lights\n{:<9}", title, lights, "");
  for (const char* stage : stages) fmt::print("{:>9}", stage);
  fmt::print("{:>9}{:>10}\n", "all", "x scalar");
  const double scalar = rows.back().total();
  for (const Row& row : rows) {
    fmt::print("{:<9}", row.name());
    for (size_t s = 0; s < stages.size(); ++s) fmt::print("{:>9.1f}", row.stage(s) * 1e6 / lights);
    fmt::print("{:>9.1f}{:>10.2f}\n", row.total() * 1e6 / lights, scalar / row.total());
  }
}

}  // namespace

int main() {
  fmt::print("prepare(), 1920x1080, 48 px tiles, 16 slices, one thread, ns a light, {}\n", ML_BUILD_TYPE);
  print_table("hybrid, all lights in view", view_input, 65536, true);
  print_table("hybrid, canyon", canyon_input, 65535, true);
  print_table("clustered, all lights in view", view_input, 65536, false);
  print_table("clustered, canyon", canyon_input, 65535, false);
}
