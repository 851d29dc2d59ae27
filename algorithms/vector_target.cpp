#include "algorithms/vector_target.h"

// All sets that any file of vector code is made for. A file that lacks the chosen one takes its next best.
#define HWY_WANT_AVX3_DL
#include <fmt/format.h>
#include <hwy/targets.h>

#include <cstdint>

#include "harness/base/error.h"

namespace ml::simd {
namespace {

// Portable code is the fallback, and no processor is said to have it.
std::vector<int64_t> targets() {
  std::vector<int64_t> all = hwy::SupportedAndGeneratedTargets();
  if (all.empty() || all.back() != HWY_STATIC_TARGET) all.push_back(HWY_STATIC_TARGET);
  return all;
}

}  // namespace

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (int64_t target : targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

std::string target_name() {
  return target_names().front();
}

void use_target(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (name.empty()) return;
  std::string known;
  int64_t from_here_on = 0;
  for (int64_t target : targets()) {
    if (from_here_on != 0 || name == hwy::TargetName(target)) {
      from_here_on |= target;
      continue;
    }
    known += (known.empty() ? "" : ", ") + std::string(hwy::TargetName(target));
  }
  if (from_here_on != 0) {
    hwy::SetSupportedTargetsForTest(from_here_on);
    return;
  }
  throw UsageError(
      fmt::format("this processor has no instruction set \"{}\" for vector code; it has {}", name, known));
}

}  // namespace ml::simd
