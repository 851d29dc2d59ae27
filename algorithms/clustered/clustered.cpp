#include "algorithms/clustered/clustered.h"

#include <cstring>

#include "algorithms/froxels/froxel_lists.h"
#include "algorithms/froxels/froxel_parameters.h"
#include "spirv/clustered_forward.h"
#include "spirv/clustered_forward_counting.h"
#include "spirv/clustered_shade.h"
#include "spirv/clustered_shade_counting.h"

namespace ml {
namespace {

enum Slot : uint32_t { grid_slot, offsets_slot, indices_slot, duplicates_slot };

template <typename Element>
void copy(std::span<const Element> from, std::span<std::byte> to) {
  if (!from.empty()) std::memcpy(to.data(), from.data(), from.size_bytes());
}

class Clustered final : public Algorithm {
 public:
  explicit Clustered(const Parameters& p)
      : duplicated_(p.choice("light_data") == "duplicated"),
        settings_(froxel_settings(p)),
        together_(walk_together(p)) {}

  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans) override {
    if (duplicated_)
      lists_.build(frame, settings_, memory.limit() / sizeof(gpu_data::LightCore), spans);
    else
      lists_.build(frame, settings_, memory, indices_slot, spans);
    auto span = spans.span("upload");
    const gpu_data::FroxelGridData header = lists_.grid_data();
    copy(std::span(&header, 1), memory.map(grid_slot, sizeof header));
    copy(lists_.offsets(), memory.map(offsets_slot, lists_.offsets().size_bytes()));
    std::span<const uint32_t> indices = lists_.entries();
    if (duplicated_) {
      auto* lights = reinterpret_cast<gpu_data::LightCore*>(
          memory.map(duplicates_slot, indices.size() * sizeof(gpu_data::LightCore)).data());
      for (size_t i = 0; i < indices.size(); ++i) lights[i] = frame.lights.core[indices[i]];
      memory.map(indices_slot, 0);
    } else {
      lists_.upload_entries(memory, indices_slot);
      memory.map(duplicates_slot, 0);
    }
    counters_.in_frustum = lists_.lights_in_frustum();
    counters_.list_bytes =
        lists_.offsets().size_bytes() +
        (duplicated_ ? indices.size() * sizeof(gpu_data::LightCore) : lists_.entry_bytes());
  }

  PrepareCounters counters() const override { return counters_; }
  std::vector<std::string> buffers() const override { return {"Grid", "Offsets", "Indices", "Duplicates"}; }
  bool walks_together() const override { return together_; }
  LongestWalk longest_walk(const FrameInput&) const override { return {lists_.longest(), 0}; }
  ShadeShaders shade_shaders() const override {
    return {clustered_shade, clustered_shade_counting, clustered_forward, clustered_forward_counting};
  }
  gpu::Constants shade_constants() const override {
    return {{"DUPLICATED", duplicated_}, {"NARROW_INDICES", settings_.narrow}};
  }
  std::optional<uint32_t> lights_listed(glm::uvec2 pixel, float depth) const override {
    return lists_.lights_at(pixel, depth);
  }

 private:
  bool duplicated_;
  FroxelSettings settings_;
  bool together_;
  FroxelLists lists_{"clustered"};
  PrepareCounters counters_;
};

}  // namespace

AlgorithmEntry clustered_entry() {
  AlgorithmEntry entry;
  entry.info.name = "clustered";
  entry.info.summary = "froxel lists, binned on the CPU";
  entry.info.paper = "Persson, Practical Clustered Shading, SIGGRAPH 2013";
  entry.info.cpu_stages = {"cull", "bin", "upload"};
  entry.parameters = froxel_parameters();
  entry.parameters.push_back(ParameterInfo::choice(
      "light_data", "indexed", {"indexed", "duplicated"},
      "lists hold light indices, or copies of the light data (Tiled Light Trees, fig. 5)"));
  entry.parameters.push_back(walk_parameter());
  entry.check = [](const Parameters& p, uint32_t width, uint32_t height) -> std::string {
    if (p.choice("light_data") == "duplicated" && p.choice("index_bits") == "16")
      return "index_bits 16 needs light_data indexed: duplicated lists hold no indices";
    return froxel_check(p, width, height);
  };
  entry.create = [](const Parameters& parameters) { return std::make_unique<Clustered>(parameters); };
  return entry;
}

}  // namespace ml
