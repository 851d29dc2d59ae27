// Which of a device's kinds of memory are tried for a resource, and in which order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace ml::gpu {

struct MemoryType {
  uint32_t properties;  // Vulkan's bits: device-local, host-visible and so on
  uint32_t heap;
};

// Indices of the types to try for so many bytes: those that have all properties of the first wish, then of
// the next; only those `allowed` (a bit each) that lie in a heap of at least that size. Where a heap turns
// out to be full, the next type is tried.
inline std::vector<uint32_t> memory_order(std::span<const MemoryType> types,
                                          std::span<const uint64_t> heap_bytes, uint32_t allowed,
                                          uint64_t bytes, std::span<const uint32_t> wishes) {
  std::vector<uint32_t> order;
  for (uint32_t wish : wishes)
    for (uint32_t i = 0; i < types.size(); ++i)
      if ((allowed >> i & 1) && (types[i].properties & wish) == wish && heap_bytes[types[i].heap] >= bytes &&
          std::find(order.begin(), order.end(), i) == order.end())
        order.push_back(i);
  return order;
}

}  // namespace ml::gpu
