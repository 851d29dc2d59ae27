// Any text is a configuration or an ml::Error; and what was accepted is accepted again, resolved. After a
// line "--set" every line is an override.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/config/config.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> overrides;
  constexpr std::string_view mark = "\n--set\n";
  if (size_t end = text.find(mark); end != text.npos) {
    std::string_view rest = text.substr(end + mark.size());
    text = text.substr(0, end);
    while (!rest.empty() && overrides.size() < 8) {
      size_t line = rest.find('\n');
      overrides.emplace_back(rest.substr(0, line));
      rest = line == rest.npos ? std::string_view() : rest.substr(line + 1);
    }
  }
  ml::Config config;
  try {
    config = ml::parse_config_text(text, "fuzz.json", "/levels", overrides);
  } catch (const ml::Error&) {
    return 0;
  }
  // No error may come out from here on.
  ml::Config again = ml::parse_config_text(config.resolved.dump(), "again.json", "/elsewhere");
  if (again.resolved != config.resolved) std::abort();
  std::vector<ml::Case> cases = ml::expand_cases(config);
  if (cases.empty() || cases.size() != ml::expand_cases(again).size()) std::abort();
  return 0;
}
