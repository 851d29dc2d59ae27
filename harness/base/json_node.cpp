#include "harness/base/json_node.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/json_text.h"

namespace ml {

namespace {

using nlohmann::json;

std::string shown(const json& value) {
  switch (value.type()) {
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return fmt::format("a list of {}", value.size());
    case json::value_t::string: {
      std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
      return text.size() <= 80
                 ? text
                 : fmt::format("a text of {} bytes", value.get_ref<const std::string&>().size());
    }
    case json::value_t::number_float:
      return fmt::format("{}", value.get<double>());
    default:
      return value.dump();
  }
}

}  // namespace

Node Node::member(const std::string& key) const {
  return {json_->at(key), *source_, path_ + json_path_key(key)};
}

void Node::fail(const std::string& what) const {
  throw UsageError(where() + ": " + what);
}

void Node::expected(const std::string& what) const {
  fail("expected " + what + ", found " + shown(*json_));
}

void Node::object() const {
  if (!json_->is_object()) expected("an object");
}

size_t Node::list(size_t min_length, size_t max_length) const {
  if (json_->is_array() && json_->size() >= min_length && json_->size() <= max_length) return json_->size();
  expected(min_length == max_length ? fmt::format("a list of {}", min_length)
                                    : fmt::format("a list of {} to {}", min_length, max_length));
}

int64_t Node::integer(int64_t minimum, int64_t maximum) const {
  std::string what = fmt::format("an integer from {} to {}", minimum, maximum);
  if (!json_->is_number_integer()) expected(what);
  bool beyond_int64 =
      json_->is_number_unsigned() && json_->get<uint64_t>() > static_cast<uint64_t>(INT64_MAX);
  if (beyond_int64 || json_->get<int64_t>() < minimum || json_->get<int64_t>() > maximum) expected(what);
  return json_->get<int64_t>();
}

uint32_t Node::unsigned_integer(uint32_t minimum, uint32_t maximum) const {
  return static_cast<uint32_t>(integer(minimum, maximum));
}

double Node::real(double minimum, double maximum) const {
  if (json_->is_number()) {
    double value = json_->get<double>();
    if (std::isfinite(value) && value >= minimum && value <= maximum) return value + 0.0;  // -0 becomes 0
  }
  expected(fmt::format("a number from {} to {}", minimum, maximum));
}

bool Node::boolean() const {
  if (!json_->is_boolean()) expected("true or false");
  return json_->get<bool>();
}

std::string Node::text(size_t min_letters, size_t max_letters) const {
  if (!json_->is_string()) expected("a text");
  std::string text = json_->get<std::string>();
  size_t letters = 0;
  for (char c : text) {
    auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) fail("control characters and line breaks are not allowed in a text");
    letters += (byte & 0xc0) != 0x80;
  }
  if (letters < min_letters || letters > max_letters) {
    expected(fmt::format("a text of {} to {} letters", min_letters, max_letters));
  }
  return text;
}

size_t Node::choice(const std::vector<std::string>& names) const {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  if (!json_->is_string()) expected("one of " + list);
  const auto& word = json_->get_ref<const std::string&>();
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == word) return i;
  }
  std::string near = nearest_name(word, names);
  expected("one of " + list + (near.empty() ? "" : " (did you mean '" + near + "'?)"));
}

double shortest_double(float value) {
  char digits[64];
  auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  double result = 0;
  std::from_chars(digits, end, result);
  // Rounding twice (decimal to double to float) could in principle end elsewhere.
  return static_cast<float>(result) == value ? result : static_cast<double>(value);
}

}  // namespace ml
