#include "tests/end_to_end/program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "harness/output/result.h"

namespace ml::test {
namespace {

// What a child does before it becomes the program; only what is allowed between fork and exec.
[[noreturn]] void become(const std::vector<char*>& arguments, const ProcessOptions& options, int out,
                         int error) {
  dup2(out, STDOUT_FILENO);
  dup2(error, STDERR_FILENO);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(127);
  if (options.largest_file) {
    // Without the signal a write beyond the limit fails with EFBIG, as a full disk fails with ENOSPC.
    signal(SIGXFSZ, SIG_IGN);
    rlimit limit{options.largest_file, options.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  execvp(arguments[0], arguments.data());
  _exit(127);
}

// Appends what can be read now; false at the end.
bool drain(int descriptor, std::string& text) {
  std::array<char, 4096> bytes;
  const ssize_t count = read(descriptor, bytes.data(), bytes.size());
  if (count > 0) text.append(bytes.data(), static_cast<size_t>(count));
  return count > 0;
}

}  // namespace

Outcome run_process(const std::vector<std::string>& command, const ProcessOptions& options) {
  std::vector<std::string> copy = command;
  std::vector<char*> arguments;
  for (std::string& argument : copy) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  int out[2], error[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(error, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) become(arguments, options, out[1], error[1]);
  close(out[1]);
  close(error[1]);

  Outcome outcome;
  bool out_open = true, error_open = true, told = false;
  while (out_open || error_open) {
    pollfd waits[2] = {{out_open ? out[0] : -1, POLLIN, 0}, {error_open ? error[0] : -1, POLLIN, 0}};
    poll(waits, 2, options.watch && !told ? 3 : -1);
    if (waits[0].revents) out_open = drain(out[0], outcome.out);
    if (waits[1].revents) error_open = drain(error[0], outcome.error);
    if (options.watch && !told)
      if (int number = options.watch()) {
        kill(child, number);
        told = true;
      }
  }
  close(out[0]);
  close(error[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status))
    outcome.code = WEXITSTATUS(status);
  else
    outcome.signal = WTERMSIG(status);
  return outcome;
}

Outcome manylights(std::vector<std::string> arguments, const ProcessOptions& options) {
  arguments.insert(arguments.begin(), ML_PROGRAM);
  return run_process(arguments, options);
}

void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.code, code) << outcome.error;
  EXPECT_TRUE(outcome.error.starts_with("manylights: ")) << outcome.error;
  EXPECT_TRUE(outcome.error.find('\n') == outcome.error.size() - 1) << "not exactly one line:\n"
                                                                    << outcome.error;
  for (const std::string& part : parts)
    EXPECT_NE(outcome.error.find(part), std::string::npos) << '"' << part << "\" in " << outcome.error;
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "manylights-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

nlohmann::json small_config(const nlohmann::json& changes) {
  nlohmann::json config = {{"name", "small"},
                           {"scene", "plane"},
                           {"lights", {{"count", 40}, {"seed", 3}}},
                           {"camera", {{"frames", 2}}},
                           {"resolution", {48, 27}},
                           {"algorithms", {"ideal", "clustered"}},
                           {"measure", {{"warmup", 0}, {"repeats", 1}}},
                           {"outputs", {{"trace", false}}}};
  config.update(changes);
  return config;
}

nlohmann::json all_shapes(uint32_t count) {
  return {{"count", count},          {"placement", "volume"}, {"spot_fraction", 0.2},
          {"capsule_fraction", 0.2}, {"wedge_fraction", 0.2}, {"box_fraction", 0.2}};
}

std::string write_config(const Folder& folder, const nlohmann::json& config, const std::string& name) {
  write_text(folder / name, config.dump());
  return (folder / name).string();
}

nlohmann::json valid_result(const std::filesystem::path& folder) {
  nlohmann::json document = nlohmann::json::parse(text_of(folder / "result.json"), nullptr, false);
  EXPECT_FALSE(document.is_discarded()) << folder << " has no result.json that is JSON";
  if (document.is_discarded()) return nlohmann::json::object();
  for (const std::string& violation : result_violations(document)) ADD_FAILURE() << violation;
  return document;
}

}  // namespace ml::test
