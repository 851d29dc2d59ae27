#include "harness/gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>

#include "harness/gpu/vulkan.h"

namespace ml::gpu {
namespace {

constexpr uint32_t max_stamps = 256;

// Descriptor sets of one submission: pools are added as needed and all reset together.
class DescriptorSets {
 public:
  vk::DescriptorSet allocate(Device::Impl& device, vk::DescriptorSetLayout layout) {
    for (;; ++current_) {
      if (current_ == pools_.size()) pools_.push_back(make_pool(device));
      vk::DescriptorSetAllocateInfo info(*pools_[current_], layout);
      VkDescriptorSet set = VK_NULL_HANDLE;
      auto plain = static_cast<VkDescriptorSetAllocateInfo>(info);
      VkResult result = device.device.getDispatcher()->vkAllocateDescriptorSets(
          static_cast<VkDevice>(*device.device), &plain, &set);
      if (result == VK_SUCCESS) return set;
      if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL)
        throw SystemError("the device has no memory for descriptors");
    }
  }
  void reset() {
    for (vk::raii::DescriptorPool& pool : pools_) pool.reset();
    current_ = 0;
  }

 private:
  static vk::raii::DescriptorPool make_pool(Device::Impl& device) {
    constexpr uint32_t sets = 256;
    using Type = vk::DescriptorType;
    std::array sizes{vk::DescriptorPoolSize(Type::eStorageBuffer, sets * 8),
                     vk::DescriptorPoolSize(Type::eUniformBuffer, sets * 2),
                     vk::DescriptorPoolSize(Type::eStorageImage, sets * 8),
                     vk::DescriptorPoolSize(Type::eCombinedImageSampler, sets * 4)};
    return {device.device, vk::DescriptorPoolCreateInfo({}, sets, sizes)};
  }
  std::vector<vk::raii::DescriptorPool> pools_;
  size_t current_ = 0;
};

bool same(const Bindings& a, const Bindings& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Binding& x, const Binding& y) {
    return x.name == y.name && x.buffer == y.buffer && x.image == y.image;
  });
}

}  // namespace

struct Commands::Impl {
  Device& owner;
  Device::Impl& device;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer buffer = nullptr;
  vk::raii::Fence fence;
  vk::raii::QueryPool stamps = nullptr;
  DescriptorSets sets;
  Timing timing = Timing::none;
  bool recording = false;
  uint32_t stamp_count = 0;
  // Name of the span between stamps 2i and 2i+1; index 0 is the whole submission in mode `whole`.
  std::vector<std::string> span_names;

  explicit Impl(Device& d)
      : owner(d),
        device(d.impl()),
        pool(device.device,
             vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, device.queue_family)),
        fence(device.device, vk::FenceCreateInfo()) {
    vk::CommandBufferAllocateInfo info(*pool, vk::CommandBufferLevel::ePrimary, 1);
    buffer = std::move(vk::raii::CommandBuffers(device.device, info).front());
    if (device.limits.timestamp_valid_bits)
      stamps = vk::raii::QueryPool(device.device,
                                   vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, max_stamps));
  }

  void barrier(vk::PipelineStageFlags2 after = vk::PipelineStageFlagBits2::eAllCommands,
               vk::AccessFlags2 access = vk::AccessFlagBits2::eMemoryRead |
                                         vk::AccessFlagBits2::eMemoryWrite) {
    vk::MemoryBarrier2 all(vk::PipelineStageFlagBits2::eAllCommands,
                           vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, after,
                           access);
    buffer.pipelineBarrier2(vk::DependencyInfo({}, all));
  }

  // Full barrier, stamp, full barrier: the one order that is right on the software driver after raster
  // passes, and that keeps a span's work inside it everywhere else.
  void stamp() {
    assert(stamp_count < max_stamps);
    barrier();
    buffer.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps, stamp_count++);
    barrier();
  }

  bool timed() const { return timing != Timing::none && device.limits.timestamp_valid_bits != 0; }

  // Shaders and attachments use GENERAL, copies the layouts made for them.
  void to_layout(const Image& image, vk::ImageLayout layout) {
    if (image.impl().layout == layout) return;
    vk::AccessFlags2 all = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    vk::ImageMemoryBarrier2 change(vk::PipelineStageFlagBits2::eAllCommands, all,
                                   vk::PipelineStageFlagBits2::eAllCommands, all, image.impl().layout, layout,
                                   VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image.impl().image,
                                   {image.impl().aspect, 0, 1, 0, 1});
    buffer.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, change));
    image.impl().layout = layout;
  }
  void to_general(const Image& image) { to_layout(image, vk::ImageLayout::eGeneral); }

  // A descriptor set with everything that the program uses.
  vk::DescriptorSet bind(const Layout& layout, const Bindings& bindings, const std::string& program) {
    std::vector<vk::WriteDescriptorSet> writes;
    std::vector<vk::DescriptorBufferInfo> buffers;
    std::vector<vk::DescriptorImageInfo> images;
    buffers.reserve(layout.slots.size());
    images.reserve(layout.slots.size());
    vk::DescriptorSet set = sets.allocate(device, *layout.set_layout);
    for (const auto& entry : layout.slots) {
      const std::string& name = entry.first;
      const BindingSlot& slot = entry.second;
      auto found =
          std::find_if(bindings.begin(), bindings.end(), [&](const Binding& b) { return b.name == name; });
      if (found == bindings.end())
        throw std::logic_error(fmt::format("{}: nothing is bound to '{}'", program, name));
      vk::WriteDescriptorSet write(set, slot.binding, 0, 1, slot.type);
      if (slot.type == vk::DescriptorType::eStorageBuffer ||
          slot.type == vk::DescriptorType::eUniformBuffer) {
        if (!found->buffer) throw std::logic_error(fmt::format("{}: '{}' is a buffer", program, name));
        write.pBufferInfo = &buffers.emplace_back(*found->buffer->impl().buffer, 0, VK_WHOLE_SIZE);
      } else {
        if (!found->image) throw std::logic_error(fmt::format("{}: '{}' is an image", program, name));
        to_general(*found->image);
        const Image::Impl& image = found->image->impl();
        write.pImageInfo = &images.emplace_back(*image.sampler, *image.view, vk::ImageLayout::eGeneral);
      }
      writes.push_back(write);
    }
    device.device.updateDescriptorSets(writes, {});
    return set;
  }

  void push(const Layout& layout, std::span<const std::byte> bytes, const std::string& program) const {
    // A shader that uses none of its push constants declares fewer than are given.
    if (bytes.size() < layout.push_bytes)
      throw std::logic_error(
          fmt::format("{}: {} bytes of push constants, {} given", program, layout.push_bytes, bytes.size()));
    if (layout.push_bytes)
      device.device.getDispatcher()->vkCmdPushConstants(
          static_cast<VkCommandBuffer>(*buffer), static_cast<VkPipelineLayout>(*layout.pipeline_layout),
          static_cast<VkShaderStageFlags>(layout.push_stages), 0, layout.push_bytes, bytes.data());
  }
};

Commands::Commands(Device& device) : impl_(std::make_unique<Impl>(device)) {}
Commands::~Commands() = default;

void Commands::begin(Timing timing) {
  Impl& c = *impl_;
  assert(!c.recording);
  c.pool.reset();
  c.sets.reset();
  c.timing = timing;
  c.stamp_count = 0;
  c.span_names.clear();
  c.buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  c.recording = true;
  if (c.timed()) {
    c.buffer.resetQueryPool(*c.stamps, 0, max_stamps);
    c.stamp();
  }
}

SubmissionTimes Commands::submit() {
  Impl& c = *impl_;
  assert(c.recording);
  if (c.timed()) c.stamp();
  c.barrier(vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
  c.buffer.end();
  c.recording = false;
  SubmissionTimes times;
  try {
    vk::CommandBufferSubmitInfo command_info(*c.buffer);
    auto begin = std::chrono::steady_clock::now();
    c.device.queue.submit2(vk::SubmitInfo2({}, {}, command_info), *c.fence);
    // A frame of a software device can take minutes; a hang is for the user to stop.
    if (c.device.device.waitForFences(*c.fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
      throw SystemError("the device did not finish");
    times.fence = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    c.device.device.resetFences(*c.fence);
    if (!c.timed()) return times;
    const std::vector<uint64_t> values =
        c.stamps
            .getResults<uint64_t>(0, c.stamp_count, c.stamp_count * sizeof(uint64_t), sizeof(uint64_t),
                                  vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
            .second;
    uint32_t bits = c.device.limits.timestamp_valid_bits;
    uint64_t mask = bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1;
    auto between = [&](size_t from, size_t to) {
      // Masked before and after: a counter of fewer bits may wrap between two stamps.
      uint64_t ticks = ((values[to] & mask) - (values[from] & mask)) & mask;
      return static_cast<double>(ticks) * c.device.limits.timestamp_period_ns * 1e-6;
    };
    times.whole = between(0, c.stamp_count - 1);
    for (size_t i = 0; i < c.span_names.size(); ++i) {
      double span = between(1 + 2 * i, 2 + 2 * i);
      auto found = std::find_if(times.spans.begin(), times.spans.end(),
                                [&](const auto& s) { return s.first == c.span_names[i]; });
      if (found == times.spans.end())
        times.spans.emplace_back(c.span_names[i], span);
      else
        found->second += span;
    }
  } catch (const vk::Error& error) {
    throw SystemError(std::string("the device failed: ") + error.what());
  }
  return times;
}

void Commands::dispatch(const ComputeProgram& program, const Bindings& bindings,
                        std::span<const std::byte> push, uint32_t groups_x, uint32_t groups_y,
                        uint32_t groups_z) {
  Impl& c = *impl_;
  const auto& limit = c.device.limits.group_count;
  if (groups_x > limit[0] || groups_y > limit[1] || groups_z > limit[2])
    throw SystemError(fmt::format("{}: {}x{}x{} workgroups, the device allows {}x{}x{}", program.name(),
                                  groups_x, groups_y, groups_z, limit[0], limit[1], limit[2]));
  if (groups_x == 0 || groups_y == 0 || groups_z == 0) return;
  const Layout& layout = program.impl().layout;
  vk::DescriptorSet set = c.bind(layout, bindings, program.name());
  c.buffer.bindPipeline(vk::PipelineBindPoint::eCompute, *program.impl().pipeline);
  c.buffer.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline_layout, 0, set, {});
  c.push(layout, push, program.name());
  c.buffer.dispatch(groups_x, groups_y, groups_z);
  c.barrier();
}

void Commands::raster(const RasterTargets& targets, const Buffer& vertices, const Buffer& indices,
                      std::span<const DrawCall> draws) {
  Impl& c = *impl_;
  auto attachment = [&](const Image& image) {
    c.to_general(image);
    return vk::RenderingAttachmentInfo(
        *image.impl().view, vk::ImageLayout::eGeneral, vk::ResolveModeFlagBits::eNone, {},
        vk::ImageLayout::eUndefined,
        targets.keep ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
        vk::AttachmentStoreOp::eStore, vk::ClearValue{});
  };
  std::vector<vk::RenderingAttachmentInfo> colors;
  for (const Image* color : targets.colors) colors.push_back(attachment(*color));
  vk::RenderingAttachmentInfo depth = attachment(*targets.depth);
  vk::Extent2D extent(targets.depth->width(), targets.depth->height());
  // Sets are bound and images brought to their layout before rendering begins: barriers are not allowed
  // inside.
  std::vector<vk::DescriptorSet> sets;
  for (size_t i = 0; i < draws.size(); ++i) {
    bool reuse =
        i > 0 && draws[i].program == draws[i - 1].program && same(draws[i].bindings, draws[i - 1].bindings);
    sets.push_back(
        reuse ? sets.back()
              : c.bind(draws[i].program->impl().layout, draws[i].bindings, draws[i].program->name()));
  }
  c.buffer.beginRendering(vk::RenderingInfo({}, vk::Rect2D({}, extent), 1, 0, colors, &depth));
  c.buffer.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1));
  c.buffer.setScissor(0, vk::Rect2D({}, extent));
  c.buffer.bindVertexBuffers(0, *vertices.impl().buffer, vk::DeviceSize{0});
  c.buffer.bindIndexBuffer(*indices.impl().buffer, 0, vk::IndexType::eUint32);
  for (size_t i = 0; i < draws.size(); ++i) {
    const RasterProgram& program = *draws[i].program;
    const Layout& layout = program.impl().layout;
    c.buffer.bindPipeline(vk::PipelineBindPoint::eGraphics, *program.impl().pipeline);
    c.buffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout.pipeline_layout, 0, sets[i], {});
    c.buffer.setCullMode(draws[i].double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    c.push(layout, draws[i].push, program.name());
    c.buffer.drawIndexed(draws[i].index_count, 1, draws[i].first_index, 0, 0);
  }
  c.buffer.endRendering();
  c.barrier();
}

void Commands::clear(const Image& image) {
  Impl& c = *impl_;
  c.to_layout(image, vk::ImageLayout::eTransferDstOptimal);
  c.buffer.clearColorImage(*image.impl().image, vk::ImageLayout::eTransferDstOptimal, vk::ClearColorValue{},
                           {{image.impl().aspect, 0, 1, 0, 1}});
  c.barrier();
}

void Commands::fill(const Buffer& buffer, uint32_t word) {
  impl_->buffer.fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, word);
  impl_->barrier();
}

void Commands::transfer(const UploadBuffer& buffer) {
  if (!buffer.has_twin() || buffer.used() == 0) return;
  impl_->buffer.copyBuffer(*buffer.host().impl().buffer, *buffer.shader().impl().buffer,
                           vk::BufferCopy(0, 0, buffer.used()));
  impl_->barrier();
}

void Commands::read_image(const Image& image, const Buffer& into) {
  Impl& c = *impl_;
  assert(into.bytes() >= image.bytes());
  c.to_layout(image, vk::ImageLayout::eTransferSrcOptimal);
  vk::BufferImageCopy region(0, 0, 0, {image.impl().aspect, 0, 0, 1}, {}, {image.width(), image.height(), 1});
  c.buffer.copyImageToBuffer(*image.impl().image, vk::ImageLayout::eTransferSrcOptimal, *into.impl().buffer,
                             region);
  c.barrier();
}

void Commands::write_image(const Buffer& from, const Image& image) {
  Impl& c = *impl_;
  assert(from.bytes() >= image.bytes());
  c.to_layout(image, vk::ImageLayout::eTransferDstOptimal);
  vk::BufferImageCopy region(0, 0, 0, {image.impl().aspect, 0, 0, 1}, {}, {image.width(), image.height(), 1});
  c.buffer.copyBufferToImage(*from.impl().buffer, *image.impl().image, vk::ImageLayout::eTransferDstOptimal,
                             region);
  c.barrier();
}

void Commands::read_buffer(const Buffer& buffer, size_t bytes, const Buffer& into) {
  assert(bytes <= buffer.bytes() && bytes <= into.bytes());
  if (bytes == 0) return;
  impl_->buffer.copyBuffer(*buffer.impl().buffer, *into.impl().buffer, vk::BufferCopy(0, 0, bytes));
  impl_->barrier();
}

Commands::Span Commands::span(std::string_view name) {
  Impl& c = *impl_;
  if (c.timed() && c.timing == Timing::stages) {
    c.span_names.emplace_back(name);
    c.stamp();
  }
  return Span(*this);
}

void Commands::end_span() {
  Impl& c = *impl_;
  if (c.timed() && c.timing == Timing::stages) c.stamp();
}

}  // namespace ml::gpu
