// Colours with a stated meaning: the sRGB curve, and the scales of the heat maps. Only +, -, *, / are used,
// so that pictures have the same bytes on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ml {

struct Color {
  uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Color&, const Color&) = default;
};

// Linear light (clamped to [0, 1]) to the nearest 8-bit code of the sRGB curve (IEC 61966-2-1). NaN gives 0.
uint8_t srgb_byte(double linear);

// The sequential scale at t in [0, 1]: dark blue over green to yellow, in equal steps of Oklab distance (B.
// Ottosson, "A perceptual color space for image processing", 2020) and of steadily rising lightness, so that
// it reads the same without red-green vision and in grey.
Color scale_color(double t);

// Eight colours that readers with any common colour blindness can tell apart (M. Okabe, K. Ito, "Color
// Universal Design", 2008), in an order that sets neighbours far apart.
inline constexpr std::array<Color, 8> class_colors{{{86, 180, 233},
                                                    {230, 159, 0},
                                                    {0, 158, 115},
                                                    {204, 121, 167},
                                                    {240, 228, 66},
                                                    {0, 114, 178},
                                                    {213, 94, 0},
                                                    {0, 0, 0}}};

inline constexpr Color zero_color{0, 0, 0};
inline constexpr Color no_value_color{72, 72, 72};
inline constexpr Color not_finite_color{255, 0, 255};

}  // namespace ml
