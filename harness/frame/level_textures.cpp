#include "harness/frame/level_textures.h"

#include <cstring>

#include "harness/frame/texture_levels.h"

namespace ml {
namespace {

gpu::Sampling::Edge edge_of(Wrap wrap) {
  switch (wrap) {
    case Wrap::mirrored_repeat:
      return gpu::Sampling::Edge::mirrored_repeat;
    case Wrap::clamp_to_edge:
      return gpu::Sampling::Edge::clamp;
    default:
      return gpu::Sampling::Edge::repeat;
  }
}

gpu::Sampling sampling_of(const Texture& texture) {
  const Sampler& sampler = texture.sampler;
  gpu::Sampling sampling;
  sampling.magnify_linear = sampler.magnify == Filter::linear;
  sampling.minify_linear = sampler.minify == Filter::linear;
  sampling.levels_linear = sampler.mip == MipFilter::linear;
  sampling.u = edge_of(sampler.u);
  sampling.v = edge_of(sampler.v);
  return sampling;
}

gpu::Image uploaded(gpu::Device& device, gpu::Commands& commands, const Texture& texture, bool srgb) {
  const bool mipped = texture.sampler.mip != MipFilter::none;
  gpu::Image image(device,
                   {.width = texture.width,
                    .height = texture.height,
                    .format = srgb ? gpu::Format::rgba8_srgb : gpu::Format::rgba8_unorm,
                    .use = gpu::ImageUse::texture,
                    .levels = mipped ? gpu::all_levels : 1,
                    .sampling = sampling_of(texture)},
                   "texture " + texture.name);
  const std::vector<uint8_t> levels = image.levels() > 1 ? with_levels(texture, srgb) : texture.rgba;
  gpu::Buffer staging(device, levels.size(), gpu::MemoryKind::upload, "texture staging");
  std::memcpy(staging.mapped().data(), levels.data(), levels.size());
  commands.begin(gpu::Timing::none);
  commands.write_image(staging, image);
  commands.submit();
  return image;
}

}  // namespace

const gpu::Image& LevelTextures::get(gpu::Device& device, gpu::Commands& commands, const Scene& scene,
                                     int texture, Use use) {
  // White is white either way.
  const std::tuple key(texture, texture < 0 ? Use::color : use);
  auto found = images_.find(key);
  if (found == images_.end()) {
    static const Texture white{"white", 1, 1, {255, 255, 255, 255}};
    const Texture& source = texture < 0 ? white : scene.textures[static_cast<size_t>(texture)];
    found = images_.emplace(key, uploaded(device, commands, source, std::get<Use>(key) == Use::color)).first;
  }
  return found->second;
}

}  // namespace ml
