// Private to this room: a module with the values of its specialization constants written in, and without what
// they switch off.
//
// A driver that is given the whole module first inlines every function into every place that calls it, and
// finds out afterwards that most of these places are never reached: the shading loop holds light_sample()
// some 60 times, of which one run needs 6 to 8. That took lavapipe 10 s where 2 s are needed, and SwiftShader
// minutes a program. Arithmetic is left as it is: pictures and counters keep their bits.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "harness/gpu/constant.h"

namespace ml::gpu {

// constant_id of each specialization constant of a module, by its name.
using ConstantIds = std::map<std::string, uint32_t>;
// Values by constant_id.
using SpecializationValues = std::map<uint32_t, uint32_t>;

// The values that each of a program's modules gets. Throws std::logic_error, naming the program and the
// constant, where no module has a constant that is not only offered, where one of a module's own constants
// (first_own_constant) is not given, and where two constants of a module have one id.
std::vector<SpecializationValues> specialization_values(const std::vector<ConstantIds>& modules,
                                                        const Constants& constants,
                                                        const std::string& program);

// Constants without a value keep their defaults. Throws std::logic_error when the module is not valid.
std::vector<uint32_t> specialized(std::span<const uint32_t> spirv, const SpecializationValues& values,
                                  const std::string& program);

}  // namespace ml::gpu
