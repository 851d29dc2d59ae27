// Smooth noise for ground, from additions and multiplications alone: the same bits on every machine.
#pragma once

#include <cstdint>

namespace ml {

// 0 at and below `low`, 1 at and above `high`, smooth between; `low` may be the larger one.
double smooth_step(double low, double high, double value);

// Four octaves of value noise with features of about 1, in about [-1, 1].
double rough(uint32_t seed, double x, double z);

}  // namespace ml
