// Which lanes of four bytes come first when those that a mask keeps are moved to the front.
#pragma once

#include <array>
#include <cstdint>

namespace ml::simd {

// [mask of 8 bits][lane]: the lane that moves there, of eight; after the kept ones lane 0.
inline constexpr auto kept_of_eight = [] {
  std::array<std::array<uint8_t, 8>, 256> table{};
  for (uint32_t mask = 0; mask < table.size(); ++mask)
    for (uint8_t lane = 0, next = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table[mask][next++] = lane;
  return table;
}();

// [mask of 4 bits][byte]: the byte that moves there, of sixteen; after the kept lanes those of lane 0.
alignas(16) inline constexpr auto kept_bytes_of_four = [] {
  std::array<std::array<uint8_t, 16>, 16> table{};
  for (uint32_t mask = 0; mask < table.size(); ++mask)
    for (uint8_t lane = 0; lane < 4; ++lane)
      for (uint8_t byte = 0; byte < 4; ++byte)
        table[mask][4u * lane + byte] = static_cast<uint8_t>(4u * kept_of_eight[mask][lane] + byte);
  return table;
}();

}  // namespace ml::simd
