// The lists of a froxel grid, from a frame's lights to one array: cull, [sort], bound, count, scatter. What
// clustered shading, light trees (one slice) and their hybrid have in common.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/algorithm.h"
#include "algorithms/froxels/ball_test.h"
#include "algorithms/froxels/binning.h"
#include "algorithms/froxels/depth_order.h"
#include "algorithms/froxels/refinement.h"
#include "algorithms/froxels/row_lists.h"

namespace ml {

struct FroxelSettings {
  // What a list's light indices ascend by: themselves, or their centres' depth (DepthKey; equal ones by
  // index).
  enum class Order { index, depth };
  uint32_t tile = 24;  // px
  uint32_t slices = 16;
  float zmin = 5;           // m, end of the near slice
  float zmax = 0;           // m, 0: the view's far
  bool refinement = false;  // refinement.h; without effect beside the ball test, which leaves out more
  bool ball_test = false;   // ball_test.h
  // With the ball test and order by depth: of each pair of froxel and light the depths at which the ball is
  // met in the froxel's tile, beside those of whole lights.
  bool chords = false;
  // Light indices of 16 bits where a frame has so few lights that those tell them apart.
  bool narrow = false;
  Order order = Order::index;
};

class FroxelLists {
 public:
  // `owner`: the algorithm's name for messages.
  explicit FroxelLists(std::string owner) : owner_(std::move(owner)) {}

  // Builds the lists of a frame; spans `cull`, `sort` (order by depth) and `bin`. Lists do not depend on the
  // number of threads. Throws SystemError when they would hold more than `max_entries`.
  void build(const FrameInput& frame, const FroxelSettings& settings, uint64_t max_entries, Spans& spans) {
    build(frame, settings, max_entries, nullptr, 0, spans);
  }
  // The same for lists that the GPU reads from a slot of the memory: they are built there where it is cached.
  // upload_entries() sees to it that they are there.
  void build(const FrameInput& frame, const FroxelSettings& settings, UploadMemory& memory, uint32_t slot,
             Spans& spans) {
    const bool narrow = narrows(frame, settings);
    build(frame, settings, memory.limit() / (narrow ? sizeof(uint16_t) : sizeof(uint32_t)),
          narrow ? nullptr : &memory, slot, spans);
  }
  void upload_entries(UploadMemory& memory, uint32_t slot) const;
  // The grid as the shaders that read the lists see it.
  gpu_data::FroxelGridData grid_data() const;

  const FroxelGrid& grid() const { return grid_; }
  // Where each froxel's list begins in entries(), and one more: the end of the last.
  std::span<const uint32_t> offsets() const { return std::span(offsets_).first(grid_.cells() + size_t{1}); }
  // Light indices.
  std::span<const uint32_t> entries() const { return list_.first(entries_); }
  // Bytes of the entries as they are uploaded.
  uint64_t entry_bytes() const { return entries_ * (narrow_ ? sizeof(uint16_t) : sizeof(uint32_t)); }
  uint64_t lights_in_frustum() const { return in_frustum_; }
  // Of the froxel of a surface point: how many.
  uint32_t lights_at(glm::uvec2 pixel, float depth) const {
    const uint32_t cell = grid_.cell_of(pixel, depth);
    return offsets_[cell + 1] - offsets_[cell];
  }
  // The most entries of one froxel.
  uint32_t longest() const { return longest_; }

  // Whether the lists were made row by row (row_lists.h) rather than from pairs.
  bool built_by_rows() const { return by_rows_; }

  // Order by depth only: the depths (m) that each light in a list reaches, by light index.
  std::span<const DepthReach> reach_of_light() const { return reaches_; }
  // With chords only, else empty: the same of each of the entries, within its froxel's tile. Padded.
  std::span<const DepthReach> reach_of_entry() const {
    return std::span(entry_reaches_).first(chords_ ? entries_ : 0);
  }

 private:
  // A run of lights, worked on by one thread at a time: first one of the frame's lights, then one of the
  // visible lights in the order of lists.
  struct Part {
    uint64_t froxels = 0;  // of its lights' boxes
    FroxelPairs pairs;
    std::vector<uint32_t> next;  // per froxel: first the part's count, then where its next entry goes
  };
  void cull(const FrameInput& frame, bool by_depth, const BoundsConstants& constants);
  void bound(const FrameLights& lights, size_t p, bool by_depth, const BoundsConstants& constants);
  void emit(size_t p, const FroxelSettings& settings, const BoundsConstants& constants, uint64_t max_entries);
  // The lists of one run of lights without pairs; false: not worth it.
  bool list_rows(const FrameInput& frame, bool by_depth, uint64_t max_entries, UploadMemory* memory,
                 uint32_t slot);
  // Counting sort of all pairs into the lists.
  void scatter(Threads& threads);
  template <bool with_reaches>
  void scatter_part(size_t part);
  void build(const FrameInput& frame, const FroxelSettings& settings, uint64_t max_entries,
             UploadMemory* memory, uint32_t slot, Spans& spans);
  // Makes space for the lists' entries.
  void begin_list(uint64_t entries, UploadMemory* memory, uint32_t slot);
  static bool narrows(const FrameInput& frame, const FroxelSettings& settings) {
    return settings.narrow && frame.lights.count() <= size_t{1} << 16;
  }
  [[noreturn]] void too_many(uint64_t entries, uint64_t limit) const;

  std::string owner_;
  FroxelGrid grid_;
  BoxOffsets box_offsets_;
  RefinementPlanes planes_;
  BallTest ball_test_;
  // One for each of runs_ and of parts_ is in use.
  std::vector<IndexRun> runs_;
  std::vector<Part> parts_;
  VisibleLights visible_;
  std::vector<DepthReach> reaches_, entry_reaches_;
  DepthOrder order_;
  RowMemory row_memory_;
  std::vector<LightBox> boxes_;  // by index in visible_
  std::vector<uint32_t> offsets_, own_list_;
  std::span<uint32_t> list_;  // own_list_ or upload memory
  size_t entries_ = 0;
  uint32_t longest_ = 0;
  uint64_t in_frustum_ = 0;
  bool by_rows_ = false, chords_ = false, narrow_ = false;
};

}  // namespace ml
