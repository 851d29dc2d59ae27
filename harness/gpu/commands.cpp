#include "harness/gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/check.h"
#include "harness/gpu/commands_impl.h"
#include "harness/gpu/format_features.h"

namespace ml::gpu {
namespace {

bool same(const Bindings& a, const Bindings& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Binding& x, const Binding& y) {
    return x.name == y.name && x.buffer == y.buffer && x.image == y.image && x.level == y.level &&
           x.sampling == y.sampling;
  });
}

}  // namespace

vk::DescriptorSet Commands::Impl::bind(const Layout& layout, const Bindings& bindings,
                                       const std::string& program) {
  std::vector<vk::WriteDescriptorSet> writes;
  std::vector<vk::DescriptorBufferInfo> buffers;
  std::vector<vk::DescriptorImageInfo> images;
  std::vector<vk::BufferView> texels;
  buffers.reserve(layout.slots.size());
  texels.reserve(layout.slots.size());
  images.reserve(layout.slots.size());
  vk::DescriptorSet set = sets.allocate(device, *layout.set_layout);
  for (const auto& entry : layout.slots) {
    const std::string& name = entry.second.resource;
    const BindingSlot& slot = entry.second;
    auto found =
        std::find_if(bindings.begin(), bindings.end(), [&](const Binding& b) { return b.name == name; });
    if (found == bindings.end())
      throw std::logic_error(fmt::format("{}: nothing is bound to '{}'", program, name));
    vk::WriteDescriptorSet write(set, slot.binding, 0, 1, slot.type);
    if (slot.type == vk::DescriptorType::eStorageBuffer || slot.type == vk::DescriptorType::eUniformBuffer) {
      if (!found->buffer) throw std::logic_error(fmt::format("{}: '{}' is a buffer", program, name));
      write.pBufferInfo = &buffers.emplace_back(*found->buffer->impl().buffer, 0, VK_WHOLE_SIZE);
    } else if (slot.type == vk::DescriptorType::eUniformTexelBuffer) {
      if (!found->buffer) throw std::logic_error(fmt::format("{}: '{}' is a buffer", program, name));
      if (found->buffer->bytes() < quad_bytes)
        throw std::logic_error(fmt::format("{}: '{}' has no four words", program, name));
      write.pTexelBufferView = &texels.emplace_back(*found->buffer->impl().quads);
    } else {
      if (!found->image) throw std::logic_error(fmt::format("{}: '{}' is an image", program, name));
      write.pImageInfo = &images.emplace_back(bind_image(*found, slot.type, program));
    }
    writes.push_back(write);
  }
  device.device.updateDescriptorSets(writes, {});
  return set;
}

vk::DescriptorImageInfo Commands::Impl::bind_image(const Binding& binding, vk::DescriptorType type,
                                                   const std::string& program) {
  const Image& image = *binding.image;
  if (binding.level && *binding.level >= image.levels())
    throw std::logic_error(fmt::format("{}: level {} of '{}', which has {}", program, *binding.level,
                                       binding.name, image.levels()));
  to_general(image);
  Image::Impl& impl = image.impl();
  vk::DescriptorImageInfo info(impl.sampler, *impl.view, vk::ImageLayout::eGeneral);
  // Shaders store to one level.
  if (binding.level || type == vk::DescriptorType::eStorageImage)
    info.imageView = impl.level_view(device, binding.level.value_or(0));
  if (binding.sampling) {
    if (const char* what = lacking(impl.features, *binding.sampling))
      throw SystemError(fmt::format("{}: '{}' of format {} lacks {}", program, binding.name,
                                    in_words(image.format()), what));
    info.sampler = device.samplers.get(device.device, *binding.sampling, image.levels());
  }
  return info;
}

void Commands::Impl::push(const Layout& layout, std::span<const std::byte> bytes,
                          const std::string& program) {
  // A shader that uses none of its push constants declares fewer than are given.
  if (bytes.size() < layout.push_bytes)
    throw std::logic_error(
        fmt::format("{}: {} bytes of push constants, {} given", program, layout.push_bytes, bytes.size()));
  if (layout.push_bytes)
    device.device.getDispatcher()->vkCmdPushConstants(
        static_cast<VkCommandBuffer>(*now()), static_cast<VkPipelineLayout>(*layout.pipeline_layout),
        static_cast<VkShaderStageFlags>(layout.push_stages), 0, layout.push_bytes, bytes.data());
}

void Commands::Impl::prepare_dispatch(const ComputeProgram& program, const Bindings& bindings,
                                      std::span<const std::byte> bytes) {
  const Layout& layout = program.impl().layout;
  vk::DescriptorSet set = bind(layout, bindings, program.name());
  now().bindPipeline(vk::PipelineBindPoint::eCompute, *program.impl().pipeline);
  now().bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline_layout, 0, set, {});
  push(layout, bytes, program.name());
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
  c.prepare_dispatch(program, bindings, push);
  c.now().dispatch(groups_x, groups_y, groups_z);
  c.pass_done();
}

void Commands::dispatch_indirect(const ComputeProgram& program, const Bindings& bindings,
                                 std::span<const std::byte> push, const Buffer& groups, size_t offset) {
  Impl& c = *impl_;
  constexpr size_t counts_bytes = 3 * sizeof(uint32_t);
  ML_CHECK(groups.impl().kind != MemoryKind::readback);
  ML_CHECK_EQ(offset % 4, 0);
  ML_CHECK_GE(groups.bytes(), counts_bytes);
  ML_CHECK_LE(offset, groups.bytes() - counts_bytes);
  c.prepare_dispatch(program, bindings, push);
  c.now().dispatchIndirect(*groups.impl().buffer, offset);
  c.pass_done();
}

void Commands::raster(const RasterTargets& targets, const Buffer& vertices, const Buffer& indices,
                      std::span<const DrawCall> draws) {
  Impl& c = *impl_;
  if (c.part == Part::second) throw std::logic_error("the second queue may know no graphics");
  auto attachment = [&](const Image& image) {
    c.to_general(image);
    return vk::RenderingAttachmentInfo(
        image.impl().level_view(c.device, 0), vk::ImageLayout::eGeneral, vk::ResolveModeFlagBits::eNone, {},
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
  c.now().beginRendering(vk::RenderingInfo({}, vk::Rect2D({}, extent), 1, 0, colors, &depth));
  c.now().setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1));
  c.now().setScissor(0, vk::Rect2D({}, extent));
  c.now().bindVertexBuffers(0, *vertices.impl().buffer, vk::DeviceSize{0});
  c.now().bindIndexBuffer(*indices.impl().buffer, 0, vk::IndexType::eUint32);
  for (size_t i = 0; i < draws.size(); ++i) {
    const RasterProgram& program = *draws[i].program;
    const Layout& layout = program.impl().layout;
    c.now().bindPipeline(vk::PipelineBindPoint::eGraphics, *program.impl().pipeline);
    c.now().bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout.pipeline_layout, 0, sets[i], {});
    c.now().setFrontFace(draws[i].mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
    c.now().setCullMode(draws[i].double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    c.push(layout, draws[i].push, program.name());
    c.now().drawIndexed(draws[i].index_count, 1, draws[i].first_index, 0, 0);
  }
  c.now().endRendering();
  c.pass_done();
}

void Commands::clear(const Image& image) {
  Impl& c = *impl_;
  c.to_layout(image, vk::ImageLayout::eTransferDstOptimal);
  const vk::ImageSubresourceRange all(image.impl().aspect, 0, image.levels(), 0, 1);
  const auto layout = vk::ImageLayout::eTransferDstOptimal;
  if (is_depth(image.format()))
    c.now().clearDepthStencilImage(*image.impl().image, layout, vk::ClearDepthStencilValue{}, all);
  else
    c.now().clearColorImage(*image.impl().image, layout, vk::ClearColorValue{}, all);
  c.pass_done();
}

void Commands::fill(const Buffer& buffer, uint32_t word) {
  impl_->now().fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, word);
  impl_->pass_done();
}

void Commands::transfer(const UploadBuffer& buffer) {
  if (!buffer.has_device_copy() || buffer.used() == 0) return;
  impl_->now().copyBuffer(*buffer.host().impl().buffer, *buffer.shader().impl().buffer,
                          vk::BufferCopy(0, 0, buffer.used()));
  impl_->pass_done();
}

void Commands::read_image(const Image& image, const Buffer& into, uint32_t level) {
  Impl& c = *impl_;
  ML_CHECK_LT(level, image.levels());
  ML_CHECK_GE(into.bytes(), image.bytes(level));
  c.to_layout(image, vk::ImageLayout::eTransferSrcOptimal);
  vk::BufferImageCopy region(0, 0, 0, {image.impl().aspect, level, 0, 1}, {},
                             {image.width(level), image.height(level), 1});
  c.now().copyImageToBuffer(*image.impl().image, vk::ImageLayout::eTransferSrcOptimal, *into.impl().buffer,
                            region);
  c.pass_done();
}

void Commands::write_image(const Buffer& from, const Image& image) {
  Impl& c = *impl_;
  ML_CHECK_GE(from.bytes(), image.bytes());
  c.to_layout(image, vk::ImageLayout::eTransferDstOptimal);
  std::vector<vk::BufferImageCopy> regions;
  vk::DeviceSize offset = 0;
  for (uint32_t level = 0; level < image.levels(); ++level) {
    const uint32_t width = image.width(level), height = image.height(level);
    regions.emplace_back(offset, 0, 0, vk::ImageSubresourceLayers(image.impl().aspect, level, 0, 1),
                         vk::Offset3D(), vk::Extent3D(width, height, 1));
    offset += image.bytes(level);
  }
  c.now().copyBufferToImage(*from.impl().buffer, *image.impl().image, vk::ImageLayout::eTransferDstOptimal,
                            regions);
  c.pass_done();
}

void Commands::read_buffer(const Buffer& buffer, size_t bytes, const Buffer& into) {
  ML_CHECK_LE(bytes, buffer.bytes());
  ML_CHECK_LE(bytes, into.bytes());
  if (bytes == 0) return;
  impl_->now().copyBuffer(*buffer.impl().buffer, *into.impl().buffer, vk::BufferCopy(0, 0, bytes));
  impl_->pass_done();
}

}  // namespace ml::gpu
