// SPDX-License-Identifier: BSD-3-Clause
// Who writes its results into a folder: one process at a time. The lock leaves no file behind, and goes with
// its process, however that ends.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace sslam::cli {

class FolderLock {
 public:
  // Nothing where another process has it.
  [[nodiscard]] static std::optional<FolderLock> take(const std::filesystem::path& folder);
  // The same for somebody who cannot go on without. Throws Error.
  [[nodiscard]] static FolderLock demand(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int file) noexcept : file_(file) {}
  int file_;  // of the folder; -1: its file system knows no locks
};

}  // namespace sslam::cli
