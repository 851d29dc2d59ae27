// Private to this room: the programs that a device has compiled, found by all that went into them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "harness/gpu/program.h"

namespace ml::gpu {

// Modules, constants and fixed state of a program as words; each part is preceded by its length, so that no
// two programs have the same.
class ProgramKey {
 public:
  void add(std::span<const uint32_t> words) {
    words_.push_back(static_cast<uint32_t>(words.size()));
    words_.insert(words_.end(), words.begin(), words.end());
  }
  void add(const Constants& constants) {
    words_.push_back(static_cast<uint32_t>(constants.size()));
    for (const Constant& constant : constants) {
      words_.push_back(static_cast<uint32_t>(constant.name.size()));
      words_.insert(words_.end(), constant.name.begin(), constant.name.end());
      words_.push_back(constant.value);
    }
  }
  void add(const RasterState& state) {
    words_.push_back(static_cast<uint32_t>(state.colors.size()));
    for (Format format : state.colors) words_.push_back(static_cast<uint32_t>(format));
    words_.push_back(static_cast<uint32_t>(state.depth));
    words_.push_back(state.vertex_stride);
    words_.push_back(static_cast<uint32_t>(state.attributes.size()));
    for (const VertexAttribute& attribute : state.attributes) {
      words_.push_back(attribute.offset);
      words_.push_back(attribute.components);
    }
    words_.push_back(state.at_equal_depth);
  }
  auto operator<=>(const ProgramKey&) const = default;

 private:
  std::vector<uint32_t> words_;
};

// Safe to use from several threads; two that miss the same program at once both make it.
template <typename Impl>
class ProgramCache {
 public:
  std::shared_ptr<Impl> find(const ProgramKey& key) {
    std::lock_guard lock(mutex_);
    auto found = programs_.find(key);
    if (found == programs_.end()) return nullptr;
    found->second.last_use = ++uses_;
    return found->second.program;
  }
  void add(const ProgramKey& key, std::shared_ptr<Impl> program) {
    std::lock_guard lock(mutex_);
    programs_[key] = {std::move(program), ++uses_};
    if (programs_.size() > max_programs) drop_oldest_unused();
  }

 private:
  // A program takes a megabyte or so of a driver's memory, and a sweep over a compiled-in parameter makes a
  // dozen a point: those in use and the last points' are kept.
  static constexpr size_t max_programs = 256;

  struct Entry {
    std::shared_ptr<Impl> program;
    uint64_t last_use = 0;
  };

  void drop_oldest_unused() {
    auto oldest = programs_.end();
    for (auto it = programs_.begin(); it != programs_.end(); ++it)
      if (it->second.program.use_count() == 1 &&
          (oldest == programs_.end() || it->second.last_use < oldest->second.last_use))
        oldest = it;
    if (oldest != programs_.end()) programs_.erase(oldest);
  }

  std::mutex mutex_;
  std::map<ProgramKey, Entry> programs_;
  uint64_t uses_ = 0;
};

}  // namespace ml::gpu
