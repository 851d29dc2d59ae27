// The published schema and the reader refuse and accept the same, where a schema can say it.
#include <gtest/gtest.h>

#include "bad_documents.h"
#include "harness/base/file.h"
#include "harness/base/json_text.h"
#include "harness/config/config.h"
#include "harness/config/keys.h"
#include "harness/output/result.h"

namespace ml {
namespace {

using nlohmann::json;

TEST(ConfigSchema, IsTheFileInResults) {
  EXPECT_EQ(config_schema(), json::parse(read_text_file(ML_SOURCE_DIR "/results/schema/config.schema.json")));
}

TEST(ConfigSchema, RefusesWhatTheReaderRefuses) {
  for (const BadDocument& bad : bad_documents()) {
    bool refused = !schema_violations(config_schema(), json::parse(bad.text)).empty();
    // A bad document that the schema could not refuse but does is worth knowing too: the table would then be
    // wrong.
    EXPECT_EQ(refused, bad.schema_refuses) << bad.text;
  }
}

TEST(ConfigSchema, AcceptsEveryShippedConfig) {
  size_t found = 0;
  for (const ConfigInfo& info : known_configs()) {
    Config config = load_config(info.name, {});
    json document = parse_json_text(
        read_text_file(std::string(ML_SOURCE_DIR "/configs/") + info.name + ".json"), info.name);
    for (const json& each : {document, config.resolved}) {
      std::vector<std::string> violations = schema_violations(config_schema(), each);
      EXPECT_TRUE(violations.empty()) << info.name << ": " << violations[0];
    }
    ++found;
  }
  EXPECT_GE(found, 4u);
}

// Every key of the reader is in the schema, with the same limits in text; and the other way round.
TEST(ConfigSchema, HasTheReadersKeys) {
  const json& schema = config_schema();
  json swept = schema["properties"]["sweep"]["properties"];
  size_t sweepable = 0;
  for (const Key& key : config_keys()) {
    size_t dot = key.path.find('.');
    std::string head = key.path.substr(0, dot);
    ASSERT_TRUE(schema["properties"].contains(head)) << key.path;
    if (dot != key.path.npos && head != "scene") {
      EXPECT_TRUE(schema["properties"][head]["properties"].contains(key.path.substr(dot + 1))) << key.path;
    }
    if (head == "effects" && dot != key.path.npos) continue;  // one pattern for all
    EXPECT_EQ(swept.contains(key.path), key.sweepable) << key.path;
    EXPECT_EQ(schema["properties"]["zip"]["properties"].contains(key.path), key.sweepable) << key.path;
    sweepable += key.sweepable;
  }
  EXPECT_EQ(swept.size(), sweepable);
  for (const char* section : {"lights", "camera", "effects", "measure", "outputs"}) {
    for (const auto& [name, value] : schema["properties"][section]["properties"].items()) {
      bool known = false;
      for (const Key& key : config_keys()) known = known || key.path == std::string(section) + "." + name;
      EXPECT_TRUE(known) << section << "." << name;
    }
  }
}

}  // namespace
}  // namespace ml
