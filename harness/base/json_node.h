// A JSON value that knows where it stands, so that every complaint about it names the place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ml {

// Where values come from: a file, or "--set".
struct Source {
  std::string name;
  std::filesystem::path relative_to;  // folder that relative paths in it start from
};

// `json` and `source` must outlive the node.
class Node {
 public:
  Node(const nlohmann::json& json, const Source& source, std::string path = "$")
      : json_(&json), source_(&source), path_(std::move(path)) {}

  const nlohmann::json& json() const { return *json_; }
  const Source& source() const { return *source_; }
  const std::string& path() const { return path_; }
  std::string where() const { return source_->name + ": " + path_; }

  Node item(size_t index) const {
    return {(*json_)[index], *source_, path_ + "[" + std::to_string(index) + "]"};
  }
  // `key` must be there.
  Node member(const std::string& key) const;

  // Throws UsageError "SOURCE: PATH: what".
  [[noreturn]] void fail(const std::string& what) const;
  // "expected WHAT, found ...".
  [[noreturn]] void expected(const std::string& what) const;

  // Typed values; each throws when the value is another.
  void object() const;
  size_t list(size_t min_length, size_t max_length) const;  // its length
  int64_t integer(int64_t minimum, int64_t maximum) const;
  uint32_t unsigned_integer(uint32_t minimum, uint32_t maximum) const;
  double real(double minimum, double maximum) const;
  bool boolean() const;
  // Without control characters.
  std::string text(size_t min_letters, size_t max_letters) const;
  // Index of the word among `names`.
  size_t choice(const std::vector<std::string>& names) const;

 private:
  const nlohmann::json* json_;
  const Source* source_;
  std::string path_;
};

// The shortest decimal number that is `value` again when read: 0.6f becomes 0.6, not 0.60000002384185791.
double shortest_double(float value);

}  // namespace ml
