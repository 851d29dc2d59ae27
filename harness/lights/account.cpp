#include "harness/lights/account.h"

#include <fmt/format.h>

namespace ml {

uint32_t LightAccount::rejected() const {
  uint32_t sum = 0;
  for (const auto& [reason, count] : rejections) sum += count;
  return sum;
}

std::vector<std::string> account_lines(const LightAccount& account) {
  std::string reasons;
  for (const auto& [reason, count] : account.rejections)
    reasons += fmt::format("{}{}: {}", reasons.empty() ? " (" : ", ", reason, count);
  if (!reasons.empty()) reasons += ")";
  std::vector<std::string> lines{fmt::format("lights: {} {}, {} used, {} dark, {} rejected{}, {} left out",
                                             account.total, account.of_file ? "in the file" : "made",
                                             account.used, account.dark, account.rejected(), reasons,
                                             account.left_out)};
  if (account.left_out > 0)
    lines.push_back(
        fmt::format("{} of the file's {} lights are left out by {}{}", account.left_out, account.total,
                    account.limit_is_given ? "lights.count=" : "the bench's limit of ", account.limit));
  return lines;
}

}  // namespace ml
