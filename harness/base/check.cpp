#include "harness/base/check.h"

#include <filesystem>
#include <stdexcept>

namespace ml {

void check_failed(const char* file, int line, const char* condition, const std::string& values) {
  throw std::logic_error(fmt::format("{}:{}: {} does not hold{}{}",
                                     std::filesystem::path(file).filename().string(), line, condition,
                                     values.empty() ? "" : ": ", values));
}

}  // namespace ml
