#include "harness/base/json_text.h"

#include <gtest/gtest.h>

#include "harness/base/error.h"

namespace ml {
namespace {

using nlohmann::json;

std::string refusal(const std::string& text) {
  try {
    parse_json_text(text, "f.json");
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

void expect_at(const std::string& text, const std::string& where) {
  std::string what = refusal(text);
  EXPECT_TRUE(what.starts_with("f.json: " + where + ": ")) << what;
}

TEST(JsonText, ReadsWhatTheLibraryReads) {
  for (const char* text :
       {"null", "true", "-0.5", "12", "18446744073709551615", "\"\\u00e9\\n\"", "[]", "{}",
        "[1, [2, {\"a\": [3]}], \"x\"]", R"({"a": {"b": [1, {"c": null}, false]}, "d": 1e3})"}) {
    EXPECT_EQ(parse_json_text(text, "f"), json::parse(text)) << text;
  }
}

TEST(JsonText, ByteOrderMarkAndLineEndsAreFine) {
  json expected = json::parse(R"({"a": [1, 2]})");
  EXPECT_EQ(parse_json_text("\xef\xbb\xbf{\"a\": [1, 2]}", "f"), expected);
  EXPECT_EQ(parse_json_text("{\r\n\"a\":\r\n[1,\r\n2]\r\n}\r\n", "f"), expected);
}

TEST(JsonText, SyntaxErrorsNameLineAndColumn) {
  expect_at("{\"a\": 1,}", "line 1, column 9");
  expect_at("{\n  \"a\": 1\n  \"b\": 2\n}", "line 3, column 5");
  expect_at("{\r\n  \"a\": x\r\n}", "line 2, column 8");
  expect_at("\xef\xbb\xbf{\"a\" 1}", "line 1, column 6");
  expect_at("[\"\xc3\xa9\xc3\xa9\", x]", "line 1, column 8");
  expect_at("", "line 1, column 1");
  expect_at("[1, 2", "line 1, column 6");
  expect_at("{} {}", "line 1, column 4");
  expect_at("[1e999]", "line 1, column 6");
  expect_at("[NaN]", "line 1, column 2");
  expect_at("{\"a\": 1} // why", "line 1, column 10");
  expect_at("/* why */ {}", "line 1, column 1");
}

TEST(JsonText, MessagesAreOnePlainLine) {
  for (const char* text :
       {"{\"a\": 1,}", "[1 2]", "[\"\n\"]", "[\"\xff\"]", "\"unfinished", "[1e999]", "\x01"}) {
    std::string what = refusal(text);
    EXPECT_EQ(what.find("json.exception"), what.npos) << what;
    EXPECT_EQ(what.find('\n'), what.npos) << what;
  }
}

TEST(JsonText, AKeyTwiceIsRefusedWhereItIs) {
  EXPECT_EQ(refusal(R"({"lights": {"count": 1, "seed": 2, "count": 1}})"),
            "f.json: $.lights.count: the key is there twice");
  EXPECT_EQ(refusal(R"({"a": [0, {"b": 1, "b": 2}]})"), "f.json: $.a[1].b: the key is there twice");
  EXPECT_EQ(parse_json_text(R"({"a": {"a": 1}, "b": {"a": 2}})", "f").size(), 2u);
}

TEST(JsonText, NestingHasALimit) {
  auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(parse_json_text(nested(json_depth_limit), "f"));
  EXPECT_NE(refusal(nested(json_depth_limit + 1)).find("nested deeper than 32"), std::string::npos);
  EXPECT_NE(refusal(std::string(1000000, '[')).find("nested deeper than 32"), std::string::npos);
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_NE(refusal(objects).find("nested deeper than 32"), std::string::npos);
}

}  // namespace
}  // namespace ml
