#include "tests/layer/owners.h"

#include <cstdio>

namespace two_queues {

void Owners::created(uint64_t resource, const char* kind, VkSharingMode mode) {
  std::lock_guard lock(mutex_);
  states_.erase(resource);
  if (mode == VK_SHARING_MODE_EXCLUSIVE) states_[resource].kind = kind;
}

void Owners::destroyed(uint64_t resource) {
  std::lock_guard lock(mutex_);
  states_.erase(resource);
}

void Owners::view_created(VkImageView view, VkImage image) {
  std::lock_guard lock(mutex_);
  views_[view] = reinterpret_cast<uint64_t>(image);
}

void Owners::sets_allocated(uint32_t count, const VkDescriptorSet* sets) {
  std::lock_guard lock(mutex_);
  for (uint32_t i = 0; i < count; ++i) sets_[sets[i]].clear();
}

void Owners::sets_written(uint32_t count, const VkWriteDescriptorSet* writes) {
  std::lock_guard lock(mutex_);
  for (uint32_t i = 0; i < count; ++i) {
    uint64_t& resource = sets_[writes[i].dstSet][writes[i].dstBinding];
    if (writes[i].pBufferInfo)
      resource = reinterpret_cast<uint64_t>(writes[i].pBufferInfo->buffer);
    else if (writes[i].pImageInfo)
      resource = views_[writes[i].pImageInfo->imageView];
  }
}

void Owners::begun(VkCommandBuffer buffer) {
  std::lock_guard lock(mutex_);
  recorded_[buffer].clear();
}

void Owners::set_bound(VkCommandBuffer buffer, VkDescriptorSet set) {
  std::lock_guard lock(mutex_);
  for (const auto& [binding, resource] : sets_[set]) recorded_[buffer].push_back({resource, nobody, nobody});
}

void Owners::attached(VkCommandBuffer buffer, VkImageView view) {
  std::lock_guard lock(mutex_);
  recorded_[buffer].push_back({views_[view], nobody, nobody});
}

void Owners::barriers(VkCommandBuffer buffer, const VkDependencyInfo& info) {
  std::lock_guard lock(mutex_);
  for (uint32_t i = 0; i < info.imageMemoryBarrierCount; ++i) {
    const VkImageMemoryBarrier2& barrier = info.pImageMemoryBarriers[i];
    recorded_[buffer].push_back({reinterpret_cast<uint64_t>(barrier.image), barrier.srcQueueFamilyIndex,
                                 barrier.dstQueueFamilyIndex});
  }
}

void Owners::submitted(VkCommandBuffer buffer, uint32_t family) {
  std::lock_guard lock(mutex_);
  for (const Event& event : recorded_[buffer]) apply(event, family);
}

void Owners::apply(const Event& event, uint32_t family) {
  auto found = states_.find(event.resource);
  if (found == states_.end()) return;  // all families have it
  State& state = found->second;
  const bool transfer = event.from != event.to, acquire = transfer && event.to == family;
  // The first one that uses it has it.
  if (state.family == nobody) state.family = family;
  if (state.family != family || state.on_its_way != acquire)
    std::fprintf(stderr, "two queues: family %u %s %s that family %u has%s\n", family,
                 !transfer ? "uses"
                 : acquire ? "acquires"
                           : "releases",
                 state.kind.c_str(), state.family, state.on_its_way ? " been given" : "");
  state.family = transfer ? event.to : family;
  state.on_its_way = transfer && !acquire;
}

}  // namespace two_queues
