// The smaller pictures of a texture, for samplers that ask for them.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/scene/scene.h"

namespace ml {

// How many there are down to one pixel, the whole picture counted.
uint32_t level_count(uint32_t width, uint32_t height);

// All levels one after the other, the texture itself first; each is half as wide and high as the one before,
// rounded down, at least one pixel. A pixel is the mean of what it covers; with `srgb` colours are averaged
// as light, not as bytes, and alpha as it is. The same bytes on every machine.
std::vector<uint8_t> with_levels(const Texture& texture, bool srgb);

}  // namespace ml
