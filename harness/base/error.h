// The errors that manylights reports, and the exit codes they become.
//
// Programmer errors are asserted; what a user, a file, a device or a disk did wrong is thrown as ml::Error,
// caught once in main() and printed as one line on stderr.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ml {

// Documented exit codes of the program.
enum class ExitCode : int {
  done = 0,
  claim_failed = 1,  // a proof failed or a regression was found
  usage = 2,         // arguments, configuration or scene files
  system = 3,        // device, driver or file system
  interrupted = 4,   // stopped by a signal; what was measured is kept
};

// An error with a one-line message that names the file, the place in it, what was expected and what was
// found.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message);
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Wrong arguments, configuration or scene file: exit code 2.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

// Device, driver or file system: exit code 3.
class SystemError : public Error {
 public:
  explicit SystemError(const std::string& message) : Error(ExitCode::system, message) {}
};

// The work was stopped from outside (SIGINT, SIGTERM): exit code 4.
class Interrupted : public Error {
 public:
  explicit Interrupted(const std::string& message) : Error(ExitCode::interrupted, message) {}
};

// `text` with control characters and line breaks replaced by spaces, cut at 400 characters: an error stays
// one line, whatever a file put into it.
std::string one_line(std::string_view text);

// The known name nearest to `name` by edit distance, or "" when none is near (more than a third of the
// letters differ).
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

// ", did you mean 'x'?" for the nearest known name, else ", known are a, b, c".
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace ml
