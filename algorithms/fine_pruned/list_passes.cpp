#include "algorithms/fine_pruned/list_passes.h"

#include <algorithm>
#include <cstring>

#include "spirv/fine_pruned_bounds.h"
#include "spirv/fine_pruned_offsets.h"
#include "spirv/fine_pruned_regions.h"
#include "spirv/fine_pruned_tiles.h"

namespace ml {
namespace {

// Values of MODE in tiles.comp.
enum Mode : uint32_t { mode_count, mode_lists, mode_packed };

// Of all regions' lists: each has space for all lights in view.
constexpr uint64_t max_region_bytes = uint64_t{32} << 20;

gpu::Constants with(gpu::Constants shared, const gpu::Constants& own) {
  shared.insert(shared.end(), own.begin(), own.end());
  return shared;
}

uint32_t tiles_along(uint32_t pixels) {
  return (pixels + ML_PRUNED_TILE - 1) / ML_PRUNED_TILE;
}

}  // namespace

ListPasses::ListPasses(gpu::Device& device, const gpu::Constants& shared, const PruneSettings& settings)
    : device_(device),
      settings_(settings),
      shared_(shared),
      bounds_(device, fine_pruned_bounds, "fine_pruned: bounds",
              with(shared, {{"BOUNDS", settings.bounds}})) {
  if (!settings.packed)
    offsets_ = std::make_unique<gpu::ComputeProgram>(device, fine_pruned_offsets, "fine_pruned: offsets");
  for (Grown* grown :
       {&light_bounds_, &tile_lists_, &list_lights_, &packed_lists_, &tile_counts_, &region_lists_})
    reserve(*grown, 16);
}

ListPasses::TilePrograms& ListPasses::programs(bool regions) {
  TilePrograms& made = regions ? in_regions_ : flat_;
  const auto make = [&](uint32_t mode, uint32_t prune, const char* name) {
    return std::make_unique<gpu::ComputeProgram>(device_, fine_pruned_tiles, name,
                                                 with(shared_, {{"MODE", mode},
                                                                {"PRUNE", prune},
                                                                {"TILE_DEPTHS", settings_.tile_depths},
                                                                {"REGIONS", regions}}));
  };
  if (!made.lists) {
    made.lists = make(settings_.packed ? mode_packed : mode_lists, settings_.prune, "fine_pruned: lists");
    if (!settings_.packed) made.count = make(mode_count, ML_PRUNE_COARSE, "fine_pruned: coarse");
  }
  if (regions && !regions_)
    regions_ = std::make_unique<gpu::ComputeProgram>(device_, fine_pruned_regions, "fine_pruned: regions",
                                                     with(shared_, {{"TILE_DEPTHS", settings_.tile_depths}}));
  return made;
}

void ListPasses::lay_out_regions(uint32_t columns, uint32_t rows, uint32_t visible) {
  const uint64_t max_bytes = std::min<uint64_t>(device_.limits().storage_buffer_range, max_region_bytes);
  region_shift_ = 3;
  const auto along = [this](uint32_t tiles) { return ((tiles - 1) >> region_shift_) + 1; };
  while (uint64_t{along(columns)} * along(rows) * (visible + 1) * 4 > max_bytes &&
         along(columns) * along(rows) > 1)
    ++region_shift_;
  region_columns_ = along(columns);
  region_rows_ = along(rows);
  reserve(region_lists_, uint64_t{region_columns_} * region_rows_ * (visible + 1) * 4);
}

void ListPasses::reserve(Grown& grown, uint64_t bytes) {
  const uint64_t had = grown.buffer ? grown.buffer->bytes() : 0;
  if (bytes <= had) return;
  // Larger than the device allows is refused by the buffer, which names itself.
  const uint64_t limit = device_.limits().storage_buffer_range / 4 * 4;
  grown.buffer =
      std::make_unique<gpu::Buffer>(device_, std::max(bytes, std::min(2 * had, limit)),
                                    gpu::MemoryKind::device, std::string("fine_pruned: ") + grown.name);
}

void ListPasses::record(gpu::Commands& commands, const gpu_data::ViewData& view, const gpu::Bindings& frame,
                        uint32_t visible, uint64_t entries) {
  const uint32_t columns = tiles_along(view.resolution.x), rows = tiles_along(view.resolution.y);
  columns_ = columns;
  tiles_ = columns * rows;
  reserve(light_bounds_, uint64_t{visible} * sizeof(gpu_data::ScreenBounds));
  reserve(tile_counts_, uint64_t{tiles_} * 8);
  if (settings_.packed) {
    reserve(packed_lists_, uint64_t{tiles_} * settings_.packed_words() * 4);
  } else {
    reserve(tile_lists_, uint64_t{tiles_} * 8);
    // Some space more, for lights that the device's own rounding puts into one tile more. A tile for which
    // there is none in the end walks all visible lights.
    const uint64_t limit = std::min<uint64_t>(device_.limits().storage_buffer_range / 4, ML_PRUNED_ALL - 1);
    reserve(list_lights_, std::min(entries + entries / 4 + 1024, limit) * 4);
  }
  const bool regions = visible > settings_.region_lights;
  if (regions) lay_out_regions(columns, rows, visible);
  TilePrograms& tile_programs = programs(regions);
  gpu::Bindings list = frame;
  bindings(list);
  const gpu_data::PrunedPush push{
      columns,
      tiles_,
      static_cast<uint32_t>(std::min<uint64_t>(list_lights_.buffer->bytes() / 4, ML_PRUNED_ALL - 1)),
      region_shift_,
      region_columns_,
      visible + 1};
  {
    auto span = commands.span("bounds");
    commands.dispatch(bounds_, list, push, (visible + 63) / 64);
  }
  if (regions) {
    auto span = commands.span("regions");
    commands.dispatch(*regions_, list, push, region_columns_, region_rows_);
  }
  if (!settings_.packed) {
    auto span = commands.span("coarse");
    commands.dispatch(*tile_programs.count, list, push, columns, rows);
    commands.dispatch(*offsets_, list, push, 1);
  }
  auto span = commands.span("lists");
  commands.dispatch(*tile_programs.lists, list, push, columns, rows);
}

void ListPasses::bindings(gpu::Bindings& list) const {
  for (const Grown* grown :
       {&light_bounds_, &tile_lists_, &list_lights_, &packed_lists_, &tile_counts_, &region_lists_})
    list.emplace_back(grown->name, *grown->buffer);
}

uint32_t ListPasses::listed(glm::uvec2 pixel) const {
  return listed_.at(size_t{pixel.y / ML_PRUNED_TILE} * columns_ + pixel.x / ML_PRUNED_TILE);
}

ListPasses::Counts ListPasses::read(gpu::Commands& commands) {
  Counts sums;
  sums.tiles = tiles_;
  listed_.assign(tiles_, 0);
  const size_t bytes = size_t{tiles_} * 8;
  if (bytes == 0) return sums;
  if (!readback_ || readback_->bytes() < bytes)
    readback_ = std::make_unique<gpu::Buffer>(device_, bytes, gpu::MemoryKind::readback,
                                              "fine_pruned: counts of tiles");
  commands.begin(gpu::Timing::none);
  commands.read_buffer(*tile_counts_.buffer, bytes, *readback_);
  commands.submit();
  std::vector<uint32_t> words(size_t{tiles_} * 2);
  std::memcpy(words.data(), readback_->mapped().data(), bytes);
  auto beyond = [](uint32_t demand, uint32_t limit) { return demand > limit ? demand - limit : 0; };
  for (size_t tile = 0; tile < tiles_; ++tile) {
    const uint32_t coarse = words[2 * tile], pruned = words[2 * tile + 1];
    sums.coarse += coarse;
    if (!settings_.packed) {
      listed_[tile] = pruned;
      sums.listed += pruned;
      continue;
    }
    uint32_t lost = beyond(coarse, ML_PRUNED_CHUNK);
    for (const uint32_t listed : {pruned & 0xffff, pruned >> 16}) {  // listed_pair()
      listed_[tile] += std::min(listed, ML_PACKED_LIGHTS);
      lost += beyond(listed, ML_PACKED_LIGHTS);
    }
    sums.listed += listed_[tile];
    sums.overflow_lights += lost;
    sums.overflow_tiles += lost > 0;
  }
  return sums;
}

}  // namespace ml
