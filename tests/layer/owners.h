// Which queue family has each image and buffer that belongs to one family at a time. The validation layer
// matches releases with acquires, but does not miss them where there is neither: this does.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace two_queues {

class Owners {
 public:
  // Resources as numbers, which tell images and buffers apart by the driver's handles.
  void created(uint64_t resource, const char* kind, VkSharingMode mode);
  void destroyed(uint64_t resource);
  void view_created(VkImageView view, VkImage image);
  void sets_allocated(uint32_t count, const VkDescriptorSet* sets);
  void sets_written(uint32_t count, const VkWriteDescriptorSet* writes);

  void begun(VkCommandBuffer buffer);
  void set_bound(VkCommandBuffer buffer, VkDescriptorSet set);
  void attached(VkCommandBuffer buffer, VkImageView view);
  void barriers(VkCommandBuffer buffer, const VkDependencyInfo& info);

  // What the command buffer does on a queue of the family; complains on stderr of what is another's.
  void submitted(VkCommandBuffer buffer, uint32_t family);

 private:
  struct Event {
    uint64_t resource;
    uint32_t from, to;  // equal: a use
  };
  struct State {
    std::string kind;
    uint32_t family = nobody;
    bool on_its_way = false;  // released to `family`, not acquired yet
  };
  static constexpr uint32_t nobody = VK_QUEUE_FAMILY_IGNORED;
  void apply(const Event& event, uint32_t family);

  std::mutex mutex_;
  std::map<uint64_t, State> states_;
  std::map<VkImageView, uint64_t> views_;
  std::map<VkDescriptorSet, std::map<uint32_t, uint64_t>> sets_;
  std::map<VkCommandBuffer, std::vector<Event>> recorded_;
};

}  // namespace two_queues
