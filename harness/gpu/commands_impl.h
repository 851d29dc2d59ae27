// Private to this room: what Commands records into. commands.cpp has the passes, submission.cpp what happens
// to them.
#pragma once

#include "harness/gpu/descriptor_sets.h"
#include "harness/gpu/submission_times.h"

namespace ml::gpu {

struct Commands::Impl {
  explicit Impl(Device& device);

  // The command buffer of the part at hand.
  vk::raii::CommandBuffer& now() { return parts[static_cast<size_t>(part)]; }
  vk::raii::CommandBuffer& of(Part which) { return parts[static_cast<size_t>(which)]; }

  void barrier(vk::PipelineStageFlags2 after = vk::PipelineStageFlagBits2::eAllCommands,
               vk::AccessFlags2 access = vk::AccessFlagBits2::eMemoryRead |
                                         vk::AccessFlagBits2::eMemoryWrite);
  // The barrier after a pass.
  void pass_done() {
    if (!unordered) barrier();
  }
  void stamp();
  bool timed() const {
    return timing != Timing::none && device.limits.timestamp_valid_bits != 0 &&
           (part != Part::second || device.limits.second_timestamp_valid_bits != 0);
  }

  bool stamps_spans() const { return timing == Timing::stages && timed(); }

  // Shaders and attachments use GENERAL, copies the layouts made for them.
  void to_layout(const Image& image, vk::ImageLayout layout);
  void to_general(const Image& image) { to_layout(image, vk::ImageLayout::eGeneral); }
  // To the second queue, when it first uses the image; and all of them back to the main one.
  void hand_over(const Image& image);
  void hand_back();

  // A descriptor set with everything that the program uses.
  vk::DescriptorSet bind(const Layout& layout, const Bindings& bindings, const std::string& program);
  vk::DescriptorImageInfo bind_image(const Binding& binding, vk::DescriptorType type,
                                     const std::string& program);
  // All of a dispatch but the dispatch.
  void prepare_dispatch(const ComputeProgram& program, const Bindings& bindings,
                        std::span<const std::byte> push);
  void push(const Layout& layout, std::span<const std::byte> bytes, const std::string& program);

  void create_fork();
  void submit_parts();

  Device::Impl& device;
  vk::raii::CommandPool pool;
  vk::raii::CommandPool second_pool = nullptr;  // with the first fork, as the parts but `before`
  std::array<vk::raii::CommandBuffer, 4> parts{nullptr, nullptr, nullptr, nullptr};
  // Signalled after `before`, waited for by `second`; signalled after `second`, waited for by `after`.
  vk::raii::Semaphore forked_off = nullptr, joined = nullptr;
  vk::raii::Fence fence;
  vk::raii::QueryPool stamps = nullptr;
  DescriptorSets sets;
  Timing timing = Timing::none;
  bool recording = false, forked = false, unordered = false;
  Part part = Part::before;
  std::vector<Part> stamp_parts;  // of each stamp so far
  std::vector<StampedSpan> spans;
  std::vector<size_t> open_spans;  // of those stamped, the outermost first
  uint32_t span_depth = 0;         // of all, stamped or not
  std::vector<const Image*> handed_over;
};

}  // namespace ml::gpu
