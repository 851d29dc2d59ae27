// A folder that one process at a time writes into.
#pragma once

#include <filesystem>

namespace ml {

// Holds the folder from its construction to its end. The lock belongs to the open file and not to the file's
// being there: the kernel lets go of it when the process ends, however it ends, so that none is ever stale.
class FolderLock {
 public:
  // `folder` must be there; NAME in it is the lock's file, which is removed in the end. Throws SystemError
  // when another process (or another lock of this one) holds the folder, and when it cannot be locked.
  FolderLock(const std::filesystem::path& folder, const std::filesystem::path& name);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace ml
