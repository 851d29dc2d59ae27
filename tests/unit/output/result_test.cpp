#include "harness/output/result.h"

#include <cmath>
#include <limits>
#include <set>

#include "files.h"
#include "harness/base/error.h"
#include "harness/base/random.h"

namespace {

using namespace ml;
using nlohmann::json;

// A result with something in every field; times are random, so that only exact copies agree.
Result sample_result() {
  Random random(11);
  Result result;
  result.context = {{"commit", "abc"},
                    {"device", {{"name", "llvmpipe"}, {"type", "cpu"}, {"driver", "Mesa"}}}};
  result.config = {{"name", "quick"}};
  result.complete = true;
  result.harness = {{"overhead", 0.25}};
  for (const char* name : {"clustered", "ideal"}) {
    CaseResult one;
    one.id = std::string("canyon-") + name;
    one.algorithm = name;
    one.scene = "canyon";
    one.parameters = {{"tile", 24}, {"policy", "grow"}, {"exact", true}};
    one.lights = 8192;
    one.width = 960, one.height = 540;
    one.effects = {"omni", "specular"};
    one.frames = {0, 1, 2};
    one.repeats_done = 2;
    one.cpu_ms = SampleTable(4, 3), one.gpu_ms = SampleTable(4, 3);
    for (uint32_t repeat = 0; repeat < 4; ++repeat)
      for (uint32_t frame = 0; frame < 3; ++frame) {
        one.cpu_ms.set("total", repeat, frame, random.uniform() / 3.0);
        one.gpu_ms.set("shade", repeat, frame, random.uniform() / 7.0);
      }
    one.overlap = {"compute", true, "", SampleTable(4, 3)};
    for (uint32_t repeat = 0; repeat < 4; ++repeat)
      for (uint32_t frame = 0; frame < 3; ++frame)
        one.overlap.ms.set("both", repeat, frame, random.uniform() / 5.0);
    one.counters = {{"lost", {0, 0, 0}}, {"listed", {10.5, 11.25, 1.0 / 3}}};
    one.accuracy = {{"rmse", 0.5}};
    one.rejected_lights = {{"radius is 0", 2}};
    one.light_account = {true, 8200, 8192, 1, 5};
    one.notes = {"2 materials are blended"};
    one.frames_without_surface = 1;
    one.invalid = true;
    one.invalid_note = "lost lights";
    one.memory_bytes = {{"lists", 1234}};
    one.heatmaps = {"a.exr"};
    result.cases.push_back(one);
  }
  return result;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(ResultJson, SatisfiesItsOwnSchema) {
  EXPECT_EQ(joined(result_violations(to_json(sample_result()))), "");
  EXPECT_EQ(joined(result_violations(to_json(Result{}))), "") << "the file before the first case";
}

TEST(ResultJson, ReadsBackWhatWasWrittenToTheLastBit) {
  Folder folder;
  Result result = sample_result();
  write_result(result, folder / "result.json");
  EXPECT_EQ(read_result(folder / "result.json"), to_json(result));
  json back = read_result(folder / "result.json");
  EXPECT_EQ(back["cases"][1]["gpu_ms"]["shade"][1][2].get<double>(),
            result.cases[1].gpu_ms.tables().at("shade")[1][2]);
}

// Keys that came when there were results without them.
const std::set<std::string> later_keys{"overlap", "light_account", "notes", "frames_without_surface",
                                       "invalid", "invalid_note",  "passes"};

// What is said of the level comes back, and results of before it was said are read.
TEST(ResultJson, KnowsResultsWithAndWithoutBookkeeping) {
  json document = to_json(sample_result());
  const CaseResult whole = case_from_json(document["cases"][0]);
  EXPECT_EQ(whole.light_account.total, 8200u);
  EXPECT_EQ(whole.light_account.left_out, 5u);
  EXPECT_EQ(whole.notes.size(), 1u);
  EXPECT_EQ(whole.frames_without_surface, 1u);
  EXPECT_TRUE(whole.invalid);
  EXPECT_EQ(whole.invalid_note, "lost lights");
  for (json& one : document["cases"])
    for (const char* key : {"light_account", "notes", "frames_without_surface", "invalid", "invalid_note"})
      EXPECT_EQ(one.erase(key), 1u) << key;
  EXPECT_EQ(joined(result_violations(document)), "");
  const CaseResult old = case_from_json(document["cases"][0]);
  EXPECT_TRUE(old.notes.empty());
  EXPECT_FALSE(old.invalid);
}

TEST(ResultJson, KeepsTheRepeatsThatAreDone) {
  json document = to_json(sample_result());
  EXPECT_EQ(document["cases"][0]["cpu_ms"]["total"].size(), 2u);
  Result result = sample_result();
  result.cases[0].repeats_done = 0;
  document = to_json(result);
  EXPECT_EQ(document["cases"][0]["cpu_ms"]["total"], json::array());
  EXPECT_EQ(joined(result_violations(document)), "");
}

TEST(ResultJson, NumbersThatJsonDoesNotKnowAreNullWhereTheyMayBe) {
  Result result = sample_result();
  result.cases[0].accuracy = {{"psnr", std::numeric_limits<double>::infinity()},
                              {"list", {1.0, std::nan("")}}};
  result.context["calibration"]["noise"] = std::nan("");
  json document = to_json(result);
  EXPECT_EQ(document["cases"][0]["accuracy"], (json{{"psnr", nullptr}, {"list", {1.0, nullptr}}}));
  EXPECT_EQ(document["context"]["calibration"]["noise"], nullptr);
  EXPECT_EQ(joined(result_violations(document)), "");
}

TEST(ResultJson, TimesAndCountersThatAreNoNumbersAreProgrammerErrors) {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Result result = sample_result();
    result.cases[1].counters["nodes"] = {1, bad, 1};
    EXPECT_TRUE(contains(message_of<std::logic_error>([&] { to_json(result); }), "canyon-ideal: nodes"));
    result = sample_result();
    result.cases[0].gpu_ms.set("shade", 1, 1, bad);
    EXPECT_THROW(to_json(result), std::logic_error);
  }
}

TEST(ResultJson, RefusesToWriteWhatItsSchemaRefuses) {
  Folder folder;
  Result result = sample_result();
  result.cases[0].gpu_ms.set("shade", 0, 0, -1.0);
  EXPECT_THROW(write_result(result, folder / "result.json"), std::logic_error);
  EXPECT_TRUE(folder.names().empty());
}

TEST(ResultJson, TextThatIsNotUtf8DoesNotLoseTheRun) {
  Folder folder;
  Result result = sample_result();
  result.context["host"]["name"] = "bad \xff byte";
  write_result(result, folder / "result.json");
  EXPECT_EQ(read_result(folder / "result.json")["cases"].size(), 2u);
}

TEST(ResultSchema, EveryRequiredKeyIsMissed) {
  const json whole = to_json(sample_result());
  auto expect_missed = [&](const json::json_pointer& where) {
    for (const auto& [key, value] : whole.at(where).items()) {
      if (later_keys.contains(key)) continue;
      json cut = whole;
      cut.at(where).erase(key);
      std::string found = joined(result_violations(cut));
      EXPECT_TRUE(contains(found, key)) << where.to_string() << "/" << key << ": " << found;
    }
  };
  expect_missed(json::json_pointer(""));
  expect_missed(json::json_pointer("/context"));
  expect_missed(json::json_pointer("/context/device"));
  expect_missed(json::json_pointer("/cases/0"));
  expect_missed(json::json_pointer("/cases/0/files"));
  expect_missed(json::json_pointer("/cases/0/overlap"));
}

TEST(ResultSchema, SaysWhereAndWhat) {
  struct Mutation {
    const char* where;
    json value;
    const char* path;  // what the message must begin with
  };
  const Mutation mutations[] = {
      {"/cases/1/lights", "many", "$.cases[1].lights: "},
      {"/cases/0/lights", -1, "$.cases[0].lights: "},
      {"/cases/0/lights", 1.5, "$.cases[0].lights: "},
      {"/cases/0/lihgts", 5, "$.cases[0]: "},
      {"/cases/0/resolution", json::array({960}), "$.cases[0].resolution: "},
      {"/cases/0/resolution/1", 0, "$.cases[0].resolution[1]: "},
      {"/cases/0/gpu_ms/shade/1/2", "slow", "$.cases[0].gpu_ms.shade[1][2]: "},
      {"/cases/0/gpu_ms/shade/1/2", nullptr, "$.cases[0].gpu_ms.shade[1][2]: "},
      {"/cases/0/counters/lost", 0, "$.cases[0].counters.lost: "},
      {"/cases/0/timing_suspect", 0, "$.cases[0].timing_suspect: "},
      {"/context/device/type", "abacus", "$.context.device.type: "},
      {"/complete", "yes", "$.complete: "},
      {"/extra", 1, "$: "},
      {"/cases/0/id", "canyon-ideal", "$.cases[1].id: "},
      {"/cases/0/gpu_ms/shade", json::array({json::array({1, 2, 3})}),
       "$.cases[0].gpu_ms.shade: expected 2 repeats"},
      {"/cases/0/gpu_ms/shade/0", json::array({1, 2}), "$.cases[0].gpu_ms.shade[0]: expected 3 frames"},
      {"/cases/0/counters/lost", json::array({1}), "$.cases[0].counters.lost: expected 3 frames"},
      {"/cases/0/overlap/list_queue", "transfer", "$.cases[0].overlap.list_queue: "},
      {"/cases/0/overlap/ms/1/2", -1, "$.cases[0].overlap.ms[1][2]: "},
      {"/cases/0/overlap/ms", json::array({json::array({1, 2, 3})}),
       "$.cases[0].overlap.ms: expected 2 repeats"},
      {"/cases/1/overlap/ms/0", json::array({1}), "$.cases[1].overlap.ms[0]: expected 3 frames"},
  };
  for (const Mutation& mutation : mutations) {
    json document = to_json(sample_result());
    document[json::json_pointer(mutation.where)] = mutation.value;
    std::vector<std::string> found = result_violations(document);
    ASSERT_FALSE(found.empty()) << mutation.where;
    EXPECT_EQ(found.front().rfind(mutation.path, 0), 0u) << mutation.where << ": " << joined(found);
    for (const std::string& line : found) EXPECT_FALSE(contains(line, "\n")) << line;
  }
}

TEST(ResultSchema, AnOverlapNeedNotBeMeasuredNorBeThere) {
  Result result = sample_result();
  result.cases[0].overlap = {"compute", false, "the device has one queue", {}};
  json document = to_json(result);
  EXPECT_EQ(document["cases"][0]["overlap"]["ms"], json::array());
  document["cases"][1].erase("overlap");
  EXPECT_EQ(joined(result_violations(document)), "");
}

TEST(ResultSchema, AnIncompleteResultMayLackCounters) {
  Result result = sample_result();
  result.cases[0].counters["lost"] = {0};
  EXPECT_NE(joined(result_violations(to_json(result))), "");
  result.complete = false;
  EXPECT_EQ(joined(result_violations(to_json(result))), "");
}

TEST(SchemaViolations, AreAllReportedOnceEach) {
  json schema = {{"type", "object"},
                 {"properties", {{"a", {{"type", "integer"}}}, {"b", {{"type", "string"}}}}}};
  std::vector<std::string> found = schema_violations(schema, {{"a", "x"}, {"b", 1}});
  ASSERT_EQ(found.size(), 2u) << joined(found);
  EXPECT_TRUE(contains(joined(found), "$.a: "));
  EXPECT_TRUE(contains(joined(found), "$.b: "));
  EXPECT_TRUE(contains(joined(found), "found \"x\""));
  EXPECT_TRUE(schema_violations(schema, {{"a", 1}, {"b", "y"}}).empty());
}

TEST(ReadResult, NamesFileAndPlace) {
  Folder folder;
  auto error_for = [&](const std::string& text) {
    write_file(folder / "r.json", text);
    std::string message = message_of<UsageError>([&] { read_result(folder / "r.json"); });
    EXPECT_TRUE(contains(message, "r.json: ")) << message;
    return message;
  };
  EXPECT_TRUE(contains(error_for("{\"schema\": 1,"), "expected JSON"));
  EXPECT_TRUE(contains(error_for(""), "expected JSON"));
  EXPECT_TRUE(contains(error_for("[]"), "$: "));
  EXPECT_TRUE(contains(error_for("{\"schema\": 2}"), "$.schema: expected version 1, found 2"));
  json document = to_json(sample_result());
  document["cases"][1]["frames"][2] = "three";
  EXPECT_TRUE(contains(error_for(document.dump()), "$.cases[1].frames[2]: "));
  EXPECT_TRUE(contains(error_for(std::string(100000, '[')), "expected JSON"));
  EXPECT_TRUE(contains(message_of<UsageError>([] { read_result("/nowhere/r.json"); }), "/nowhere/r.json"));
}

TEST(WriteResult, UnwritableIsASystemError) {
  EXPECT_THROW(write_result(sample_result(), "/nowhere/result.json"), SystemError);
}

}  // namespace
