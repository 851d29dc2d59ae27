#include "harness/frame/occupied_blocks.h"

#include <bit>
#include <cstring>

#include "shaders/shared/contributing.h"
#include "spirv/occupied_blocks_comp.h"

namespace ml {
namespace {

// From top to bottom; for a software device by their reversed bits. Mesa's gives each thread one stretch of
// the workgroups, and rows that are near each other take about as long: so every stretch gets some of each
// part of the picture, however many there are.
std::vector<uint32_t> order_of_rows(uint32_t count, bool spread) {
  std::vector<uint32_t> rows;
  const int bits = std::bit_width(count - 1);
  for (uint32_t i = 0; i < 1u << bits; ++i) {
    uint32_t row = spread ? 0 : i;
    for (int bit = 0; spread && bit < bits; ++bit) row |= (i >> bit & 1) << (bits - 1 - bit);
    if (row < count) rows.push_back(row);
  }
  return rows;
}

}  // namespace

OccupiedBlocks::OccupiedBlocks(gpu::Device& device, uint32_t width, uint32_t height)
    : columns_((width + ML_BLOCK - 1) / ML_BLOCK),
      rows_(order_of_rows((height + ML_BLOCK - 1) / ML_BLOCK, device.info().is_software())),
      program_(device, occupied_blocks_comp, "occupied blocks"),
      found_(device, columns_ * rows_.size() * sizeof(uint32_t), gpu::MemoryKind::device, "seen blocks"),
      readback_(device, found_.bytes(), gpu::MemoryKind::readback, "seen blocks, read back"),
      list_(device, "list of seen blocks") {
  list_.map(0);
}

void OccupiedBlocks::record(gpu::Commands& commands, const gpu::Bindings& bindings) {
  gpu::Bindings all = bindings;
  all.emplace_back("Found", found_);
  commands.dispatch(program_, all, std::span<const std::byte>{}, columns_,
                    static_cast<uint32_t>(rows_.size()));
  commands.read_buffer(found_, found_.bytes(), readback_);
}

void OccupiedBlocks::read() {
  const auto* found = reinterpret_cast<const uint32_t*>(readback_.mapped().data());
  positions_.clear();
  for (uint32_t row : rows_)
    for (uint32_t column = 0; column < columns_; ++column)
      if (found[size_t{row} * columns_ + column] != 0) positions_.emplace_back(column, row);
  const size_t bytes = positions_.size() * sizeof(glm::u16vec2);
  std::span<std::byte> memory = list_.map(bytes);
  if (bytes > 0) std::memcpy(memory.data(), positions_.data(), bytes);
}

}  // namespace ml
