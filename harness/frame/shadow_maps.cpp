#include "harness/frame/shadow_maps.h"

#include <cstring>

#include "harness/frame/shadow_views.h"

namespace ml {

ShadowMaps::ShadowMaps(gpu::Device& device, uint32_t count, uint32_t size) : size_(size) {
  for (uint32_t i = 0; i < count; ++i) {
    maps_.emplace_back(device, size, size, gpu::Format::d32_float, gpu::ImageUse::attachment, "shadow map");
    views_.emplace_back(device, sizeof(gpu_data::ViewData), gpu::MemoryKind::upload, "shadow map's view");
  }
}

void ShadowMaps::load(const FrameInput& input) {
  const std::vector<gpu_data::ViewData> views =
      shadow_views(input, static_cast<uint32_t>(views_.size()), size_);
  for (size_t i = 0; i < views.size(); ++i)
    std::memcpy(views_[i].mapped().data(), &views[i], sizeof views[i]);
}

void ShadowMaps::record(gpu::Commands& commands, const Level& level) const {
  auto span = commands.span("shadow_maps");
  auto apart = commands.unordered();
  for (size_t i = 0; i < maps_.size(); ++i) level.record_depth(commands, views_[i], maps_[i]);
}

uint64_t ShadowMaps::bytes() const {
  uint64_t sum = 0;
  for (const gpu::Image& map : maps_) sum += map.bytes();
  return sum;
}

}  // namespace ml
