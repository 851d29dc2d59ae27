#include "harness/output/canvas.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ml {
namespace {

// The font's tables end at the tilde.
std::string printable(std::string line) {
  for (char& c : line)
    if (c < 0x20 || c > 0x7e) c = '?';
  return line;
}

}  // namespace

Canvas::Canvas(uint32_t width, uint32_t height, Color background) : width_(width), height_(height) {
  bytes_.resize(size_t{3} * width * height);
  fill(0, 0, width, height, background);
}

void Canvas::set(int64_t x, int64_t y, Color color) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  uint8_t* pixel = bytes_.data() + 3 * (static_cast<size_t>(y) * width_ + static_cast<size_t>(x));
  pixel[0] = color.r, pixel[1] = color.g, pixel[2] = color.b;
}

void Canvas::fill(int64_t x, int64_t y, int64_t w, int64_t h, Color color) {
  int64_t right = std::min<int64_t>(x + w, width_), bottom = std::min<int64_t>(y + h, height_);
  for (int64_t row = std::max<int64_t>(y, 0); row < bottom; ++row)
    for (int64_t column = std::max<int64_t>(x, 0); column < right; ++column) set(column, row, color);
}

void Canvas::ring(double x, double y, double radius, double thickness, Color color, int64_t right,
                  int64_t bottom) {
  auto reach = static_cast<int64_t>(std::ceil(radius + thickness)) + 1;
  auto cx = static_cast<int64_t>(x), cy = static_cast<int64_t>(y);
  for (int64_t row = cy - reach; row <= std::min(cy + reach, bottom - 1); ++row) {
    for (int64_t column = cx - reach; column <= std::min(cx + reach, right - 1); ++column) {
      double dx = static_cast<double>(column) + 0.5 - x, dy = static_cast<double>(row) + 0.5 - y;
      if (std::abs(std::sqrt(dx * dx + dy * dy) - radius) <= 0.5 * thickness) set(column, row, color);
    }
  }
}

void Canvas::text(int64_t x, int64_t y, int64_t scale, const std::string& line, Color color) {
  // A quad is four vertices of x, y, z (float) and a colour: 64 bytes. No glyph has more than 16 strokes.
  std::string glyphs = printable(line);
  std::vector<float> vertices(16 * 16 * (glyphs.size() + 1));
  int quads = stb_easy_font_print(0, 0, glyphs.data(), nullptr, vertices.data(),
                                  static_cast<int>(vertices.size() * sizeof(float)));
  for (int q = 0; q < quads; ++q) {
    const float* quad = vertices.data() + 16 * q;
    auto left = static_cast<int64_t>(quad[0]), top = static_cast<int64_t>(quad[1]);
    auto right = static_cast<int64_t>(quad[8]),
         bottom = static_cast<int64_t>(quad[9]);  // the opposite corner
    fill(x + left * scale, y + top * scale, (right - left) * scale, (bottom - top) * scale, color);
  }
}

int64_t Canvas::text_width(int64_t scale, const std::string& line) {
  std::string glyphs = printable(line);
  return stb_easy_font_width(glyphs.data()) * scale;
}

}  // namespace ml
