#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "harness/base/check.h"
#include "harness/gpu/commands_impl.h"
#include "harness/gpu/debug_names.h"

namespace ml::gpu {
namespace {

constexpr uint32_t max_stamps = 256;
constexpr auto all_stages = vk::PipelineStageFlagBits2::eAllCommands;
constexpr auto all_access = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;

vk::raii::CommandBuffer allocated(Device::Impl& device, const vk::raii::CommandPool& pool) {
  const vk::CommandBufferAllocateInfo info(*pool, vk::CommandBufferLevel::ePrimary, 1);
  return std::move(vk::raii::CommandBuffers(device.device, info).front());
}

vk::raii::CommandPool pool_of(Device::Impl& device, const QueueSlot& queue) {
  return {device.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, queue.family)};
}

void begin_recording(const vk::raii::CommandBuffer& buffer) {
  buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
}

// Both halves of the way of an image from one family to the other: the release after what `from` did with
// it, the acquire before what `to` does. In between stands a semaphore, which needs no more than the stages.
void change_owner(const Image& image, const vk::raii::CommandBuffer& from, uint32_t from_family,
                  const vk::raii::CommandBuffer& to, uint32_t to_family) {
  const Image::Impl& i = image.impl();
  vk::ImageMemoryBarrier2 half(all_stages, all_access, all_stages, {}, i.layout, i.layout, from_family,
                               to_family, *i.image, {i.aspect, 0, image.levels(), 0, 1});
  from.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, half));
  half.setSrcAccessMask({}).setDstAccessMask(all_access);
  to.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, half));
}

}  // namespace

Commands::Impl::Impl(Device& owner)
    : device(owner.impl()), pool(pool_of(device, device.main)), fence(device.device, vk::FenceCreateInfo()) {
  parts[0] = allocated(device, pool);
  if (device.limits.timestamp_valid_bits)
    stamps = vk::raii::QueryPool(device.device,
                                 vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, max_stamps));
}

void Commands::Impl::create_fork() {
  if (*second_pool) return;
  second_pool = pool_of(device, device.second);
  of(Part::second) = allocated(device, second_pool);
  of(Part::beside) = allocated(device, pool);
  of(Part::after) = allocated(device, pool);
  forked_off = vk::raii::Semaphore(device.device, vk::SemaphoreCreateInfo());
  joined = vk::raii::Semaphore(device.device, vk::SemaphoreCreateInfo());
}

void Commands::Impl::barrier(vk::PipelineStageFlags2 after, vk::AccessFlags2 access) {
  vk::MemoryBarrier2 all(all_stages, all_access, after, access);
  now().pipelineBarrier2(vk::DependencyInfo({}, all));
}

// Full barrier, stamp, full barrier: the one order that is right on the software driver after raster passes,
// and that keeps a span's work inside it everywhere else. Each queue has its own; the other goes on.
void Commands::Impl::stamp() {
  const auto number = static_cast<uint32_t>(stamp_parts.size());
  barrier();
  now().writeTimestamp2(all_stages, *stamps, number);
  barrier();
  stamp_parts.push_back(part);
}

void Commands::Impl::to_layout(const Image& image, vk::ImageLayout layout) {
  const bool handed = std::find(handed_over.begin(), handed_over.end(), &image) != handed_over.end();
  if (part == Part::beside && handed)
    throw std::logic_error("an image that the second queue uses is used beside it");
  vk::raii::CommandBuffer* buffer = &now();
  // What the image's first use on the second queue asks for is done before the fork, while the main queue has
  // it.
  if (part == Part::second && !handed) buffer = &of(Part::before);
  if (image.impl().layout != layout) {
    vk::ImageMemoryBarrier2 change(all_stages, all_access, all_stages, all_access, image.impl().layout,
                                   layout, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                   *image.impl().image, {image.impl().aspect, 0, image.levels(), 0, 1});
    buffer->pipelineBarrier2(vk::DependencyInfo({}, {}, {}, change));
    image.impl().layout = layout;
  }
  if (part == Part::second && !handed) hand_over(image);
}

void Commands::Impl::hand_over(const Image& image) {
  handed_over.push_back(&image);
  if (device.two_families())
    change_owner(image, of(Part::before), device.main.family, of(Part::second), device.second.family);
}

void Commands::Impl::hand_back() {
  for (const Image* image : handed_over)
    if (device.two_families())
      change_owner(*image, of(Part::second), device.second.family, of(Part::after), device.main.family);
  handed_over.clear();
}

Commands::Commands(Device& device) : impl_(std::make_unique<Impl>(device)) {}
Commands::~Commands() = default;

void Commands::begin(Timing timing) {
  Impl& c = *impl_;
  ML_CHECK(!c.recording);
  c.pool.reset();
  if (*c.second_pool) c.second_pool.reset();
  c.sets.reset();
  c.timing = timing;
  c.part = Part::before;
  c.forked = c.unordered = false;
  c.stamp_parts.clear();
  c.spans.clear();
  c.open_spans.clear();
  c.span_depth = 0;
  c.handed_over.clear();
  begin_recording(c.now());
  c.recording = true;
  if (c.timed()) {
    // The second queue's stamps are reset here too: it begins after a semaphore.
    c.now().resetQueryPool(*c.stamps, 0, max_stamps);
    c.stamp();
  }
}

void Commands::fork(const std::function<void()>& second, const std::function<void()>& beside) {
  Impl& c = *impl_;
  if (!c.recording || c.forked) throw std::logic_error("a submission is forked once, while it is recorded");
  if (c.span_depth) throw std::logic_error("a fork inside a span");
  c.create_fork();
  c.forked = true;
  for (Part part : {Part::second, Part::beside, Part::after}) begin_recording(c.of(part));
  c.part = Part::second;
  second();
  c.part = Part::beside;
  beside();
  c.part = Part::after;
  c.hand_back();
}

// A semaphore makes all that was written before it visible after it, in every stage: no barrier is needed
// across queues but for the owner of an image.
void Commands::Impl::submit_parts() {
  const vk::CommandBufferSubmitInfo before(*of(Part::before)), second(*of(Part::second)),
      beside(*of(Part::beside)), after(*of(Part::after));
  if (!forked) {
    device.main.queue.submit2(vk::SubmitInfo2({}, {}, before), *fence);
    return;
  }
  const vk::SemaphoreSubmitInfo fork_point(*forked_off, 0, all_stages), join_point(*joined, 0, all_stages);
  device.main.queue.submit2(vk::SubmitInfo2({}, {}, before, fork_point));
  // Before `beside`, so that both begin together. Every wait is submitted after its signal: in this order
  // one queue, which then is `second` too, comes to an end as well.
  device.second.queue.submit2(vk::SubmitInfo2({}, fork_point, second, join_point));
  const std::array rest{vk::SubmitInfo2({}, {}, beside), vk::SubmitInfo2({}, join_point, after)};
  device.main.queue.submit2(rest, *fence);
}

SubmissionTimes Commands::submit() {
  Impl& c = *impl_;
  ML_CHECK(c.recording);
  ML_CHECK_EQ(c.span_depth, 0);
  if (c.timed()) c.stamp();
  c.barrier(vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
  c.of(Part::before).end();
  if (c.forked)
    for (Part part : {Part::second, Part::beside, Part::after}) c.of(part).end();
  c.recording = false;
  SubmissionTimes times;
  try {
    auto begin = std::chrono::steady_clock::now();
    c.submit_parts();
    // A frame of a software device can take minutes; a hang is for the user to stop. The fence stands after
    // all parts: the last one waits for the second queue.
    if (c.device.device.waitForFences(*c.fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
      throw SystemError("the device did not finish");
    const double fence =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    c.device.device.resetFences(*c.fence);
    if (c.timed()) {
      const auto count = static_cast<uint32_t>(c.stamp_parts.size());
      const std::vector<uint64_t> ticks =
          c.stamps
              .getResults<uint64_t>(0, count, count * sizeof(uint64_t), sizeof(uint64_t),
                                    vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
              .second;
      std::vector<Stamp> stamps;
      for (size_t i = 0; i < ticks.size(); ++i) stamps.push_back({ticks[i], c.stamp_parts[i]});
      const DeviceLimits& limits = c.device.limits;
      times = times_of(
          {limits.timestamp_valid_bits, limits.second_timestamp_valid_bits, limits.timestamp_period_ns},
          stamps, c.spans);
    }
    times.fence = fence;
    times.forked = c.forked;
  } catch (const vk::Error& error) {
    throw SystemError(std::string("the device failed: ") + error.what());
  }
  return times;
}

Commands::Span Commands::span(std::string_view name) {
  Impl& c = *impl_;
  if (is_inner(name)) throw std::logic_error(fmt::format("a slash in the name of the span '{}'", name));
  if (c.stamps_spans()) {
    // Space for the last stamps of this span, of those around it, and of the submission: a span that ends
    // must not throw.
    ML_CHECK_LE(c.stamp_parts.size() + c.open_spans.size() + 3, max_stamps);
    const std::string around = c.open_spans.empty() ? "" : c.spans[c.open_spans.back()].name + "/";
    c.open_spans.push_back(c.spans.size());
    c.spans.push_back({around + std::string(name), c.stamp_parts.size(), 0});
  }
  ++c.span_depth;
  begin_label(c.device, c.now(), name);
  if (c.stamps_spans()) c.stamp();
  return Span(*this);
}

void Commands::end_span() {
  Impl& c = *impl_;
  if (c.stamps_spans()) {
    c.spans[c.open_spans.back()].last = c.stamp_parts.size();
    c.open_spans.pop_back();
    c.stamp();
  }
  end_label(c.device, c.now());
  --c.span_depth;
}

Commands::Unordered Commands::unordered() {
  Impl& c = *impl_;
  ML_CHECK(!c.unordered);
  c.unordered = true;
  std::lock_guard lock(c.device.log.mutex);
  c.device.log.writes_apart = true;
  return Unordered(*this);
}

void Commands::end_unordered() {
  Impl& c = *impl_;
  c.unordered = false;
  {
    std::lock_guard lock(c.device.log.mutex);
    c.device.log.writes_apart = false;
  }
  c.barrier();
}

}  // namespace ml::gpu
