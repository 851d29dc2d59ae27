// Upload memory on the heap: what prepare() writes, without a device. For tests, benchmarks and proofs.
#pragma once

#include <span>
#include <vector>

#include "algorithms/algorithm.h"

namespace ml {

class HeapMemory final : public UploadMemory {
 public:
  // `cached`: as UploadMemory::cached() says; a device may have either.
  explicit HeapMemory(bool cached = true, size_t limit = size_t{1} << 30) : cached_(cached), limit_(limit) {}

  std::span<std::byte> map(uint32_t slot, size_t bytes) override {
    if (slots_.size() <= slot) slots_.resize(slot + 1);
    Slot& mapped = slots_[slot];
    // A quarter more, so that a benchmark's memory settles.
    if (mapped.bytes.size() < bytes) mapped.bytes.resize(bytes + bytes / 4);
    mapped.used = bytes;
    return std::span(mapped.bytes).first(bytes);
  }
  size_t limit() const override { return limit_; }
  bool cached(uint32_t) const override { return cached_; }

  // What the last prepare() wrote into a slot.
  std::span<const std::byte> slot(uint32_t number) const {
    return number < slots_.size() ? std::span(slots_[number].bytes).first(slots_[number].used)
                                  : std::span<const std::byte>();
  }
  // All slots, one after the other.
  std::vector<std::byte> all() const {
    std::vector<std::byte> bytes;
    for (const Slot& one : slots_)
      bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.begin() + static_cast<ptrdiff_t>(one.used));
    return bytes;
  }

 private:
  struct Slot {
    std::vector<std::byte> bytes;
    size_t used = 0;
  };
  bool cached_;
  size_t limit_;
  std::vector<Slot> slots_;
};

}  // namespace ml
