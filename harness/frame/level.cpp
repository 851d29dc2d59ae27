#include "harness/frame/level.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "harness/base/error.h"
#include "harness/frame/vertex_details.h"
#include "shaders/shared/material.h"
#include "spirv/gbuffer_detailed_forward_frag.h"
#include "spirv/gbuffer_detailed_frag.h"
#include "spirv/gbuffer_detailed_moving_vert.h"
#include "spirv/gbuffer_detailed_vert.h"
#include "spirv/gbuffer_emission_forward_frag.h"
#include "spirv/gbuffer_emission_frag.h"
#include "spirv/gbuffer_forward_frag.h"
#include "spirv/gbuffer_frag.h"
#include "spirv/gbuffer_moving_vert.h"
#include "spirv/gbuffer_vert.h"
#include "spirv/shadow_masked_detailed_frag.h"
#include "spirv/shadow_masked_detailed_moving_vert.h"
#include "spirv/shadow_masked_detailed_vert.h"
#include "spirv/shadow_masked_frag.h"
#include "spirv/shadow_masked_moving_vert.h"
#include "spirv/shadow_masked_vert.h"
#include "spirv/shadow_moving_vert.h"
#include "spirv/shadow_vert.h"

namespace ml {
namespace {

// In memory that the device reads fast; the way there leads through memory that the CPU can write.
template <typename Element>
gpu::Buffer filled(gpu::Device& device, gpu::Commands& commands, const std::vector<Element>& elements,
                   const char* name) {
  gpu::Buffer staging(device, elements.size() * sizeof(Element), gpu::MemoryKind::upload, name);
  std::memcpy(staging.mapped().data(), elements.data(), staging.bytes());
  if (staging.device_local()) return staging;
  gpu::Buffer buffer(device, staging.bytes(), gpu::MemoryKind::device, name);
  commands.begin(gpu::Timing::none);
  commands.read_buffer(staging, staging.bytes(), buffer);
  commands.submit();
  return buffer;
}

gpu::RasterState vertex_state() {
  gpu::RasterState state;
  state.vertex_stride = sizeof(Vertex);
  state.attributes = {
      {offsetof(Vertex, position), 3}, {offsetof(Vertex, normal), 3}, {offsetof(Vertex, uv), 2}};
  return state;
}

// Levels with more than base colours need programs that read more of a vertex and of a material.
bool is_detailed(const FrameOptions& options) {
  return options.effects.material_detail || options.effects.emission;
}

using Module = std::span<const uint32_t>;

Module gbuffer_vertex(const FrameOptions& options) {
  if (is_detailed(options))
    return options.effects.motion ? Module(gbuffer_detailed_moving_vert) : Module(gbuffer_detailed_vert);
  return options.effects.motion ? Module(gbuffer_moving_vert) : Module(gbuffer_vert);
}

std::span<const uint32_t> gbuffer_fragment(const FrameOptions& options) {
  if (options.effects.emission)
    return options.effects.forward ? std::span<const uint32_t>(gbuffer_emission_forward_frag)
                                   : std::span<const uint32_t>(gbuffer_emission_frag);
  if (options.effects.material_detail)
    return options.effects.forward ? std::span<const uint32_t>(gbuffer_detailed_forward_frag)
                                   : std::span<const uint32_t>(gbuffer_detailed_frag);
  return options.effects.forward ? std::span<const uint32_t>(gbuffer_forward_frag)
                                 : std::span<const uint32_t>(gbuffer_frag);
}

std::unique_ptr<gpu::RasterProgram> gbuffer_program(gpu::Device& device, bool masked,
                                                    const FrameOptions& options) {
  gpu::RasterState state = vertex_state();
  state.colors = {gpu::Format::rg32_uint};
  if (options.effects.forward) state.colors.push_back(gpu::Format::r32_uint);
  if (options.effects.emission) state.colors.push_back(gpu::Format::rgba32_float);
  return std::make_unique<gpu::RasterProgram>(
      device, gbuffer_vertex(options), gbuffer_fragment(options), masked ? "gbuffer (alpha mask)" : "gbuffer",
      state, gpu::Constants{{"EFFECT_ALPHA_MASK", masked}, {"EFFECT_CLIP_FAR", options.effects.clip_far}});
}

// Opaque triangles need no fragment shader, and of a vertex its position alone.
std::unique_ptr<gpu::RasterProgram> depth_program(gpu::Device& device, bool masked,
                                                  const FrameOptions& options) {
  gpu::RasterState state;
  state.vertex_stride = sizeof(Vertex);
  state.attributes = {{offsetof(Vertex, position), 3}};
  const bool moving = options.effects.motion;
  if (!masked)
    return std::make_unique<gpu::RasterProgram>(device, moving ? Module(shadow_moving_vert) : shadow_vert,
                                                Module{}, "shadow map", state);
  state.attributes.push_back({offsetof(Vertex, uv), 2});
  const std::string name = "shadow map (alpha mask)";
  if (is_detailed(options))
    return std::make_unique<gpu::RasterProgram>(
        device, moving ? Module(shadow_masked_detailed_moving_vert) : shadow_masked_detailed_vert,
        shadow_masked_detailed_frag, name, state);
  return std::make_unique<gpu::RasterProgram>(device,
                                              moving ? Module(shadow_masked_moving_vert) : shadow_masked_vert,
                                              shadow_masked_frag, name, state);
}

gpu_data::MaterialData material_data(const Material& material, const FrameOptions& options,
                                     uint32_t details_layout) {
  gpu_data::MaterialData data{};
  data.base_color = material.base_color;
  data.metallic = material.metallic;
  data.roughness = material.roughness;
  data.alpha_cutoff = material.alpha_cutoff;
  data.double_sided = material.double_sided;
  data.details = details_layout;
  if (options.effects.material_detail) {
    data.details |= ML_DETAIL_MATERIAL_BIT;
    if (has_normal_map(material)) data.details |= ML_DETAIL_NORMAL_BIT;
  }
  data.normal_scale = material.normal_scale;
  data.emission = material.emission;
  return data;
}

}  // namespace

Level::Level(gpu::Device& device, const Scene& scene, const FrameOptions& options)
    : commands_(device),
      vertices_(filled(device, commands_, scene.vertices, "vertices")),
      indices_(filled(device, commands_, scene.indices, "indices")) {
  if (options.effects.forward && !device.limits().fragment_triangles)
    throw SystemError("forward materials: '" + device.info().name +
                      "' does not number triangles in fragment shaders (geometryShader); "
                      "effects.forward=off lights them deferred");
  uint32_t layout = 0;
  if (is_detailed(options)) {
    PackedDetails packed = packed_details(scene.details, scene.vertices.size());
    layout = packed.layout;
    details_.emplace(filled(device, commands_, packed.words, "details of vertices"));
  }
  using Use = LevelTextures::Use;
  auto texture = [&](bool wanted, int index, Use use) {
    return &textures_.get(device, commands_, scene, wanted ? index : -1, use);
  };
  for (const Draw& draw : scene.draws) {
    const Material& material = scene.materials[draw.material];
    DrawItem item{draw.first_index,
                  draw.index_count,
                  material.double_sided,
                  options.effects.alpha_mask && material.alpha_mode == AlphaMode::mask,
                  options.effects.forward && material.forward,
                  texture(true, material.base_color_texture, Use::color),
                  texture(options.effects.material_detail, material.metallic_roughness_texture, Use::data),
                  texture(options.effects.material_detail, material.normal_texture, Use::data),
                  texture(options.effects.emission, material.emission_texture, Use::color),
                  {}};
    gpu_data::MaterialData data = material_data(material, options, layout);
    data.forward_triangle = item.forward ? 1 + draw.first_index / 3 : 0;
    item.push.resize(sizeof data + (options.effects.motion ? sizeof(gpu_data::MotionData) : 0));
    std::memcpy(item.push.data(), &data, sizeof data);
    if (options.effects.motion) {
      if (draw.motion >= 0) item.motion = scene.draw_motions[static_cast<size_t>(draw.motion)];
      set_pose(item, DrawPose());
    }
    items_.push_back(std::move(item));
  }
  if (options.effects.motion) {
    motions_ = scene.motions;
    motion_center_ = scene.motion_center;
    move_to(motions_->begin());
  }
  bool any_masked =
      std::any_of(items_.begin(), items_.end(), [](const DrawItem& item) { return item.masked; });
  opaque_ = gbuffer_program(device, false, options);
  if (any_masked) masked_ = gbuffer_program(device, true, options);
  if (!options.shading.shadow_maps) return;
  depth_opaque_ = depth_program(device, false, options);
  if (any_masked) depth_masked_ = depth_program(device, true, options);
}

void Level::set_pose(DrawItem& item, const DrawPose& pose) {
  const gpu_data::MotionData data{pose.linear, pose.pivot, pose.moved_pivot};
  std::memcpy(item.push.data() + sizeof(gpu_data::MaterialData), &data, sizeof data);
  item.seen = pose.seen;
  item.mirrored = pose.mirrored;
}

void Level::move_to(double time) {
  if (!motions_) return;
  for (DrawItem& item : items_)
    if (item.motion) set_pose(item, pose_of(*motions_, motion_center_, *item.motion, time));
}

gpu::DrawCall Level::call_of(const DrawItem& item, const gpu::RasterProgram& program) const {
  gpu::DrawCall call;
  call.first_index = item.first_index;
  call.index_count = item.index_count;
  call.double_sided = item.double_sided;
  call.mirrored = item.mirrored;
  call.program = &program;
  call.push = item.push;
  call.bindings = {{"BaseColor", *item.base_color},
                   {"MetallicRoughness", *item.metallic_roughness},
                   {"NormalMap", *item.normal_map},
                   {"EmissionMap", *item.emission_map}};
  if (details_) call.bindings.emplace_back("Details", *details_);
  return call;
}

void Level::record_gbuffer(gpu::Commands& commands, const gpu::Buffer& view,
                           const FrameTargets& targets) const {
  std::vector<gpu::DrawCall> draws;
  draws.reserve(items_.size());
  for (const DrawItem& item : items_) {
    if (!item.seen) continue;
    gpu::DrawCall call = call_of(item, item.masked ? *masked_ : *opaque_);
    call.bindings.emplace_back("View", view);
    draws.push_back(std::move(call));
  }
  gpu::RasterTargets into{{&targets.surface}, &targets.depth};
  if (targets.forward) into.colors.push_back(&*targets.forward);
  if (targets.emission) into.colors.push_back(&*targets.emission);
  commands.raster(into, vertices_, indices_, draws);
}

void Level::record_depth(gpu::Commands& commands, const gpu::Buffer& view, const gpu::Image& depth) const {
  std::vector<gpu::DrawCall> draws;
  draws.reserve(items_.size());
  for (const DrawItem& item : items_) {
    if (!item.seen) continue;
    gpu::DrawCall call = call_of(item, item.masked ? *depth_masked_ : *depth_opaque_);
    call.bindings.emplace_back("View", view);
    draws.push_back(std::move(call));
  }
  commands.raster({{}, &depth}, vertices_, indices_, draws);
}

gpu::RasterProgram Level::forward_program(gpu::Device& device, std::span<const uint32_t> fragment,
                                          const std::string& name, const FrameOptions& options,
                                          const gpu::Constants& constants) {
  gpu::RasterState state = vertex_state();
  state.colors = {gpu::Format::rgba32_float};
  state.at_equal_depth = true;
  return {device, gbuffer_vertex(options), fragment, name, state, constants};
}

void Level::record_forward(gpu::Commands& commands, const gpu::RasterProgram& program,
                           const gpu::Bindings& bindings, const FrameTargets& targets) const {
  std::vector<gpu::DrawCall> draws;
  for (const DrawItem& item : items_) {
    if (!item.forward || !item.seen) continue;
    gpu::DrawCall call = call_of(item, program);
    call.bindings.insert(call.bindings.end(), bindings.begin(), bindings.end());
    draws.push_back(std::move(call));
  }
  commands.raster({{&targets.result}, &targets.depth, true}, vertices_, indices_, draws);
}

}  // namespace ml
