// The drivers that tests are run on by scripts/test.sh, where a test has to know.
#pragma once

#include <cstdlib>
#include <string>

namespace ml::test {

// SwiftShader keeps no compiled programs, and takes seconds for one: some tests are thinned there, by name.
inline bool on_swiftshader() {
  const char* driver = std::getenv("VK_DRIVER_FILES");
  return driver && std::string(driver).find("swiftshader") != std::string::npos;
}

}  // namespace ml::test
