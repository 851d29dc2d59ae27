// A small drawing board for legends: rectangles, rings and text over an 8-bit RGB picture. Everything is
// clipped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/output/color_scale.h"

namespace ml {

class Canvas {
 public:
  Canvas(uint32_t width, uint32_t height, Color background);

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

  void set(int64_t x, int64_t y, Color color);
  void fill(int64_t x, int64_t y, int64_t w, int64_t h, Color color);
  // Pixels whose distance from the centre lies within half the thickness of the radius, inside [0, right) x
  // [0, bottom).
  void ring(double x, double y, double radius, double thickness, Color color, int64_t right, int64_t bottom);
  // Printable ASCII (anything else becomes '?'), upper left corner at (x, y), each font pixel scale x scale;
  // letters are 7 of these high, lines 12.
  void text(int64_t x, int64_t y, int64_t scale, const std::string& line, Color color);
  static int64_t text_width(int64_t scale, const std::string& line);

 private:
  uint32_t width_, height_;
  std::vector<uint8_t> bytes_;
};

}  // namespace ml
