#include "algorithms/fine_pruned/fine_pruned.h"

#include <algorithm>
#include <cstring>

#include "algorithms/device_algorithm.h"
#include "algorithms/fine_pruned/list_passes.h"
#include "algorithms/fine_pruned/visible_lights.h"
#include "algorithms/froxels/froxel_parameters.h"
#include "spirv/fine_pruned_forward.h"
#include "spirv/fine_pruned_forward_counting.h"
#include "spirv/fine_pruned_shade.h"
#include "spirv/fine_pruned_shade_counting.h"

namespace ml {
namespace {

enum Slot : uint32_t { visible_slot };

uint32_t prune_of(const std::string& word) {
  return word == "facing" ? ML_PRUNE_FACING : word == "fine" ? ML_PRUNE_FINE : ML_PRUNE_COARSE;
}

uint32_t bounds_of(const std::string& word) {
  return word == "ball" ? ML_BOUNDS_BALL : word == "box" ? ML_BOUNDS_BOX : ML_BOUNDS_HULL;
}

class FinePruned final : public Algorithm {
 public:
  explicit FinePruned(const Parameters& p) : together_(walk_together(p)) {
    settings_.packed = p.choice("caps") == "paper";
    settings_.prune = prune_of(p.choice("prune"));
    settings_.bounds = bounds_of(p.choice("bounds"));
    settings_.tile_depths = p.boolean("tile_depths");
    settings_.region_lights = static_cast<uint32_t>(p.integer("region_lights"));
  }

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    lights_.cull(frame, spans);
    lights_.sort(frame, settings_.packed ? ML_PACKED_VISIBLE : ML_LIGHT_ID_MASK, spans);
    auto span = spans.span("upload");
    const gpu_data::VisibleHeader& header = lights_.header();
    entries_ = settings_.packed ? 0 : lights_.max_entries_of_tiles(frame);
    longest_walk_ = settings_.packed ? 2 * ML_PACKED_LIGHTS : lights_.max_in_a_tile();
    // Where the device may have no space for all lists, some tiles walk all lights in view.
    if (entries_ > memory.limit() / 8) longest_walk_ = header.count;
    const size_t index_bytes = lights_.lights().size_bytes();
    std::span<std::byte> to = memory.map(visible_slot, sizeof header + index_bytes);
    std::memcpy(to.data(), &header, sizeof header);
    if (index_bytes > 0) std::memcpy(to.data() + sizeof header, lights_.lights().data(), index_bytes);

    counters_ = {};
    counters_.in_frustum = lights_.in_frustum();
    counters_.overflow_lights = lights_.in_frustum() - header.count;
    counters_.list_bytes = to.size();
  }

  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {"Visible"}; }
  bool walks_together() const override { return together_; }
  LongestWalk longest_walk(const FrameInput&) const override { return {longest_walk_, 0}; }
  ShadeShaders shade_shaders() const override {
    return {fine_pruned_shade, fine_pruned_shade_counting, fine_pruned_forward, fine_pruned_forward_counting};
  }
  gpu::Constants shade_constants() const override { return {{"PACKED", settings_.packed}}; }

  std::unique_ptr<DeviceAlgorithm> device_half(const DeviceContext& context) override;

  // Asked by the device half.
  const PruneSettings& settings() const { return settings_; }
  const VisibleLightList& lights() const { return lights_; }
  uint64_t entries() const { return entries_; }

 private:
  PruneSettings settings_;
  bool together_;
  VisibleLightList lights_;
  uint64_t entries_ = 0, longest_walk_ = 0;
  PrepareCounters counters_;
};

// Builds the lists; shading is the harness's.
class PrunedLists final : public DeviceAlgorithm {
 public:
  PrunedLists(const FinePruned& algorithm, const DeviceContext& context)
      : algorithm_(algorithm),
        settings_(with_probes(algorithm.settings(), context.has("EFFECT_PROBES"))),
        passes_(context.device, context.shared, settings_) {}

  void build(gpu::Commands& commands, const FrameInput& frame, FrameResources& resources) override {
    passes_.record(commands, frame.view, resources.bindings(), algorithm_.lights().header().count,
                   algorithm_.entries());
    gpu::Bindings made;
    passes_.bindings(made);
    for (const gpu::Binding& binding : made) resources.publish(binding.name, *binding.buffer);
  }
  void read_counters(gpu::Commands& commands, PrepareCounters& counters, CounterValues&) override {
    const ListPasses::Counts sums = passes_.read(commands);
    const VisibleLightList& lights = algorithm_.lights();
    const uint64_t cut = lights.in_frustum() - lights.header().count;
    const double tiles = sums.tiles ? static_cast<double>(sums.tiles) : 1;
    counters.coarse_lights = static_cast<double>(sums.coarse) / tiles;
    counters.fine_lights = static_cast<double>(sums.listed) / tiles;
    counters.overflow_tiles = sums.overflow_tiles;
    counters.overflow_lights = cut + sums.overflow_lights;
    counters.list_bytes =
        sizeof(gpu_data::VisibleHeader) + lights.lights().size_bytes() +
        (settings_.packed ? sums.tiles * settings_.packed_words() * 4 : sums.tiles * 8 + sums.listed * 4);
  }
  // The tile's list as the pass that made it counted it.
  std::optional<uint32_t> lights_listed(glm::uvec2 pixel) const override { return passes_.listed(pixel); }
  uint64_t bytes() const override {
    gpu::Bindings made;
    passes_.bindings(made);
    uint64_t sum = 0;
    for (const gpu::Binding& binding : made) sum += binding.buffer->bytes();
    return sum;
  }

 private:
  static PruneSettings with_probes(PruneSettings settings, bool probes) {
    settings.probes = probes;
    return settings;
  }

  const FinePruned& algorithm_;
  PruneSettings settings_;
  ListPasses passes_;
};

std::unique_ptr<DeviceAlgorithm> FinePruned::device_half(const DeviceContext& context) {
  return std::make_unique<PrunedLists>(*this, context);
}

// Measured on the museum and the citadel; of 8192 to 65,536 lights of canyon and citadel 29 % and 50 % were
// in view.
double list_seconds(const Parameters& p, uint32_t width, uint32_t height, uint32_t lights) {
  constexpr double in_view = 0.38, tile = 5e-6, tile_light = 15e-9, pruned_tile = 7e-6;
  constexpr double region_tiles = 64, in_region = 0.08;  // of the lights in view
  const auto along = [](uint32_t pixels) { return (pixels + ML_PRUNED_TILE - 1) / ML_PRUNED_TILE; };
  const double tiles = static_cast<double>(along(width)) * along(height);
  // The chapter's lists need no counting of what they will hold.
  const bool packed = p.choice("caps") == "paper";
  const double visible = packed ? std::min<double>(in_view * lights, ML_PACKED_VISIBLE) : in_view * lights;
  const bool regions = visible > static_cast<double>(p.integer("region_lights"));
  const double candidates = regions ? in_region * visible : visible;
  const double coarse = (tile + candidates * tile_light) * (packed ? 0.5 : 1);
  return (regions ? tiles / region_tiles * visible * tile_light : 0) +
         tiles * (coarse + (p.choice("prune") == "coarse" ? 0 : pruned_tile));
}

}  // namespace

AlgorithmEntry fine_pruned_entry() {
  AlgorithmEntry entry;
  entry.info.name = "fine_pruned";
  entry.info.summary = "tile lists built on the GPU, pruned by true volumes against every pixel";
  entry.info.paper = "Mikkelsen, Fine Pruned Tiled Light Lists, GPU Pro 7, 2016";
  entry.info.cpu_stages = {"cull", "sort", "upload"};
  entry.info.passes = {{"bounds"}, {"regions"}, {"coarse"}, {"lists"}};
  entry.parameters = {
      ParameterInfo::choice("prune", "fine", {"fine", "coarse", "facing"},
                            "lists by true volumes against pixels (section 2.4), by screen bounds alone, or "
                            "by true volumes and the way surfaces face"),
      ParameterInfo::choice("bounds", "hull", {"hull", "box", "ball"},
                            "screen bounds of a light's narrowed hull and its smallest ball, of a straight "
                            "box and that ball, or of the ball alone (sections 2.2 and 2.4)"),
      ParameterInfo::boolean("tile_depths", true,
                             "coarse lists by the least and greatest depth of a tile too, or by its "
                             "rectangle alone (section 2.3)"),
      ParameterInfo::choice("caps", "exact", {"exact", "paper"},
                            "lists of any length, or 64 coarse and 24 pruned lights a tile, 1024 in view, "
                            "loss reported (section 2.5)"),
      ParameterInfo::integer(
          "region_lights", 1024, 0, 1048576,
          "with more lights in view than this, squares of 8x8 tiles list theirs first, and "
          "their tiles look at no others"),
      walk_parameter(),
  };
  entry.create = [](const Parameters& parameters) { return std::make_unique<FinePruned>(parameters); };
  entry.further_seconds = list_seconds;
  return entry;
}

}  // namespace ml
