#include "harness/frame/device_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "harness/base/error.h"
#include "harness/frame/shading_loops.h"
#include "shaders/shared/contributing.h"
#include "shaders/shared/pixel_groups.h"
#include "spirv/aov_comp.h"
#include "spirv/contributing_bounds.h"
#include "spirv/contributing_count.h"
#include "spirv/contributing_fill.h"
#include "spirv/contributing_masks.h"

namespace ml {
namespace {

uint32_t groups(uint32_t items, uint32_t per_group) {
  return (items + per_group - 1) / per_group;
}

template <typename Element>
void upload(gpu::UploadBuffer& buffer, std::span<const Element> elements) {
  std::span<std::byte> memory = buffer.map(elements.size_bytes());
  if (!elements.empty()) std::memcpy(memory.data(), elements.data(), elements.size_bytes());
}

}  // namespace

struct DeviceFrame::ContributingPasses {
  gpu::ComputeProgram bounds, masks, count, fill;
  gpu::Image count_image, hash_image;
  std::unique_ptr<gpu::Buffer> block_bounds, mask_words;
  gpu::UploadBuffer offsets;
  std::unique_ptr<gpu::Buffer> indices;
  gpu::UploadBuffer group_offsets, group_indices;
  std::unique_ptr<gpu::Buffer> read_indices, write_indices;

  ContributingPasses(gpu::Device& device, const FrameOptions& options, uint32_t width, uint32_t height)
      : bounds(device, contributing_bounds, "contributing: bounds", options.constants(device)),
        masks(device, contributing_masks, "contributing: masks", options.constants(device)),
        count(device, contributing_count, "contributing: count", options.constants(device)),
        fill(device, contributing_fill, "contributing: fill", options.constants(device)),
        count_image(device, width, height, gpu::Format::r32_uint, gpu::ImageUse::storage,
                    "contributing counts"),
        hash_image(device, width, height, gpu::Format::r32_uint, gpu::ImageUse::storage,
                   "contributing hashes"),
        offsets(device, "offsets of the contributing lists"),
        group_offsets(device, "offsets of the groups' contributing lists"),
        group_indices(device, "the groups' contributing lists") {
    offsets.map(16);
    group_offsets.map(16);
    group_indices.map(16);
    indices = std::make_unique<gpu::Buffer>(device, 16, gpu::MemoryKind::device, "contributing lists");
  }

  // Grows, never shrinks.
  static void reserve(gpu::Device& device, std::unique_ptr<gpu::Buffer>& buffer, size_t bytes,
                      const char* name, gpu::MemoryKind kind = gpu::MemoryKind::device) {
    if (!buffer || buffer->bytes() < bytes)
      buffer = std::make_unique<gpu::Buffer>(device, std::max<size_t>(bytes, 16), kind, name);
  }
};

DeviceFrame::DeviceFrame(gpu::Device& device, const Scene& scene, const FrameOptions& options, uint32_t width,
                         uint32_t height)
    : device_(device),
      options_(options),
      level_(device, scene, options),
      targets_(device, width, height, options.effects.forward, options.shading.split_targets,
               options.effects.emission),
      commands_(device),
      view_(device, sizeof(gpu_data::ViewData), gpu::MemoryKind::upload, "view"),
      lights_(device, "lights"),
      extras_(device, "light extras"),
      occupied_blocks_(device, width, height),
      passes_(std::make_unique<ContributingPasses>(device, options, width, height)) {
  if (options.shading.shadow_maps)
    shadow_maps_ =
        std::make_unique<ShadowMaps>(device, options.shading.shadow_maps, options.shading.shadow_map_size);
}

DeviceFrame::~DeviceFrame() = default;

void DeviceFrame::load(const FrameInput& input) {
  if (options_.fetches_texels(device_))
    require_texels(device_.limits(), fmt::format("{} lights", input.lights.count()),
                   std::max(input.lights.core.size_bytes(), input.lights.extra.size_bytes()));
  std::memcpy(view_.mapped().data(), &input.view, sizeof input.view);
  upload(lights_, input.lights.core);
  upload(extras_, input.lights.extra);
  if (shadow_maps_) shadow_maps_->load(input);
  level_.move_to(input.time);
  commands_.begin(gpu::Timing::none);
  commands_.transfer(lights_);
  commands_.transfer(extras_);
  level_.record_gbuffer(commands_, view_, targets_);
  clear_results();
  occupied_blocks_.record(commands_, bindings());
  commands_.submit();
  occupied_blocks_.read();
  if (!occupied_blocks_.list().has_device_copy()) return;
  commands_.begin(gpu::Timing::none);
  commands_.transfer(occupied_blocks_.list());
  commands_.submit();
}

void DeviceFrame::clear_results() {
  commands_.clear(targets_.result);
  if (targets_.diffuse) commands_.clear(*targets_.diffuse);
  if (targets_.specular) commands_.clear(*targets_.specular);
}

const CounterTargets& DeviceFrame::counters() {
  if (!counters_) counters_ = std::make_unique<CounterTargets>(device_, targets_.width(), targets_.height());
  return *counters_;
}

void DeviceFrame::clear_counters() {
  for (const auto& [name, image] : counters_->named()) commands_.clear(*image);
}

gpu::Bindings DeviceFrame::bindings() const {
  gpu::Bindings list{{"View", view_},
                     {"Depth", targets_.depth},
                     {"Surface", targets_.surface},
                     {"Lights", lights_},
                     {"Extras", extras_},
                     {"Result", targets_.result},
                     // Not read where nothing is lit forward.
                     {"Forward", targets_.forward ? *targets_.forward : targets_.surface},
                     // Not read where no surface gives light by itself.
                     {"Emission", targets_.emission ? *targets_.emission : targets_.depth},
                     // Not written where there is one target.
                     {"Specular", targets_.specular ? *targets_.specular : targets_.result},
                     {"ListOffsets", passes_->offsets},
                     {"ListIndices", *passes_->indices},
                     {"GroupOffsets", passes_->group_offsets},
                     {"GroupIndices", passes_->group_indices}};
  if (counters_)
    for (const auto& [name, image] : counters_->named()) list.emplace_back(name, *image);
  return list;
}

uint64_t DeviceFrame::target_bytes() const {
  uint64_t sum = targets_.depth.bytes() + targets_.surface.bytes() + targets_.result.bytes();
  for (const std::optional<gpu::Image>* image :
       {&targets_.forward, &targets_.diffuse, &targets_.specular, &targets_.emission})
    if (*image) sum += (*image)->bytes();
  return sum;
}

const ContributingLights& DeviceFrame::find_contributing(const FrameInput& input, LightLists lists) {
  ContributingPasses& p = *passes_;
  contributing_.group.clear();
  uint32_t width = targets_.width(), height = targets_.height();
  gpu_data::ContributingPush push{{groups(width, ML_BLOCK), groups(height, ML_BLOCK)},
                                  groups(static_cast<uint32_t>(input.lights.count()), 32),
                                  0,
                                  0};
  uint32_t groups_across = groups(push.blocks.x, ML_GROUP), groups_down = groups(push.blocks.y, ML_GROUP);
  p.reserve(device_, p.block_bounds, size_t{push.blocks.x} * push.blocks.y * sizeof(gpu_data::BlockBounds),
            "block bounds");
  p.reserve(device_, p.mask_words, size_t{groups_across} * groups_down * push.mask_words * 4,
            "light masks of the block groups");
  auto with_lists = [&] {
    gpu::Bindings list = bindings();
    list.emplace_back("Bounds", *p.block_bounds);
    list.emplace_back("Masks", *p.mask_words);
    list.emplace_back("Offsets", p.offsets);
    list.emplace_back("Indices", *p.indices);
    // The counting lap of an algorithm has counters of the same names; these are the reference's own.
    std::erase_if(list, [](const gpu::Binding& b) { return b.name == "Contributing" || b.name == "Hash"; });
    list.emplace_back("Contributing", p.count_image);
    list.emplace_back("Hash", p.hash_image);
    return list;
  };
  // A range of lights after the other; at least one, which writes zeros where there are no lights.
  auto every_range = [&](const gpu::ComputeProgram& program, const gpu::Bindings& bindings) {
    do {
      push.end_word = std::min(push.mask_words, push.first_word + max_lights_of_dispatch / 32);
      commands_.dispatch(program, bindings, push, push.blocks.x, push.blocks.y);
      push.first_word = push.end_word;
    } while (push.first_word < push.mask_words);
    push.first_word = 0;
  };
  gpu::Bindings list = with_lists();
  commands_.begin(gpu::Timing::none);
  commands_.dispatch(p.bounds, list, push, push.blocks.x, push.blocks.y);
  commands_.dispatch(p.masks, list, push, groups_across, groups_down);
  every_range(p.count, list);
  commands_.submit();
  contributing_.count = read_words(p.count_image);
  contributing_.hash = read_words(p.hash_image);
  if (lists == LightLists::none) return contributing_;

  size_t pixels = contributing_.count.size();
  std::vector<uint32_t> offsets(pixels + 1);
  uint64_t total = 0;
  for (size_t i = 0; i < pixels; ++i) {
    offsets[i] = static_cast<uint32_t>(total);
    total += contributing_.count[i];
  }
  offsets[pixels] = static_cast<uint32_t>(total);
  upload(p.offsets, std::span<const uint32_t>(offsets));
  if (total * 4 > device_.limits().storage_buffer_range)
    throw SystemError(fmt::format(
        "the lists of contributing lights need {} bytes at {}x{} px; one storage buffer of '{}' holds {}",
        total * 4, width, height, device_.info().name, device_.limits().storage_buffer_range));
  p.reserve(device_, p.indices, total * 4, "contributing lists");
  list = with_lists();
  commands_.begin(gpu::Timing::none);
  commands_.transfer(p.offsets);
  every_range(p.fill, list);
  commands_.submit();
  if (lists == LightLists::groups) merge_groups(offsets);
  return contributing_;
}

std::span<const uint32_t> DeviceFrame::read_lists(size_t lights) {
  ContributingPasses& p = *passes_;
  const size_t bytes = lights * sizeof(uint32_t);
  p.reserve(device_, p.read_indices, bytes, "contributing lists, read back", gpu::MemoryKind::readback);
  if (bytes > 0) {
    commands_.begin(gpu::Timing::none);
    commands_.read_buffer(*p.indices, bytes, *p.read_indices);
    commands_.submit();
  }
  return {reinterpret_cast<const uint32_t*>(p.read_indices->mapped().data()), lights};
}

SavedContributing DeviceFrame::save_contributing(LightLists lists) {
  const auto words = [](const gpu::UploadBuffer& buffer) {
    const std::span<const std::byte> bytes = buffer.host().mapped().first(buffer.used());
    std::vector<uint32_t> copy(bytes.size() / sizeof(uint32_t));
    std::memcpy(copy.data(), bytes.data(), copy.size() * sizeof(uint32_t));
    return copy;
  };
  SavedContributing saved{contributing_.count, words(passes_->offsets), {}, {}, {}};
  const std::span<const uint32_t> of_pixels = read_lists(saved.offsets.back());
  saved.indices.assign(of_pixels.begin(), of_pixels.end());
  if (lists != LightLists::groups) return saved;
  saved.group_offsets = words(passes_->group_offsets);
  saved.group_indices = words(passes_->group_indices);
  return saved;
}

void DeviceFrame::restore_contributing(const SavedContributing& saved) {
  ContributingPasses& p = *passes_;
  contributing_ = {saved.count, {}, {}};
  upload(p.offsets, std::span(saved.offsets));
  const size_t bytes = saved.indices.size() * sizeof(uint32_t);
  p.reserve(device_, p.indices, bytes, "contributing lists");
  commands_.begin(gpu::Timing::none);
  commands_.transfer(p.offsets);
  if (bytes > 0) {
    p.reserve(device_, p.write_indices, bytes, "contributing lists, to be uploaded", gpu::MemoryKind::upload);
    std::memcpy(p.write_indices->mapped().data(), saved.indices.data(), bytes);
    commands_.read_buffer(*p.write_indices, bytes, *p.indices);
  }
  if (!saved.group_offsets.empty()) {
    upload(p.group_offsets, std::span(saved.group_offsets));
    upload(p.group_indices, std::span(saved.group_indices));
    commands_.transfer(p.group_offsets);
    commands_.transfer(p.group_indices);
  }
  commands_.submit();
}

// On the CPU: nothing of it is timed, and lists may be of any length.
void DeviceFrame::merge_groups(std::span<const uint32_t> offsets) {
  ContributingPasses& p = *passes_;
  const uint32_t width = targets_.width(), height = targets_.height(), blocks = groups(width, ML_BLOCK);
  const uint32_t pixels = gpu_data::group_pixels(device_.limits().subgroup_size);
  const uint32_t count = blocks * groups(height, ML_BLOCK) * (ML_BLOCK * ML_BLOCK / pixels);
  const size_t bytes = size_t{offsets.back()} * 4;
  const uint32_t* of_pixels = read_lists(offsets.back()).data();
  auto ends =
      std::span(reinterpret_cast<uint32_t*>(p.group_offsets.map((count + size_t{1}) * 4).data()), count + 1);
  // No longer than those of pixels.
  auto* merged = reinterpret_cast<uint32_t*>(p.group_indices.map(bytes).data());
  contributing_.group.assign(contributing_.count.size(), 0);
  std::vector<uint32_t> lights;
  std::vector<size_t> members;
  uint32_t written = 0;
  for (uint32_t group = 0; group < count; ++group) {
    ends[group] = written;
    lights.clear();
    members.clear();
    for (uint32_t i = 0; i < pixels; ++i) {
      const uint32_t thread = group * pixels + i, block = thread / (ML_BLOCK * ML_BLOCK);
      const glm::uvec2 pixel = glm::uvec2(block % blocks, block / blocks) * ML_BLOCK +
                               gpu_data::pixel_in_block(thread % (ML_BLOCK * ML_BLOCK));
      if (pixel.x >= width || pixel.y >= height) continue;
      const size_t index = size_t{pixel.y} * width + pixel.x;
      members.push_back(index);
      lights.insert(lights.end(), of_pixels + offsets[index], of_pixels + offsets[index + 1]);
    }
    std::ranges::sort(lights);
    lights.erase(std::unique(lights.begin(), lights.end()), lights.end());
    std::ranges::copy(lights, merged + written);
    written += static_cast<uint32_t>(lights.size());
    for (size_t index : members) contributing_.group[index] = static_cast<uint32_t>(lights.size());
  }
  ends[count] = written;
  commands_.begin(gpu::Timing::none);
  commands_.transfer(p.group_offsets);
  commands_.transfer(p.group_indices);
  commands_.submit();
}

void DeviceFrame::read_image(const gpu::Image& image) {
  if (!readback_ || readback_->bytes() < image.bytes())
    readback_ = std::make_unique<gpu::Buffer>(device_, image.bytes(), gpu::MemoryKind::readback, "readback");
  commands_.begin(gpu::Timing::none);
  commands_.read_image(image, *readback_);
  commands_.submit();
}

std::vector<uint32_t> DeviceFrame::read_words(const gpu::Image& image) {
  read_image(image);
  std::vector<uint32_t> words(image.bytes() / 4);
  std::memcpy(words.data(), readback_->mapped().data(), image.bytes());
  return words;
}

std::vector<float> DeviceFrame::read_floats(const gpu::Image& image) {
  read_image(image);
  std::vector<float> floats(image.bytes() / 4);
  std::memcpy(floats.data(), readback_->mapped().data(), image.bytes());
  return floats;
}

std::vector<float> DeviceFrame::read_aov(Aov kind) {
  gpu::ComputeProgram program(device_, aov_comp, "aov", {{"KIND", static_cast<uint32_t>(kind)}});
  commands_.begin(gpu::Timing::none);
  commands_.dispatch(program, bindings(), std::span<const std::byte>{}, groups(targets_.width(), 8),
                     groups(targets_.height(), 8));
  commands_.submit();
  std::vector<float> floats = read_floats(targets_.result);
  commands_.begin(gpu::Timing::none);
  clear_results();
  commands_.submit();
  return floats;
}

}  // namespace ml
