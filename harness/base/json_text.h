// JSON as a configuration may use it: plain JSON, and nothing in it twice.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ml {

// Deepest nesting of arrays and objects.
inline constexpr size_t json_depth_limit = 32;

// Parses the whole text. A byte order mark and any line ends are fine. Throws UsageError "SOURCE: line 3,
// column 5: ..." for syntax (comments, trailing commas, numbers beyond double, bytes that are not UTF-8), and
// "SOURCE: $.a.b: ..." for a key that an object has twice and for nesting beyond the limit.
nlohmann::json parse_json_text(std::string_view text, const std::string& source);

// ".key", or "['odd key']", to be appended to a JSON path; long keys are cut.
std::string json_path_key(std::string_view key);

}  // namespace ml
