#include "harness/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "harness/base/error.h"

namespace ml {
namespace {

std::string reason() {
  return std::strerror(errno);
}

// Closes and, until keep() is called, removes the temporary file.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : path_(target.string() + ".XXXXXX") {
    descriptor_ = mkstemp(path_.data());
    if (descriptor_ < 0) throw SystemError("cannot write " + target.string() + ": " + reason());
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!kept_) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write_all(std::span<const std::byte> bytes, const std::filesystem::path& target) const {
    while (!bytes.empty()) {
      ssize_t written = write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) throw SystemError("cannot write " + target.string() + ": " + reason());
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
  }
  void rename_to(const std::filesystem::path& target) {
    // mkstemp makes files for the owner alone; give the file the permissions that an ordinary one would have.
    mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor_, 0666 & ~mask);
    int flushed = fsync(descriptor_);
    int closed = close(descriptor_);
    descriptor_ = -1;
    if (flushed != 0 || closed != 0 || rename(path_.c_str(), target.c_str()) != 0)
      throw SystemError("cannot write " + target.string() + ": " + reason());
    kept_ = true;
  }

 private:
  std::string path_;
  int descriptor_ = -1;
  bool kept_ = false;
};

// A rename is durable only once its directory is on the disk.
void flush_directory(const std::filesystem::path& directory) {
  int descriptor = open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

template <typename Container>
Container read_whole(const std::filesystem::path& path, size_t limit) {
  std::error_code error;
  auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw UsageError(path.string() + ": no such file");
  if (!std::filesystem::is_regular_file(status)) throw UsageError(path.string() + ": not a regular file");
  auto size = std::filesystem::file_size(path, error);
  if (error) throw UsageError(path.string() + ": cannot read it: " + error.message());
  if (size > limit)
    throw UsageError(path.string() + ": " + std::to_string(size) + " bytes, more than the limit of " +
                     std::to_string(limit));
  std::ifstream stream(path, std::ios::binary);
  Container content(size, typename Container::value_type{});
  stream.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(size));
  if (!stream || static_cast<size_t>(stream.gcount()) != size)
    throw UsageError(path.string() + ": cannot read it");
  return content;
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, size_t limit) {
  return read_whole<std::vector<std::byte>>(path, limit);
}

std::string read_text_file(const std::filesystem::path& path, size_t limit) {
  return read_whole<std::string>(path, limit);
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  TemporaryFile file(path);
  file.write_all(bytes, path);
  file.rename_to(path);
  flush_directory(path.parent_path());
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(path, std::as_bytes(std::span(text)));
}

void make_output_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw SystemError("cannot make the output directory " + path.string() + ": " + error.message());
  if (!std::filesystem::is_directory(path, error))
    throw SystemError("the output " + path.string() + " is not a directory");
  TemporaryFile probe(path / "probe");
}

}  // namespace ml
