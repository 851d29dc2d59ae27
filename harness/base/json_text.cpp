#include "harness/base/json_text.h"

#include <cctype>
#include <utility>
#include <vector>

#include "harness/base/error.h"

namespace ml {

namespace {

using nlohmann::json;

// Builds the document from the parser's events, knowing at each of them the path to where it is.
class Builder : public json::json_sax_t {
 public:
  Builder(std::string_view text, const std::string& source) : text_(text), source_(source) {}
  json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // not in text

  bool start_object(size_t) override { return open(json::object()); }
  bool start_array(size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    key_ = std::move(name);
    if (open_.back()->contains(key_)) throw UsageError(source_ + ": " + path() + ": the key is there twice");
    return true;
  }

  bool parse_error(size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    throw UsageError(source_ + ": " + line_and_column(position) + ": " + reason(error.what()));
  }

 private:
  // Puts a value where the parser is, and returns a pointer to it.
  template <typename Value>
  json* put(Value&& value) {
    if (open_.empty()) {
      root_ = std::forward<Value>(value);
      return &root_;
    }
    json& parent = *open_.back();
    if (parent.is_array()) {
      parent.push_back(std::forward<Value>(value));
      return &parent.back();
    }
    json& slot = parent[key_];
    slot = std::forward<Value>(value);
    return &slot;
  }

  template <typename Value>
  bool add(Value&& value) {
    put(std::forward<Value>(value));
    return true;
  }

  bool open(json container) {
    if (open_.size() == json_depth_limit) {
      throw UsageError(source_ + ": " + path() + ": nested deeper than " + std::to_string(json_depth_limit) +
                       " levels");
    }
    std::string here = path();
    open_.push_back(put(std::move(container)));
    paths_.push_back(std::move(here));
    return true;
  }

  bool close() {
    open_.pop_back();
    paths_.pop_back();
    return true;
  }

  // Path of the value that comes next.
  std::string path() const {
    if (open_.empty()) return "$";
    const json& parent = *open_.back();
    return paths_.back() +
           (parent.is_array() ? "[" + std::to_string(parent.size()) + "]" : json_path_key(key_));
  }

  // `position` counts bytes read, the offending one included; columns count letters, not bytes.
  std::string line_and_column(size_t position) const {
    size_t line = 1, column = 0;
    for (size_t i = 0; i < position && i < text_.size(); ++i) {
      if (i > 0 && text_[i - 1] == '\n') ++line, column = 0;
      if ((static_cast<unsigned char>(text_[i]) & 0xc0) != 0x80) ++column;
    }
    if (position > text_.size()) ++column;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
  }

  // The library's message without its own prefix "[json.exception.parse_error.101] parse error at line 1,
  // column 2: ".
  static std::string reason(std::string_view what) {
    if (what.starts_with('[')) {
      if (size_t end = what.find("] "); end != what.npos) what.remove_prefix(end + 2);
    }
    if (what.starts_with("parse error at ")) {
      if (size_t end = what.find(": "); end != what.npos) what.remove_prefix(end + 2);
    }
    return std::string(what);
  }

  std::string_view text_;
  const std::string& source_;
  json root_;
  std::string key_;
  std::vector<json*> open_;  // containers from the root to where the parser is
  std::vector<std::string> paths_;
};

}  // namespace

json parse_json_text(std::string_view text, const std::string& source) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  Builder builder(text, source);
  json::sax_parse(text, &builder);
  return builder.take();
}

std::string json_path_key(std::string_view key) {
  constexpr size_t longest = 60;
  bool plain = !key.empty() && key.size() <= longest;
  for (char c : key)
    plain = plain && (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.');
  if (plain) return "." + std::string(key);
  std::string shown(key.substr(0, longest));
  if (key.size() > longest) {
    // Not in the middle of a letter of several bytes.
    while (!shown.empty() && (static_cast<unsigned char>(key[shown.size()]) & 0xc0) == 0x80) shown.pop_back();
    shown += "...";
  }
  return "['" + shown + "']";
}

}  // namespace ml
