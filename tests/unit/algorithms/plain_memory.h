// Upload memory on the heap, for tests of prepare() without a device.
#pragma once

#include <array>
#include <vector>

#include "algorithms/algorithm.h"

namespace ml::test {

class PlainMemory final : public UploadMemory {
 public:
  explicit PlainMemory(bool cached = true) : cached_(cached) {}
  std::span<std::byte> map(uint32_t slot, size_t bytes) override {
    if (slots_[slot].size() < bytes) slots_[slot].resize(bytes);
    used_[slot] = bytes;
    return std::span(slots_[slot]).first(bytes);
  }
  size_t limit() const override { return size_t{1} << 30; }
  bool cached(uint32_t) const override { return cached_; }

  // What the last prepare() wrote into a slot.
  std::span<const std::byte> slot(uint32_t index) const {
    return std::span(slots_[index]).first(used_[index]);
  }
  // The same of all, slot by slot.
  std::vector<std::byte> all() const {
    std::vector<std::byte> bytes;
    for (size_t slot = 0; slot < slots_.size(); ++slot)
      bytes.insert(bytes.end(), slots_[slot].begin(),
                   slots_[slot].begin() + static_cast<ptrdiff_t>(used_[slot]));
    return bytes;
  }

 private:
  bool cached_;
  std::array<std::vector<std::byte>, 8> slots_;
  std::array<size_t, 8> used_{};
};

}  // namespace ml::test
