#include "harness/output/lights_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "harness/base/error.h"
#include "harness/base/file.h"

namespace ml {
namespace {

constexpr std::string_view header =
    "index,x [m],y [m],z [m],radius [m],intensity_r [W/sr],intensity_g [W/sr],intensity_b [W/sr],shape,"
    "direction_x,direction_y,direction_z,cone_scale,cone_limit,cos_outer,"
    "side_x,side_y,side_z,half_length [m],half_extent_side [m],half_extent_up [m],half_extent_direction "
    "[m],probe";
constexpr size_t columns = 23, shape_column = 8, probe_column = 22;
constexpr std::array<std::string_view, 5> shapes{"omni", "spot", "capsule", "wedge", "box"};

std::array<float*, columns> numbers_of(LightRow& row) {
  return {nullptr,
          &row.position[0],
          &row.position[1],
          &row.position[2],
          &row.radius,
          &row.intensity[0],
          &row.intensity[1],
          &row.intensity[2],
          nullptr,
          &row.direction[0],
          &row.direction[1],
          &row.direction[2],
          &row.cone_scale,
          &row.cone_limit,
          &row.cos_outer,
          &row.side[0],
          &row.side[1],
          &row.side[2],
          &row.half_length,
          &row.half_extents[0],
          &row.half_extents[1],
          &row.half_extents[2],
          nullptr};
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t begin = 0;;) {
    size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

LightRow parse_row(std::string_view line, size_t index, const std::string& where) {
  std::vector<std::string_view> cells = split(line, ',');
  if (cells.size() != columns)
    throw UsageError(fmt::format("{}: expected {} columns, found {}", where, columns, cells.size()));
  if (cells[0] != std::to_string(index))
    throw UsageError(fmt::format("{}: expected index {}, found '{}'", where, index, cells[0]));
  LightRow row;
  row.shape = cells[shape_column];
  if (std::find(shapes.begin(), shapes.end(), row.shape) == shapes.end())
    throw UsageError(
        fmt::format("{}: expected shape {}, found '{}'", where, fmt::join(shapes, ", "), row.shape));
  if (cells[probe_column] != "0" && cells[probe_column] != "1")
    throw UsageError(fmt::format("{}: column {}: expected 0 or 1, found '{}'", where, probe_column + 1,
                                 cells[probe_column]));
  row.probe = cells[probe_column] == "1";
  std::array<float*, columns> numbers = numbers_of(row);
  for (size_t c = 0; c < columns; ++c) {
    if (!numbers[c]) continue;
    const char *begin = cells[c].data(), *end = begin + cells[c].size();
    auto [stop, problem] = std::from_chars(begin, end, *numbers[c]);
    if (problem != std::errc() || stop != end || !std::isfinite(*numbers[c]))
      throw UsageError(fmt::format("{}: column {}: expected a number, found '{}'", where, c + 1, cells[c]));
  }
  return row;
}

}  // namespace

void write_lights_csv(const std::vector<LightRow>& lights, const std::filesystem::path& file) {
  std::string text = std::string(header) + "\n";
  for (size_t i = 0; i < lights.size(); ++i) {
    LightRow row = lights[i];
    std::array<float*, columns> numbers = numbers_of(row);
    text += std::to_string(i);
    for (size_t c = 1; c < probe_column; ++c)
      text += c == shape_column ? "," + row.shape : fmt::format(",{:.9g}", *numbers[c]);
    text += row.probe ? ",1\n" : ",0\n";
  }
  write_file(file, text);
}

std::vector<LightRow> read_lights_csv(const std::filesystem::path& file) {
  std::string text = read_text_file(file, size_t{1} << 30);
  std::vector<std::string_view> lines = split(text, '\n');
  if (lines.front() != header)
    throw UsageError(file.string() + ": line 1: expected the header '" + std::string(header) + "'");
  if (!lines.back().empty())
    throw UsageError(fmt::format("{}: line {}: the file ends within a line", file.string(), lines.size()));
  lines.pop_back();
  std::vector<LightRow> rows;
  for (size_t i = 1; i < lines.size(); ++i)
    rows.push_back(parse_row(lines[i], rows.size(), fmt::format("{}: line {}", file.string(), i + 1)));
  return rows;
}

}  // namespace ml
