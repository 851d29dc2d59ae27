// Counter-based and sequential random numbers, the same on every machine and compiler.
//
// Source: M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms", 2014; the
// hash is the RXS-M-XS output step that M. Jarzynski and M. Olano compare in "Hash Functions for GPU
// Rendering", JCGT 9(3), 2020. Floats are made from the upper 24 bits, so that 0 <= value < 1 holds exactly.
#pragma once

#include <cstdint>

namespace ml {

constexpr uint32_t hash_u32(uint32_t value) {
  uint32_t state = value * 747796405u + 2891336453u;
  uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

// A hash of several values in order: the number a (seed, light, dimension) triple stands for.
template <typename... Rest>
constexpr uint32_t hash_u32(uint32_t first, uint32_t second, Rest... rest) {
  return hash_u32(hash_u32(first) + second, rest...);
}

// 0 <= result < 1, from 24 bits.
constexpr float unit_float(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// A sequence of numbers from one seed.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 6364136223846793005ull + 1442695040888963407ull) { next(); }
  uint32_t next() {
    uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    auto turn = static_cast<uint32_t>(old >> 59);
    return (shifted >> turn) | (shifted << ((32 - turn) & 31));
  }
  // 0 <= result < count, without modulo bias worth speaking of (count < 2^24). `count` > 0.
  uint32_t below(uint32_t count) {
    return static_cast<uint32_t>((static_cast<uint64_t>(next()) * count) >> 32);
  }
  float uniform() { return unit_float(next()); }
  float uniform(float low, float high) { return low + (high - low) * uniform(); }

 private:
  uint64_t state_;
};

}  // namespace ml
