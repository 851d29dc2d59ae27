// `doctor`: what the machine can do, whether its clocks can be believed, and how noisy it is.
#pragma once

#include <string>

namespace ml {

struct DoctorReport {
  std::string text;
  bool healthy = false;  // a device can be used and its clock agrees with itself
};

// Throws SystemError when there is no Vulkan at all or the selector matches nothing.
DoctorReport examine(const std::string& device_selector);

}  // namespace ml
