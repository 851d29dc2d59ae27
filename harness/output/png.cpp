// A PNG writer for 8-bit RGB (ISO/IEC 15948): a page of code over zlib, and the same bytes for the same
// picture.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string_view>

#include "harness/base/check.h"
#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/output/picture.h"

namespace ml {
namespace {

using Bytes = std::vector<uint8_t>;

void append_u32(Bytes& out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<uint8_t>(value >> shift));
}

void append_chunk(Bytes& out, std::string_view type, std::span<const uint8_t> content) {
  append_u32(out, static_cast<uint32_t>(content.size()));
  size_t start = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), content.begin(), content.end());
  append_u32(out, static_cast<uint32_t>(crc32_z(0, out.data() + start, out.size() - start)));
}

// tEXt holds Latin-1 without control characters but line breaks; what does not fit becomes '?'.
Bytes text_chunk(std::string_view keyword, std::string_view text) {
  Bytes content(keyword.begin(), keyword.end());
  content.push_back(0);
  for (char c : text)
    content.push_back(c == '\n' || (c >= 0x20 && c < 0x7f) ? static_cast<uint8_t>(c) : uint8_t{'?'});
  return content;
}

// Row filters 0 (none), 1 (left) and 2 (above); per row the one with the least sum of absolute differences is
// taken.
Bytes filtered_rows(uint32_t width, uint32_t height, const Bytes& rgb) {
  size_t row_bytes = size_t{3} * width;
  Bytes out;
  out.reserve((row_bytes + 1) * height);
  Bytes above(row_bytes, 0);
  std::array<Bytes, 3> candidates{Bytes(row_bytes), Bytes(row_bytes), Bytes(row_bytes)};
  for (uint32_t y = 0; y < height; ++y) {
    const uint8_t* row = rgb.data() + y * row_bytes;
    std::array<uint64_t, 3> cost{};
    for (size_t i = 0; i < row_bytes; ++i) {
      candidates[0][i] = row[i];
      candidates[1][i] = static_cast<uint8_t>(row[i] - (i >= 3 ? row[i - 3] : 0));
      candidates[2][i] = static_cast<uint8_t>(row[i] - above[i]);
      for (size_t f = 0; f < cost.size(); ++f)
        cost[f] += static_cast<uint64_t>(std::abs(static_cast<int8_t>(candidates[f][i])));
    }
    auto best = static_cast<size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    out.push_back(static_cast<uint8_t>(best));
    out.insert(out.end(), candidates[best].begin(), candidates[best].end());
    std::copy(row, row + row_bytes, above.begin());
  }
  return out;
}

}  // namespace

void write_png(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb,
               const std::filesystem::path& file, const std::string& description) {
  ML_CHECK(width > 0 && height > 0);
  ML_CHECK_EQ(rgb.size(), size_t{3} * width * height);
  Bytes rows = filtered_rows(width, height, rgb);
  uLongf packed_size = compressBound(static_cast<uLong>(rows.size()));
  Bytes packed(packed_size);
  if (compress2(packed.data(), &packed_size, rows.data(), static_cast<uLong>(rows.size()), 6) != Z_OK)
    throw SystemError("cannot write " + file.string() + ": zlib is out of memory");
  packed.resize(packed_size);

  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  append_u32(header, width);
  append_u32(header, height);
  header.insert(header.end(), {8, 2, 0, 0, 0});  // 8 bits, RGB, deflate, adaptive filters, not interlaced
  append_chunk(out, "IHDR", header);
  append_chunk(out, "sRGB", Bytes{0});
  if (!description.empty()) append_chunk(out, "tEXt", text_chunk("Description", description));
  constexpr size_t largest_chunk = size_t{1} << 30;
  for (size_t at = 0; at < packed.size(); at += largest_chunk)
    append_chunk(out, "IDAT", std::span(packed).subspan(at, std::min(largest_chunk, packed.size() - at)));
  append_chunk(out, "IEND", {});
  write_file(file, std::as_bytes(std::span(out)));
}

}  // namespace ml
