// Signals end the program in time, whatever it is in, and keep what was measured.
#include "harness/bench/interruption.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "harness/base/error.h"
#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

using nlohmann::json;
using std::chrono::hours;
using std::chrono::milliseconds;

constexpr int code = static_cast<int>(ExitCode::interrupted);

// A signal, and work that never looks whether there was one.
void signalled(milliseconds grace, int signals) {
  watch_for_interruption(grace);
  for (int i = 0; i < signals; ++i) {
    kill(getpid(), i ? SIGTERM : SIGINT);
    while (!interrupted()) std::this_thread::yield();
  }
  while (true) pause();
}

TEST(Interruption, EndsTheProcessWhenTheGraceIsOver) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(signalled(milliseconds(1), 1), testing::ExitedWithCode(code), "interrupted");
}

TEST(Interruption, ASecondSignalEndsTheProcessAtOnce) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(signalled(hours(100), 2), testing::ExitedWithCode(code), "interrupted");
}

TEST(Interruption, IsObeyedWhileADriverCompiles) {
  for (int number : {SIGINT, SIGTERM}) {
    Folder folder;
    // The second setup has programs of its own.
    const std::string config =
        write_config(folder, small_config({{"sweep", {{"lights.spot_fraction", {0.0, 0.5}}}}}));
    const std::filesystem::path result = folder / "out" / "result.json", mark = folder / "mark";
    ProcessOptions options;
    options.environment = {{"VK_ADD_LAYER_PATH", ML_LAYER_FOLDER},
                           {"VK_INSTANCE_LAYERS", "VK_LAYER_ML_stuck"},
                           {"ML_STUCK_AFTER", result.string()},
                           {"ML_STUCK_MARK", mark.string()}};
    options.watch = [&] { return std::filesystem::exists(mark) ? number : 0; };
    const Outcome outcome =
        manylights({"run", config, "--out", (folder / "out").string(), "--quiet"}, options);
    expect_error(outcome, code, {"interrupted", "kept"});
    const json document = valid_result(folder / "out");
    EXPECT_EQ(document["complete"], false);
    EXPECT_FALSE(document["cases"].empty());
    // Nobody holds the folder any more.
    const Outcome resumed =
        manylights({"run", config, "--out", (folder / "out").string(), "--quiet", "--resume"});
    EXPECT_EQ(resumed.code, 0) << resumed.error;
    EXPECT_EQ(valid_result(folder / "out")["complete"], true);
  }
}

}  // namespace
}  // namespace ml::test
