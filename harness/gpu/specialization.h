// Private to this room: a module with the values of its specialization constants written in, and without what
// they switch off.
//
// A driver that is given the whole module first inlines every function into every place that calls it, and
// finds out afterwards that most of these places are never reached: the shading loop holds light_sample()
// some 60 times, of which one run needs 6 to 8. That took lavapipe 10 s where 2 s are needed, and SwiftShader
// minutes a program. Arithmetic is left as it is: pictures and counters keep their bits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/gpu/program.h"

namespace ml::gpu {

// `constants`: values by constant id; constants of the module that are not named keep their defaults, ids
// that the module does not have are left out. Throws std::logic_error when the module is not valid.
std::vector<uint32_t> specialized(std::span<const uint32_t> spirv, const std::vector<Constant>& constants,
                                  const std::string& program);

}  // namespace ml::gpu
