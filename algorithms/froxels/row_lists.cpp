// Compiled once for every instruction set; the best one is chosen at run time (Highway).
// The set that compresses lanes of 8 and 16 bits is made only where it is asked for.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "algorithms/froxels/row_lists.cpp"
#include "algorithms/froxels/row_lists.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "algorithms/froxels/kept_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ml::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Whether lanes of 8 and 16 bits are compressed by an instruction.
constexpr bool compresses_narrow = HWY_TARGET == HWY_AVX3_DL;

template <typename Lane>
class RowSift {
 public:
  RowSift(RowMemory::Levels<Lane>& levels, const FroxelGrid& grid) : m_(levels), grid_(grid) {}

  uint32_t operator()(const LightBox* boxes, const uint32_t* indices, size_t count, uint32_t* offsets,
                      uint32_t* list) {
    take(boxes, indices, count);
    reserve_padded(m_.list, flush + count);
    offsets_ = offsets;
    list_ = list;
    for (uint32_t slice = 0; slice < grid_.slices; ++slice) {
      const size_t in_slice = sift_slice(static_cast<Lane>(slice));
      for (uint32_t row = 0; row < grid_.rows; ++row)
        sift_froxels(sift_row(in_slice, static_cast<Lane>(row)));
    }
    widen();
    *offsets_ = static_cast<uint32_t>(written_);
    return static_cast<uint32_t>(longest_);
  }

 private:
  using Boxes = RowMemory::Boxes<Lane>;
  using Tag = hn::ScalableTag<Lane>;
  using V = hn::Vec<Tag>;
  // Entries that wait in the nearest cache to be widened.
  static constexpr size_t flush = 4096;

  // The boxes as lanes.
  void take(const LightBox* boxes, const uint32_t* indices, size_t count) {
    auto& all = m_.all;
    for (auto* lanes : {&all.light, &all.column, &all.columns, &all.row, &all.rows, &all.slice, &all.slices,
                        &m_.slice.light, &m_.slice.column, &m_.slice.columns, &m_.slice.row, &m_.slice.rows,
                        &m_.row.light, &m_.row.column, &m_.row.columns})
      reserve_padded(*lanes, count);
    taken_ = 0;
    for (size_t i = 0; i < count; ++i) {
      const LightBox& box = boxes[indices ? indices[i] : i];
      const uint32_t row = box.first / grid_.columns;
      all.light[taken_] = static_cast<Lane>(box.light);
      all.column[taken_] = static_cast<Lane>(box.first - row * grid_.columns);
      all.columns[taken_] = static_cast<Lane>(box.columns);
      all.row[taken_] = static_cast<Lane>(row % grid_.rows);
      all.rows[taken_] = static_cast<Lane>(box.rows);
      all.slice[taken_] = static_cast<Lane>(row / grid_.rows);
      all.slices[taken_] = static_cast<Lane>(box.slices);
      ++taken_;
    }
    end(all.slices, taken_);
  }

  // Lanes that hold nothing, after the last light.
  void end(std::vector<Lane>& extent, size_t count) { hn::StoreU(hn::Zero(d_), d_, &extent[count]); }

  // Copies some lanes of the first `in` boxes, of those that hold a coordinate along the axis whose first
  // coordinate and extent are given; returns how many they are. The comparison is unsigned: coordinates
  // before the first are far beyond the extent.
  template <class... Lanes>
  size_t sift(const Boxes& from, size_t in, std::vector<Lane> Boxes::*first, std::vector<Lane> Boxes::*extent,
              Lane coordinate, Boxes& to, Lanes... lanes) {
    const V coordinates = hn::Set(d_, coordinate);
    size_t count = 0;
    for (size_t i = 0; i < in; i += hn::Lanes(d_)) {
      const KeptLanes<Tag> kept(d_, hn::Lt(hn::Sub(coordinates, hn::LoadU(d_, &(from.*first)[i])),
                                           hn::LoadU(d_, &(from.*extent)[i])));
      (kept.store(hn::LoadU(d_, &(from.*lanes)[i]), &(to.*lanes)[count]), ...);
      count += kept.count();
    }
    return count;
  }
  size_t sift_slice(Lane slice) {
    const size_t count = sift(m_.all, taken_, &Boxes::slice, &Boxes::slices, slice, m_.slice, &Boxes::light,
                              &Boxes::column, &Boxes::columns, &Boxes::row, &Boxes::rows);
    end(m_.slice.rows, count);
    return count;
  }
  size_t sift_row(size_t in_slice, Lane row) {
    const size_t count = sift(m_.slice, in_slice, &Boxes::row, &Boxes::rows, row, m_.row, &Boxes::light,
                              &Boxes::column, &Boxes::columns);
    end(m_.row.columns, count);
    return count;
  }
  // All froxels of a row, by the smallest vectors that hold its lights: those are stored fastest.
  void sift_froxels(size_t in_row) {
    const hn::CappedTag<Lane, 16 / sizeof(Lane)> quarter;
    const hn::CappedTag<Lane, 32 / sizeof(Lane)> half;
    if (in_row <= hn::Lanes(quarter))
      sift_short_row(quarter);
    else if (in_row <= hn::Lanes(half))
      sift_short_row(half);
    else if (in_row <= hn::Lanes(d_))
      sift_short_row(d_);
    else
      sift_long_row(in_row);
  }
  template <class D>
  void sift_short_row(D d) {
    const auto light = hn::LoadU(d, m_.row.light.data()), first = hn::LoadU(d, m_.row.column.data()),
               extent = hn::LoadU(d, m_.row.columns.data());
    for_each_froxel([=](Lane column, Lane* to) HWY_ATTR {
      const KeptLanes<D> kept(d, hn::Lt(hn::Sub(hn::Set(d, column), first), extent));
      kept.store(light, to);
      return kept.count();
    });
  }
  void sift_long_row(size_t in_row) {
    const Tag d;
    const Lane *light = m_.row.light.data(), *first = m_.row.column.data(), *extent = m_.row.columns.data();
    for_each_froxel([=](Lane column, Lane* to) HWY_ATTR {
      const V coordinate = hn::Set(d, column);
      size_t count = 0;
      for (size_t i = 0; i < in_row; i += hn::Lanes(d)) {
        const KeptLanes<Tag> kept(
            d, hn::Lt(hn::Sub(coordinate, hn::LoadU(d, first + i)), hn::LoadU(d, extent + i)));
        kept.store(hn::LoadU(d, light + i), to + count);
        count += kept.count();
      }
      return count;
    });
  }
  // Calls sift(column, where to write) for the froxels of a row; it returns how many lights it wrote. What
  // counts stands in registers: stores of bytes could change any member.
  template <class Sift>
  HWY_INLINE void for_each_froxel(Sift sift) {
    uint32_t* offsets = offsets_;
    Lane* list = m_.list.data();
    const uint32_t columns = grid_.columns;
    size_t written = written_, waiting = waiting_, longest = longest_;
    for (uint32_t column = 0; column < columns; ++column) {
      *offsets++ = static_cast<uint32_t>(written + waiting);
      const size_t count = sift(static_cast<Lane>(column), list + waiting);
      waiting += count;
      longest = std::max(longest, count);
      if (waiting < flush) continue;
      waiting_ = waiting;
      widen();
      written += waiting;
      waiting = 0;
    }
    offsets_ = offsets;
    waiting_ = waiting;
    longest_ = longest;
  }

  void widen() {
    const hn::ScalableTag<uint32_t> words;
    const hn::Rebind<Lane, decltype(words)> narrow;
    uint32_t* to = list_ + written_;
    size_t i = 0;
    for (; i + hn::Lanes(words) <= waiting_; i += hn::Lanes(words)) {
      const auto lights = hn::LoadU(narrow, &m_.list[i]);
      if constexpr (sizeof(Lane) == sizeof(uint32_t))
        hn::StoreU(lights, words, to + i);
      else
        hn::StoreU(hn::PromoteTo(words, lights), words, to + i);
    }
    for (; i < waiting_; ++i) to[i] = m_.list[i];
    written_ += waiting_;
    waiting_ = 0;
  }

  const Tag d_;
  RowMemory::Levels<Lane>& m_;
  const FroxelGrid& grid_;
  size_t taken_ = 0;
  uint32_t *offsets_ = nullptr, *list_ = nullptr;
  size_t written_ = 0, waiting_ = 0, longest_ = 0;
};

// Bytes of a lane.
size_t lane_bytes(size_t light_end, const FroxelGrid& grid) {
  if (!compresses_narrow || light_end > 0x10000) return 4;
  return light_end <= 0x100 && std::max({grid.columns, grid.rows, grid.slices}) < 0x100 ? 1 : 2;
}

uint32_t row_lanes(size_t light_end, const FroxelGrid& grid) {
  // Portable code has one lane, whatever its bytes.
  const size_t bytes = hn::Lanes(hn::ScalableTag<uint8_t>());
  return static_cast<uint32_t>(std::max<size_t>(bytes / lane_bytes(light_end, grid), 1));
}

uint32_t list_rows(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
                   size_t light_end, RowMemory& memory, uint32_t* offsets, uint32_t* list) {
  const size_t bytes = lane_bytes(light_end, grid);
  if constexpr (compresses_narrow) {
    if (bytes == 1) return RowSift(memory.levels<uint8_t>(), grid)(boxes, indices, count, offsets, list);
    if (bytes == 2) return RowSift(memory.levels<uint16_t>(), grid)(boxes, indices, count, offsets, list);
  }
  return RowSift(memory.levels<uint32_t>(), grid)(boxes, indices, count, offsets, list);
}

}  // namespace ml::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ml {
namespace simd {

HWY_EXPORT(row_lanes);
HWY_EXPORT(list_rows);

uint32_t row_lanes(size_t light_end, const FroxelGrid& grid) {
  return HWY_DYNAMIC_DISPATCH(row_lanes)(light_end, grid);
}
uint32_t list_rows(const LightBox* boxes, const uint32_t* indices, size_t count, const FroxelGrid& grid,
                   size_t light_end, RowMemory& memory, uint32_t* offsets, uint32_t* list) {
  return HWY_DYNAMIC_DISPATCH(list_rows)(boxes, indices, count, grid, light_end, memory, offsets, list);
}

}  // namespace simd

bool rows_are_cheaper(const LightBox* boxes, size_t count, uint64_t pairs, const FroxelGrid& grid,
                      size_t light_end) {
  // Rows of few froxels cannot win, and need no sum to say so.
  if (pairs < 4 * uint64_t{count}) return false;
  uint64_t in_slices = 0, in_rows = 0;
  for (size_t i = 0; i < count; ++i) {
    in_slices += boxes[i].slices;
    in_rows += uint64_t{boxes[i].slices} * boxes[i].rows;
  }
  const uint64_t lanes = simd::row_lanes(light_end, grid);
  const uint64_t slice_steps = grid.slices * (count / lanes + 1);
  const uint64_t row_steps = grid.rows * (in_slices / lanes + grid.slices);
  const uint64_t froxel_steps = grid.columns * (in_rows / lanes + grid.slices * grid.rows);
  return 3 * (slice_steps + row_steps) + froxel_steps < pairs;
}

}  // namespace ml
#endif
