#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/output/canvas.h"
#include "harness/output/picture.h"
#include "harness/output/ticks.h"

namespace ml {
namespace {

constexpr Color paper{250, 250, 250}, ink{20, 20, 20}, white{255, 255, 255};

// What the legend has to say about the values.
struct Summary {
  double maximum = 0;
  uint32_t x = 0, y = 0;  // the first pixel, row by row, that has the maximum
  uint64_t valued = 0, without_value = 0, not_finite = 0;
  bool integers = true;
  std::vector<uint64_t> classes;
};

Summary summarise(const Picture& values, size_t classes) {
  Summary s;
  s.classes.resize(classes);
  for (uint32_t y = 0; y < values.height; ++y) {
    for (uint32_t x = 0; x < values.width; ++x) {
      double value = values.data[values.pixel(x, y)];
      if (!std::isfinite(value)) {
        ++s.not_finite;
      } else if (value < 0) {
        ++s.without_value;
      } else {
        if (s.valued++ == 0 || value > s.maximum) s.maximum = value, s.x = x, s.y = y;
        s.integers &= value == std::floor(value);
        if (value < static_cast<double>(classes)) ++s.classes[static_cast<size_t>(value)];
      }
    }
  }
  return s;
}

// One coloured square, or the ring, with its words.
struct Note {
  bool is_ring = false;
  Color color;
  std::string words;
};

// Lays the legend out in font pixels times `u`, first only measuring, then drawing.
class HeatMap {
 public:
  HeatMap(const Picture& values, const HeatMapStyle& style)
      : values_(values), style_(style), summary_(summarise(values, style.classes.size())) {
    map_width_ = int64_t{values.width} * style.block;
    map_height_ = int64_t{values.height} * style.block;
    u_ = std::clamp<int64_t>(map_width_ / 480, 2, 8);
    bool given = style.maximum > 0 && std::isfinite(style.maximum);
    scale_end_ = given ? style.maximum : summary_.maximum > 0 ? summary_.maximum : 1;
    title_ = style.title + (style.unit.empty() ? "" : " [" + style.unit + "]");
    if (title_.size() > 120) title_.resize(120);
    make_notes();
    width_ = std::max({map_width_, 200 * u_, Canvas::text_width(u_, title_) + 2 * margin()});
    for (const Note& note : notes_) width_ = std::max(width_, note_width(note) + 2 * margin());
  }

  Canvas draw() {
    Canvas canvas(static_cast<uint32_t>(width_), static_cast<uint32_t>(legend(nullptr)), paper);
    draw_map(canvas);
    legend(&canvas);
    return canvas;
  }

  std::string description() const {
    std::string text = title_;
    for (const Note& note : notes_) text += "; " + note.words;
    return text;
  }

 private:
  int64_t margin() const { return 6 * u_; }
  bool has_classes() const { return !style_.classes.empty(); }
  bool marks_maximum() const { return !has_classes() && summary_.valued > 0 && summary_.maximum > 0; }

  Color color_of(double value) const {
    if (!std::isfinite(value)) return not_finite_color;
    if (value < 0) return no_value_color;
    if (!has_classes()) return value == 0 ? zero_color : scale_color(value / scale_end_);
    return value < static_cast<double>(style_.classes.size()) ? class_colors[static_cast<size_t>(value)]
                                                              : not_finite_color;
  }

  void make_notes() {
    for (size_t i = 0; i < style_.classes.size(); ++i) {
      double share = summary_.valued ? 100.0 * static_cast<double>(summary_.classes[i]) /
                                           static_cast<double>(summary_.valued)
                                     : 0;
      notes_.push_back({false, class_colors[i], fmt::format("{} {:.1f} %", style_.classes[i], share)});
    }
    const char* element = style_.block > 1 ? "tile" : "pixel";
    if (marks_maximum())
      notes_.push_back(
          {true, ink,
           fmt::format("maximum {:.6g} at {} ({}, {})", summary_.maximum, element, summary_.x, summary_.y)});
    else if (!has_classes() && summary_.valued > 0)
      notes_.push_back({false, zero_color, "all values are 0"});
    if (summary_.without_value > 0 || summary_.valued == 0)
      notes_.push_back({false, no_value_color, "no value"});
    uint64_t strange = summary_.not_finite;
    if (has_classes()) {
      strange += summary_.valued;
      for (uint64_t count : summary_.classes) strange -= count;
    }
    if (strange > 0)
      notes_.push_back({false, not_finite_color,
                        fmt::format("{}: {} {}{}", has_classes() ? "no class" : "not finite", strange,
                                    element, strange > 1 ? "s" : "")});
  }

  void draw_map(Canvas& canvas) const {
    int64_t block = style_.block;
    for (uint32_t y = 0; y < values_.height; ++y)
      for (uint32_t x = 0; x < values_.width; ++x)
        canvas.fill(x * block, y * block, block, block, color_of(values_.data[values_.pixel(x, y)]));
    if (!marks_maximum()) return;
    // Small maps get a small ring: it should point at the pixel, not cover the picture.
    auto unit = static_cast<double>(std::clamp<int64_t>(std::min(map_width_, map_height_) / 120, 1, u_));
    draw_ring(canvas, (summary_.x + 0.5) * static_cast<double>(block),
              (summary_.y + 0.5) * static_cast<double>(block),
              std::max(5 * unit, 0.75 * static_cast<double>(block) + 2 * unit), unit, map_width_,
              map_height_);
  }

  // White between two black lines: seen on every colour.
  static void draw_ring(Canvas& canvas, double x, double y, double radius, double unit, int64_t right,
                        int64_t bottom) {
    canvas.ring(x, y, radius, 3.5 * unit, ink, right, bottom);
    canvas.ring(x, y, radius, 1.5 * unit, white, right, bottom);
  }

  int64_t note_width(const Note& note) const { return 12 * u_ + Canvas::text_width(u_, note.words); }

  // Draws the legend unless `canvas` is null, and returns where it ends.
  int64_t legend(Canvas* canvas) const {
    int64_t y = map_height_ + margin();
    if (canvas && map_width_ < width_) canvas->fill(map_width_, 0, width_ - map_width_, map_height_, paper);
    if (!title_.empty()) {
      if (canvas) canvas->text(margin(), y, u_, title_, ink);
      y += 14 * u_;
    }
    if (!has_classes()) {
      if (canvas) draw_scale(*canvas, y);
      y += 28 * u_;
    }
    int64_t x = margin();
    for (const Note& note : notes_) {
      if (x > margin() && x + note_width(note) > width_ - margin()) x = margin(), y += 14 * u_;
      if (canvas) draw_note(*canvas, x, y, note);
      x += note_width(note) + 14 * u_;
    }
    return y + 10 * u_ + margin() / 2;
  }

  void draw_note(Canvas& canvas, int64_t x, int64_t y, const Note& note) const {
    if (note.is_ring) {
      draw_ring(canvas, static_cast<double>(x + 4 * u_), static_cast<double>(y + 4 * u_),
                3 * static_cast<double>(u_), 0.6 * static_cast<double>(u_), canvas.width(), canvas.height());
    } else {
      canvas.fill(x, y, 8 * u_, 8 * u_, ink);
      canvas.fill(x + u_ / 2, y + u_ / 2, 8 * u_ - u_, 8 * u_ - u_, note.color);
    }
    canvas.text(x + 12 * u_, y + u_, u_, note.words, ink);
  }

  void draw_scale(Canvas& canvas, int64_t y) const {
    int64_t bar = 10 * u_, half_line = std::max<int64_t>(1, u_ / 2);
    std::string end =
        fmt::format("{}{}", summary_.maximum > scale_end_ ? ">= " : "", tick_label(scale_end_, scale_end_));
    int64_t zero_x = margin(), left = zero_x + bar + 4 * u_;
    int64_t right = width_ - margin() - Canvas::text_width(u_, end) / 2;
    canvas.fill(zero_x, y, bar, bar, zero_color);
    centered(canvas, zero_x + bar / 2, y + bar + 5 * u_, "0");
    for (int64_t x = left; x < right; ++x)
      canvas.fill(x, y, 1, bar,
                  scale_color(static_cast<double>(x - left + 1) / static_cast<double>(right - left)));
    auto tick = [&](double value, const std::string& label) {
      auto x = left + static_cast<int64_t>(value / scale_end_ * static_cast<double>(right - left - 1));
      canvas.fill(x - half_line / 2, y + bar, half_line, 3 * u_, ink);
      centered(canvas, x, y + bar + 5 * u_, label);
    };
    auto pixels = [&](const std::string& label) {
      return static_cast<double>(Canvas::text_width(u_, label) + 18 * u_);
    };
    for (double value : scale_ticks(scale_end_, summary_.integers, static_cast<double>(right - left), pixels))
      tick(value, tick_label(value, scale_end_));
    tick(scale_end_, end);
  }

  void centered(Canvas& canvas, int64_t x, int64_t y, const std::string& label) const {
    canvas.text(x - Canvas::text_width(u_, label) / 2, y, u_, label, ink);
  }

  const Picture& values_;
  const HeatMapStyle& style_;
  Summary summary_;
  int64_t map_width_ = 0, map_height_ = 0, width_ = 0;
  int64_t u_ = 2;  // picture pixels per font pixel
  double scale_end_ = 1;
  std::string title_;
  std::vector<Note> notes_;
};

}  // namespace

void write_heat_map_png(const Picture& values, const std::filesystem::path& file, const HeatMapStyle& style) {
  if (values.channels.size() != 1) throw std::invalid_argument("a heat map needs a picture of one channel");
  if (style.classes.size() > class_colors.size())
    throw std::invalid_argument("a heat map has at most 8 classes");
  uint64_t block = style.block, largest = uint64_t{1} << 16;
  if (block == 0 || values.width == 0 || values.height == 0 || values.width * block > largest ||
      values.height * block > largest)
    throw std::invalid_argument("a heat map has 1 to 65536 pixels a side");
  HeatMap map(values, style);
  Canvas canvas = map.draw();
  write_png(canvas.width(), canvas.height(), canvas.bytes(), file, map.description());
}

}  // namespace ml
