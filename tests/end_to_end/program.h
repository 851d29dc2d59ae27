// The program as its users run it: a process with arguments, an exit code and two streams.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ml::test {

struct Outcome {
  int code = -1;   // exit code; -1 when a signal ended it
  int signal = 0;  // that signal
  std::string out, error;
};

struct ProcessOptions {
  std::vector<std::pair<std::string, std::string>> environment;  // set before it starts
  std::filesystem::path folder;                                  // working directory; empty: the test's own
  uint64_t largest_file = 0;  // bytes a file may have, then writing fails; 0: no limit
  // Called every few milliseconds while it runs; a signal number is sent to it once.
  std::function<int()> watch;
};

// Runs an executable (searched in PATH) to its end.
Outcome run_process(const std::vector<std::string>& command, const ProcessOptions& options = {});
// Runs manylights.
Outcome manylights(std::vector<std::string> arguments, const ProcessOptions& options = {});

// Expects this exit code and exactly one line on stderr that begins with "manylights: " and holds all of
// these parts.
void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& parts);

// A folder of the test's own, empty at first and removed afterwards.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string text_of(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

// A small configuration: the plane with 40 lights at 48x27, 2 frames, 1 repeat, ideal and clustered;
// `changes` replace or add keys.
nlohmann::json small_config(const nlohmann::json& changes = nlohmann::json::object());
// "lights" of a configuration: all shapes, spread over the volume.
nlohmann::json all_shapes(uint32_t count);
// Writes it into the folder, returns the file's name.
std::string write_config(const Folder& folder, const nlohmann::json& config,
                         const std::string& name = "config.json");

// The result of a run, valid by its schema and its own rules.
nlohmann::json valid_result(const std::filesystem::path& folder);

}  // namespace ml::test
