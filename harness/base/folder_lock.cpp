#include "harness/base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "harness/base/error.h"

namespace ml {
namespace {

// Whether the open file is still the one of that name: its holder before may have removed it.
bool is_there(int descriptor, const std::filesystem::path& file) {
  struct stat open_one {
  }, named{};
  return fstat(descriptor, &open_one) == 0 && stat(file.c_str(), &named) == 0 &&
         open_one.st_dev == named.st_dev && open_one.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::filesystem::path& name)
    : file_(folder / name) {
  while (descriptor_ < 0) {
    const int descriptor = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw SystemError("cannot lock " + folder.string() + ": " + file_.string() + ": " +
                        std::strerror(errno));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int why = errno;
      close(descriptor);
      if (why == EINTR) continue;
      if (why == EWOULDBLOCK)
        throw SystemError(folder.string() +
                          ": another run is writing into this folder; choose another with --out");
      throw SystemError("cannot lock " + folder.string() + ": " + std::strerror(why));
    }
    if (is_there(descriptor, file_))
      descriptor_ = descriptor;
    else
      close(descriptor);
  }
}

FolderLock::~FolderLock() {
  // While it is still held, so that nobody can have made it his own.
  unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace ml
