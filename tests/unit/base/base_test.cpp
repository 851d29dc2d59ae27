// Errors, files, random numbers, spans and parallel loops.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/base/folder_lock.h"
#include "harness/base/parallel.h"
#include "harness/base/random.h"
#include "harness/base/spans.h"

namespace ml {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("manylights-base-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  size_t entries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(Files, AFolderIsLockedByOneAtATime) {
  for (int round = 0; round < 3; ++round) {
    FolderLock lock(folder_, "lock");
    EXPECT_THROW(FolderLock(folder_, "lock"), SystemError);
    FolderLock another(folder_, "another");
  }
  EXPECT_EQ(entries(), 0u);
  // A file that a process left behind when it was killed holds nobody up.
  std::ofstream(folder_ / "lock").put('x');
  FolderLock lock(folder_, "lock");
  EXPECT_THROW(FolderLock(folder_ / "missing", "lock"), SystemError);
}

TEST(Error, IsOneLineWhateverItIsMadeOf) {
  UsageError error("a\nb\tc\rd\x01" + std::string(10000, 'x'));
  std::string text = error.what();
  EXPECT_TRUE(
      std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }));
  EXPECT_LT(text.size(), 500u);
  EXPECT_EQ(error.code(), ExitCode::usage);
}

TEST(NearestName, FindsMisspellingsAndNothingElse) {
  const std::vector<std::string> known{"lights", "camera", "resolution", "light_data"};
  EXPECT_EQ(nearest_name("ligths", known), "lights");
  EXPECT_EQ(nearest_name("Camera", known), "camera");
  EXPECT_EQ(nearest_name("light-data", known), "light_data");
  EXPECT_EQ(nearest_name("xyzzy", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_NE(suggestion("xyzzy", known).find("known are lights, camera"), std::string::npos);
}

TEST_F(Files, AreReadAsTheyWereWritten) {
  std::string text = "one\ntwo\0three";
  write_file(folder_ / "a", std::string_view(text));
  EXPECT_EQ(read_text_file(folder_ / "a"), text);
  write_file(folder_ / "a", std::string_view("short"));
  EXPECT_EQ(read_text_file(folder_ / "a"), "short");
  EXPECT_EQ(entries(), 1u) << "temporary files are left";
}

TEST_F(Files, FailingWritesLeaveTheOldFileAndNothingElse) {
  write_file(folder_ / "a", std::string_view("old"));
  // A file size limit stands in for a full disk: the write fails with an error code once its signal is
  // ignored.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(write_file(folder_ / "a", std::string(100000, 'x')), SystemError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(read_text_file(folder_ / "a"), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, MissingAndImpossibleOnesAreErrors) {
  EXPECT_THROW(read_file(folder_ / "none"), UsageError);
  EXPECT_THROW(read_file(folder_), UsageError);
  EXPECT_THROW(write_file(folder_ / "no" / "such" / "folder", std::string_view("x")), SystemError);
  write_file(folder_ / "file", std::string_view("x"));
  EXPECT_THROW(make_output_directory(folder_ / "file"), SystemError);
  EXPECT_THROW(make_output_directory(folder_ / "file" / "below"), SystemError);
  EXPECT_THROW(read_file(folder_ / "file", 0), UsageError);
  make_output_directory(folder_ / "new" / "one");
  EXPECT_TRUE(fs::is_empty(folder_ / "new" / "one"));
}

TEST(Random, UnitFloatsStayBelowOne) {
  EXPECT_EQ(unit_float(0), 0.0f);
  EXPECT_LT(unit_float(0xffffffffu), 1.0f);
}

TEST(Random, HashesOfNeighboursLookIndependent) {
  // Each output bit of the hash of consecutive numbers is set about half of the time, and flips for half of
  // the pairs.
  constexpr uint32_t count = 1 << 16;
  for (uint32_t bit = 0; bit < 32; ++bit) {
    uint32_t set = 0, flips = 0;
    for (uint32_t i = 0; i < count; ++i) {
      set += hash_u32(i) >> bit & 1;
      flips += (hash_u32(i) ^ hash_u32(i + 1)) >> bit & 1;
    }
    EXPECT_NEAR(set, count / 2, 1500) << bit;
    EXPECT_NEAR(flips, count / 2, 1500) << bit;
  }
}

TEST(Random, BelowCoversItsRange) {
  Random random(7);
  std::set<uint32_t> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(random.below(10));
  EXPECT_EQ(seen.size(), 10u);
  EXPECT_EQ(*seen.rbegin(), 9u);
}

TEST(Spans, SumByName) {
  Spans spans;
  spans.add("a", 1);
  spans.add("b", 2);
  spans.add("a", 3);
  EXPECT_EQ(spans.sums().at("a"), 4);
  spans.clear();
  EXPECT_EQ(spans.sums().at("b"), 0);
}

TEST(Threads, VisitEachItemOnceForAnyCount) {
  for (unsigned count : {1u, 2u, 7u}) {
    Threads threads(count);
    std::vector<std::atomic<int>> visits(1000);
    threads.for_each(visits.size(), [&](size_t i) { ++visits[i]; });
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; })) << count;
  }
}

}  // namespace
}  // namespace ml
