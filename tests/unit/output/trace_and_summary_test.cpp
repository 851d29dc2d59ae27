#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "files.h"
#include "harness/output/result.h"

namespace {

using namespace ml;
using nlohmann::json;

TEST(Trace, IsWhatTraceViewersRead) {
  Folder folder;
  std::vector<TraceEvent> events{{"prepare", "cpu", 1.5, 0.25, {{"case", "a"}, {"frame", "3"}}},
                                 {"shade", "gpu", 2, 59.000123, {}}};
  write_trace(events, "llvmpipe, cpu", folder / "trace.json");
  json trace = json::parse(read_text_file(folder / "trace.json"));
  EXPECT_EQ(trace["otherData"]["device"], "llvmpipe, cpu");
  std::map<int, std::string> thread_names;
  std::vector<json> spans;
  for (const json& event : trace["traceEvents"]) {
    EXPECT_TRUE(event.contains("pid") && event.contains("tid") && event.contains("ph") &&
                event.contains("name"))
        << event;
    if (event["name"] == "thread_name") thread_names[event["tid"]] = event["args"]["name"];
    if (event["ph"] == "X") spans.push_back(event);
  }
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[0]["ts"], 1500.0);
  EXPECT_EQ(spans[0]["dur"], 250.0);
  EXPECT_EQ(spans[0]["args"], (json{{"case", "a"}, {"frame", "3"}}));
  EXPECT_EQ(spans[1]["dur"], 59000.123);
  EXPECT_EQ(thread_names[spans[0]["tid"]], "cpu");
  EXPECT_EQ(thread_names[spans[1]["tid"]], "gpu (llvmpipe, cpu)")
      << "the device's kind stands beside its times";
}

TEST(Trace, IsValidWithoutEventsAndTheSameEveryTime) {
  Folder folder;
  write_trace({}, "", folder / "a.json");
  EXPECT_TRUE(json::parse(read_text_file(folder / "a.json"))["traceEvents"].is_array());
  std::vector<TraceEvent> events{{"a \"quoted\"\n\xff", "other", 0.1, 0.2, {{"z", "1"}, {"a", "2"}}}};
  write_trace(events, "d", folder / "b.json");
  write_trace(events, "d", folder / "c.json");
  EXPECT_EQ(read_text_file(folder / "b.json"), read_text_file(folder / "c.json"));
  EXPECT_TRUE(json::accept(read_text_file(folder / "b.json")));
}

CaseResult make_case(const std::string& algorithm, double shade) {
  CaseResult one;
  one.id = algorithm;
  one.algorithm = algorithm;
  one.scene = "canyon";
  one.parameters = {{"tile", 24}, {"slices", 16}};
  one.lights = 8192;
  one.width = 960, one.height = 540;
  one.frames = {0, 1};
  one.repeats_done = 2;
  one.cpu_ms = SampleTable(3, 2), one.gpu_ms = SampleTable(3, 2);
  for (uint32_t repeat = 0; repeat < 3; ++repeat)
    for (uint32_t frame = 0; frame < 2; ++frame) {
      // The third lap is not done: its times must appear nowhere.
      one.cpu_ms.set("total", repeat, frame, repeat < 2 ? 1.25 : 7777);
      one.gpu_ms.set("shade", repeat, frame, repeat < 2 ? shade : 7777);
      one.gpu_ms.set("total", repeat, frame, repeat < 2 ? shade + 1 : 7777);
    }
  one.counters = {{"tested", {10, 12}}, {"contributing", {2, 3}},     {"listed", {9, 11}},
                  {"nodes", {0, 0}},    {"list_bytes", {2048, 2048}}, {"lost", {0, 3}}};
  return one;
}

Result make_result(const std::string& device_type) {
  Result result;
  result.complete = true;
  result.context["device"] = {{"name", "llvmpipe"}, {"type", device_type}, {"driver", "Mesa 22"}};
  result.cases = {make_case("clustered", 40), make_case("ideal", 20)};
  return result;
}

std::string line_with(const std::string& table, const std::string& word) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(word, 0) == 0) return line;
  ADD_FAILURE() << "no line begins with " << word << " in\n" << table;
  return "";
}

TEST(Summary, SoftwareDriverTimesArePassedOffAsNothingElse) {
  std::string table = summary_table(make_result("cpu"));
  EXPECT_TRUE(contains(table, "ms (cpu device)"));
  EXPECT_TRUE(contains(table, "CPU time"));
  std::string headings = table.substr(0, table.find("clustered"));
  EXPECT_FALSE(contains(headings, "gpu") || contains(headings, "GPU")) << headings;
  EXPECT_TRUE(contains(summary_table(make_result("discrete")), "ms (discrete gpu)"));
  EXPECT_FALSE(contains(summary_table(make_result("discrete")), "CPU time"));
  EXPECT_TRUE(contains(table, "llvmpipe, Mesa 22 (cpu)"));
}

TEST(Summary, ShowsMediansOfTheLapsThatAreDone) {
  std::string table = summary_table(make_result("cpu"));
  std::string line = line_with(table, "clustered");
  for (const char* part : {"8192", "960x540", "1.250 (1.250..1.250)", "40.00 (40.00..40.00)", "41.00",
                           "11.00", "2.50", "10.00", "2.0 KiB", " 3", "0.50"})
    EXPECT_TRUE(contains(line, part)) << part << " in " << line;
  EXPECT_FALSE(contains(table, "7777"));
  EXPECT_TRUE(contains(line_with(table, "ideal"), "1.00"));
}

TEST(Summary, CullIsAllThatTheDeviceDoesBeforeShading) {
  Result result = make_result("cpu");
  const std::string none = line_with(summary_table(result), "clustered");
  for (uint32_t repeat = 0; repeat < 2; ++repeat)
    for (uint32_t frame = 0; frame < 2; ++frame) {
      result.cases[0].gpu_ms.set("bounds", repeat, frame, 3.25);
      result.cases[0].gpu_ms.set("lists", repeat, frame, 13.5);
      result.cases[0].gpu_ms.set("transfer", repeat, frame, 100);
      // Parts of passes, whose time is in theirs.
      result.cases[0].gpu_ms.set("lists/coarse", repeat, frame, 5);
      result.cases[0].gpu_ms.set("shade/trace", repeat, frame, 5);
    }
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), " 16.75 "));
  EXPECT_FALSE(contains(none, "16.75"));
  EXPECT_TRUE(contains(line_with(summary_table(result), "ideal"), " - "));
}

TEST(Summary, ShadingIsTheDeferredAndTheForwardPass) {
  Result result = make_result("cpu");
  for (uint32_t repeat = 0; repeat < 2; ++repeat)
    for (uint32_t frame = 0; frame < 2; ++frame) result.cases[0].gpu_ms.set("forward", repeat, frame, 100.5);
  const double shade = result.cases[0].gpu_ms.tables().at("shade")[0][0];
  const std::string line = line_with(summary_table(result), "clustered");
  EXPECT_TRUE(contains(line, fmt::format(" {:.1f} ", shade + 100.5))) << line;
  EXPECT_TRUE(contains(line, " - ")) << "the forward pass is no list building: " << line;
}

TEST(Summary, IntervalsAreOfTheLapsAndNotThereForOne) {
  Result result = make_result("cpu");
  for (uint32_t frame = 0; frame < 2; ++frame) result.cases[0].gpu_ms.set("shade", 1, frame, 50);
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), "45.00 (40.00..50.00)"));
  EXPECT_TRUE(contains(summary_table(result), "n = 2 repeats"));
  EXPECT_FALSE(contains(summary_table(result), "95 %"));
  result.cases[0].repeats_done = 1;
  const std::string line = line_with(summary_table(result), "clustered");
  EXPECT_TRUE(contains(line, " 40.00 "));
  EXPECT_FALSE(contains(line, "(") || contains(line, "["));
}

// Of five repeats and more, 95 %.
TEST(Summary, IntervalsAreClaimedFromFiveRepeatsOn) {
  Result result = make_result("cpu");
  for (CaseResult& one : result.cases) {
    one.repeats_done = 6;
    one.cpu_ms = one.gpu_ms = SampleTable(6, 2);
    for (uint32_t repeat = 0; repeat < 6; ++repeat)
      for (uint32_t frame = 0; frame < 2; ++frame) {
        one.cpu_ms.set("total", repeat, frame, 1.25);
        one.gpu_ms.set("shade", repeat, frame, one.algorithm == "ideal" ? 20 : 40);
      }
  }
  const std::string table = summary_table(result);
  EXPECT_TRUE(contains(line_with(table, "clustered"), "40.00 [40.00 40.00]")) << table;
  EXPECT_TRUE(contains(line_with(table, "clustered"), "0.50 [0.50 0.50]")) << table;
  EXPECT_TRUE(contains(table, "[95 % interval]"));
  EXPECT_FALSE(contains(table, "n = "));
}

// Laps in which the machine is slow are slow for both: the ratio does not see it.
TEST(Summary, EfficiencyIsPairedByLap) {
  Result result = make_result("cpu");
  for (uint32_t repeat = 0; repeat < 2; ++repeat)
    for (uint32_t frame = 0; frame < 2; ++frame) {
      const double drift = 1 + repeat + 4 * frame;
      result.cases[0].gpu_ms.set("shade", repeat, frame, 40 * drift);
      result.cases[1].gpu_ms.set("shade", repeat, frame, 30 * drift);
    }
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), "0.75 (0.75..0.75)"));
}

// `ideal` goes pixel by pixel: where others go together it is no bound, and the table says so.
TEST(Summary, SaysWhereIdealIsNoBound) {
  Result result = make_result("cpu");
  EXPECT_FALSE(contains(summary_table(result), "no bound"));
  for (uint32_t repeat = 0; repeat < 2; ++repeat)
    for (uint32_t frame = 0; frame < 2; ++frame) result.cases[0].gpu_ms.set("shade", repeat, frame, 19);
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), "1.05 (1.05..1.05)"));
  EXPECT_TRUE(contains(summary_table(result), "no bound"));
}

// Of two ways to walk the one that is faster over the whole run counts, for both and for all others.
TEST(Summary, TheFasterIdealCounts) {
  Result result = make_result("cpu");
  EXPECT_FALSE(contains(summary_table(result), "walk="));
  result.cases.push_back(make_case("ideal", 10));
  result.cases[1].parameters["walk"] = "pixel";
  result.cases[2].parameters["walk"] = "subgroup";
  std::string table = summary_table(result);
  EXPECT_TRUE(contains(line_with(table, "clustered"), "0.25 (0.25..0.25)")) << table;
  EXPECT_TRUE(contains(line_with(table, "ideal walk=pixel"), "0.50 (0.50..0.50)")) << table;
  EXPECT_TRUE(contains(line_with(table, "ideal walk=subgroup"), " 1.00 ")) << table;
  EXPECT_TRUE(contains(table, "ideal with walk=subgroup, the faster / of this")) << table;
  // One frame in which it is slower changes nothing.
  for (uint32_t repeat = 0; repeat < 2; ++repeat) result.cases[2].gpu_ms.set("shade", repeat, 0, 22);
  EXPECT_TRUE(contains(summary_table(result), "walk=subgroup, the faster"));
  for (uint32_t repeat = 0; repeat < 2; ++repeat) result.cases[2].gpu_ms.set("shade", repeat, 1, 22);
  table = summary_table(result);
  EXPECT_TRUE(contains(table, "walk=pixel, the faster")) << table;
  EXPECT_TRUE(contains(line_with(table, "clustered"), "0.50 (0.50..0.50)")) << table;
  // The same way twice: nobody knows which is meant.
  result.cases.push_back(result.cases[2]);
  EXPECT_FALSE(contains(line_with(summary_table(result), "clustered"), "0.50"));
}

TEST(Summary, MarksInvalidCases) {
  Result result = make_result("cpu");
  EXPECT_FALSE(contains(summary_table(result), "invalid"));
  result.cases[0].invalid = true;
  const std::string table = summary_table(result);
  EXPECT_TRUE(contains(line_with(table, "clustered"), "clustered !!"));
  EXPECT_TRUE(contains(table, "invalid_note"));
}

TEST(Summary, NodesStandWhereThereAreTrees) {
  Result result = make_result("cpu");
  const std::string none = line_with(summary_table(result), "clustered");
  result.cases[0].counters["nodes"] = {13, 14.5};
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), " 13.75 "));
  EXPECT_FALSE(contains(none, " 0.00"));
}

// A run that was resumed shows all of its cases, and those of the earlier run with the same words.
TEST(Summary, ShowsEarlierCasesAsItShowsItsOwn) {
  const Result whole = make_result("cpu");
  Result resumed = whole;
  resumed.cases.erase(resumed.cases.begin());
  resumed.earlier_cases.push_back(to_json(whole)["cases"][0]);
  EXPECT_EQ(summary_table(resumed), summary_table(whole));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Summary, FoldsToTheWidthOfATerminalAndLeavesNothingOut) {
  Result result = make_result("cpu");
  result.cases.push_back(make_case("clustered", 30));
  result.cases.back().lights = 65536;
  const std::string whole = summary_table(result);
  EXPECT_EQ(summary_table(result, 1000), whole);
  const std::string line = line_with(whole, "clustered");
  for (size_t width : {150u, 120u, 80u, 60u, 50u}) {
    const std::string folded = summary_table(result, width);
    const std::string table = folded.substr(0, folded.find("device: "));
    for (const std::string& each : lines_of(table)) EXPECT_LE(each.size(), width) << each;
    std::istringstream words(line);
    for (std::string word; words >> word;) EXPECT_TRUE(contains(table, word)) << word << " in\n" << table;
    // What tells the two lines of `clustered` apart stands above each.
    EXPECT_LT(table.find("lights 8192"), table.find("lights 65536")) << table;
    EXPECT_TRUE(contains(table, "lights 65536")) << table;
  }
  // One column needs more than there is: it gets it.
  EXPECT_TRUE(contains(summary_table(result, 1), "1.250 (1.250..1.250)"));
}

TEST(Summary, EfficiencyNeedsTheIdealOfTheSameSetup) {
  Result result = make_result("cpu");
  result.cases[1].lights = 16384;
  EXPECT_FALSE(contains(line_with(summary_table(result), "clustered"), "0.50"));
}

TEST(Summary, ParametersAppearWhereTheyTellCasesApart) {
  Result result = make_result("cpu");
  EXPECT_FALSE(contains(summary_table(result), "tile="));
  result.cases.push_back(make_case("clustered", 30));
  result.cases.back().parameters["tile"] = 48;
  std::string table = summary_table(result);
  EXPECT_TRUE(contains(table, "clustered tile=24"));
  EXPECT_TRUE(contains(table, "clustered tile=48"));
  EXPECT_FALSE(contains(table, "slices="));
}

TEST(Summary, ColumnsAlign) {
  Result result = make_result("cpu");
  result.cases[0].lights = 1;
  std::string table = summary_table(result);
  size_t end = std::string::npos;
  for (const char* word : {"algorithm", "clustered", "ideal"}) {
    std::string line = line_with(table, word);
    size_t here = word == std::string("algorithm") ? line.find("lost") + 4 : line.find_last_not_of(' ') + 1;
    if (end == std::string::npos) end = here;
    EXPECT_EQ(here, end) << table;
  }
}

TEST(Summary, MarksSuspectTimesAndIncompleteRuns) {
  Result result = make_result("cpu");
  EXPECT_FALSE(contains(summary_table(result), "suspect"));
  result.cases[0].timing_suspect = true;
  result.complete = false;
  std::string table = summary_table(result);
  EXPECT_TRUE(contains(line_with(table, "clustered"), "clustered !  "));
  EXPECT_FALSE(contains(line_with(table, "ideal"), "!"));
  EXPECT_TRUE(contains(table, "suspect"));
  EXPECT_TRUE(contains(table, "not complete"));
}

TEST(Summary, WorksWithNothingToShow) {
  EXPECT_TRUE(contains(summary_table(Result{}), "algorithm"));
  Result result;
  result.cases.resize(1);
  result.cases[0].algorithm = "clustered";
  EXPECT_TRUE(contains(line_with(summary_table(result), "clustered"), "-"));
}

}  // namespace
