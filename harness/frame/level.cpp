#include "harness/frame/level.h"

#include <algorithm>
#include <cstring>

#include "harness/base/error.h"
#include "shaders/shared/material.h"
#include "spirv/gbuffer_forward_frag.h"
#include "spirv/gbuffer_frag.h"
#include "spirv/gbuffer_vert.h"
#include "spirv/shadow_masked_frag.h"
#include "spirv/shadow_masked_vert.h"
#include "spirv/shadow_vert.h"

namespace ml {
namespace {

template <typename Element>
gpu::Buffer filled(gpu::Device& device, const std::vector<Element>& elements, const char* name) {
  gpu::Buffer buffer(device, elements.size() * sizeof(Element), gpu::MemoryKind::upload, name);
  std::memcpy(buffer.mapped().data(), elements.data(), buffer.bytes());
  return buffer;
}

gpu::Image uploaded(gpu::Device& device, gpu::Commands& commands, const Texture& texture) {
  gpu::Image image(device, texture.width, texture.height, gpu::Format::rgba8_srgb, gpu::ImageUse::texture,
                   "texture " + texture.name);
  gpu::Buffer staging = filled(device, texture.rgba, "texture staging");
  commands.begin(gpu::Timing::none);
  commands.write_image(staging, image);
  commands.submit();
  return image;
}

gpu::RasterState vertex_state() {
  gpu::RasterState state;
  state.vertex_stride = sizeof(Vertex);
  state.attributes = {
      {offsetof(Vertex, position), 3}, {offsetof(Vertex, normal), 3}, {offsetof(Vertex, uv), 2}};
  return state;
}

std::unique_ptr<gpu::RasterProgram> gbuffer_program(gpu::Device& device, bool masked, bool forward,
                                                    bool clip_far) {
  gpu::RasterState state = vertex_state();
  state.colors = {gpu::Format::rg32_uint};
  if (forward) state.colors.push_back(gpu::Format::r32_uint);
  return std::make_unique<gpu::RasterProgram>(
      device, gbuffer_vert,
      forward ? std::span<const uint32_t>(gbuffer_forward_frag) : std::span<const uint32_t>(gbuffer_frag),
      masked ? "gbuffer (alpha mask)" : "gbuffer", state,
      std::vector<gpu::Constant>{{0, masked}, {1, clip_far}});
}

// Opaque triangles need no fragment shader, and of a vertex its position alone.
std::unique_ptr<gpu::RasterProgram> depth_program(gpu::Device& device, bool masked) {
  gpu::RasterState state;
  state.vertex_stride = sizeof(Vertex);
  state.attributes = {{offsetof(Vertex, position), 3}};
  if (!masked)
    return std::make_unique<gpu::RasterProgram>(device, shadow_vert, std::span<const uint32_t>{},
                                                "shadow map", state);
  state.attributes.push_back({offsetof(Vertex, uv), 2});
  return std::make_unique<gpu::RasterProgram>(device, shadow_masked_vert, shadow_masked_frag,
                                              "shadow map (alpha mask)", state);
}

}  // namespace

bool Level::has_masked_material(const Scene& scene) {
  return std::any_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& draw) {
    return scene.materials[draw.material].alpha_mode == AlphaMode::mask;
  });
}

bool Level::has_forward_material(const Scene& scene) {
  return std::any_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& draw) {
    return draw.index_count > 0 && scene.materials[draw.material].forward;
  });
}

Level::Level(gpu::Device& device, const Scene& scene, bool alpha_mask, bool forward, bool shadows,
             bool clip_far)
    : vertices_(filled(device, scene.vertices, "vertices")),
      indices_(filled(device, scene.indices, "indices")) {
  if (forward && !device.limits().fragment_triangles)
    throw SystemError("forward materials: '" + device.info().name +
                      "' does not number triangles in fragment shaders (geometryShader); "
                      "effects.forward=off lights them deferred");
  gpu::Commands commands(device);
  for (const Texture& texture : scene.textures) textures_.push_back(uploaded(device, commands, texture));
  textures_.push_back(uploaded(device, commands, Texture{"white", 1, 1, {255, 255, 255, 255}}));
  for (const Draw& draw : scene.draws) {
    const Material& material = scene.materials[draw.material];
    DrawItem item{draw.first_index,
                  draw.index_count,
                  material.double_sided,
                  alpha_mask && material.alpha_mode == AlphaMode::mask,
                  forward && material.forward,
                  material.base_color_texture < 0 ? textures_.size() - 1
                                                  : static_cast<size_t>(material.base_color_texture),
                  {}};
    gpu_data::MaterialData data{material.base_color,   material.metallic,
                                material.roughness,    material.alpha_cutoff,
                                material.double_sided, item.forward ? 1 + draw.first_index / 3 : 0};
    item.push.resize(sizeof data);
    std::memcpy(item.push.data(), &data, sizeof data);
    items_.push_back(std::move(item));
  }
  bool any_masked =
      std::any_of(items_.begin(), items_.end(), [](const DrawItem& item) { return item.masked; });
  opaque_ = gbuffer_program(device, false, forward, clip_far);
  if (any_masked) masked_ = gbuffer_program(device, true, forward, clip_far);
  if (!shadows) return;
  depth_opaque_ = depth_program(device, false);
  if (any_masked) depth_masked_ = depth_program(device, true);
}

gpu::DrawCall Level::call_of(const DrawItem& item, const gpu::RasterProgram& program) {
  gpu::DrawCall call;
  call.first_index = item.first_index;
  call.index_count = item.index_count;
  call.double_sided = item.double_sided;
  call.program = &program;
  call.push = item.push;
  return call;
}

void Level::record_gbuffer(gpu::Commands& commands, const gpu::Buffer& view,
                           const FrameTargets& targets) const {
  std::vector<gpu::DrawCall> draws;
  draws.reserve(items_.size());
  for (const DrawItem& item : items_) {
    gpu::DrawCall call = call_of(item, item.masked ? *masked_ : *opaque_);
    call.bindings = {{"View", view}, {"BaseColor", textures_[item.texture]}};
    draws.push_back(std::move(call));
  }
  gpu::RasterTargets into{{&targets.surface}, &targets.depth};
  if (targets.forward) into.colors.push_back(&*targets.forward);
  commands.raster(into, vertices_, indices_, draws);
}

void Level::record_depth(gpu::Commands& commands, const gpu::Buffer& view, const gpu::Image& depth) const {
  std::vector<gpu::DrawCall> draws;
  draws.reserve(items_.size());
  for (const DrawItem& item : items_) {
    gpu::DrawCall call = call_of(item, item.masked ? *depth_masked_ : *depth_opaque_);
    call.bindings = {{"View", view}};
    if (item.masked) call.bindings.emplace_back("BaseColor", textures_[item.texture]);
    draws.push_back(std::move(call));
  }
  commands.raster({{}, &depth}, vertices_, indices_, draws);
}

gpu::RasterProgram Level::forward_program(gpu::Device& device, std::span<const uint32_t> fragment,
                                          const std::string& name,
                                          const std::vector<gpu::Constant>& constants) {
  gpu::RasterState state = vertex_state();
  state.colors = {gpu::Format::rgba32_float};
  state.at_equal_depth = true;
  return {device, gbuffer_vert, fragment, name, state, constants};
}

void Level::record_forward(gpu::Commands& commands, const gpu::RasterProgram& program,
                           const gpu::Bindings& bindings, const FrameTargets& targets) const {
  std::vector<gpu::DrawCall> draws;
  for (const DrawItem& item : items_) {
    if (!item.forward) continue;
    gpu::DrawCall call = call_of(item, program);
    call.bindings = bindings;
    call.bindings.emplace_back("BaseColor", textures_[item.texture]);
    draws.push_back(std::move(call));
  }
  commands.raster({{&targets.result}, &targets.depth, true}, vertices_, indices_, draws);
}

}  // namespace ml
