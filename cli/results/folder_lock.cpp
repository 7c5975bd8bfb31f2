// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "sslam/core/error.hpp"

namespace sslam::cli {

std::optional<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return FolderLock(-1);  // whoever writes there will hear why that cannot be
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return FolderLock(file);
  const bool taken = errno == EWOULDBLOCK;
  close(file);
  if (taken) return std::nullopt;
  return FolderLock(-1);
}

FolderLock FolderLock::demand(const std::filesystem::path& folder) {
  std::optional<FolderLock> lock = take(folder);
  if (!lock)
    throw Error(
        folder.string() +
        ": another sslam is writing its results into this folder; wait until it ends, or choose another "
        "folder with --out");
  return std::move(*lock);
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace sslam::cli
