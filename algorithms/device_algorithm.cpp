#include "algorithms/device_algorithm.h"

#include <algorithm>

namespace ml {

const char* word_of(PassKind kind) {
  return kind == PassKind::lists ? "lists" : kind == PassKind::shading ? "shading" : "post";
}

bool DeviceContext::has(std::string_view constant) const {
  return std::ranges::any_of(
      shared, [&](const gpu::Constant& one) { return one.name == constant && one.value != 0; });
}

std::unique_ptr<DeviceAlgorithm> Algorithm::device_half(const DeviceContext&) {
  return std::make_unique<DeviceAlgorithm>();
}

}  // namespace ml
