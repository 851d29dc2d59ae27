// A value for a specialization constant of a shader, by its name there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ml::gpu {

struct Constant {
  std::string name;
  uint32_t value = 0;
  // For any program that has it; without this mark a program that lacks the constant is refused.
  bool offered = false;
};
// Where a name stands twice the later value is taken.
using Constants = std::vector<Constant>;

// constant_ids from here on belong to an algorithm or a single pass: each of a program must be given.
inline constexpr uint32_t first_own_constant = 32;

}  // namespace ml::gpu
