// SPDX-License-Identifier: BSD-3-Clause
// A file that appears under its name only when it is complete: written next to it, then renamed.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "sslam/core/error.hpp"

namespace sslam::io {

class OutputFile {
 public:
  // Throws Error when the place cannot be written to.
  explicit OutputFile(std::filesystem::path path) : path_(std::move(path)), written_(path_) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(path_, ignored))
      path_ = std::filesystem::weakly_canonical(path_, ignored);
    const auto status = std::filesystem::status(path_, ignored);
    if (std::filesystem::is_directory(status)) throw Error(path_.string() + ": cannot write: is a folder");
    // A device or a pipe is written to, never replaced.
    in_place_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    written_ = path_;
    if (!in_place_) written_ += ".part";
    errno = 0;
    stream_.open(written_, std::ios::binary | std::ios::trunc);
    if (!stream_) fail();
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() {
    if (committed_ || in_place_) return;
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(written_, ignored);
  }

  [[nodiscard]] std::ostream& stream() noexcept { return stream_; }

  // Throws Error when anything has not reached the file, for example on a full disk.
  void commit() {
    errno = 0;
    stream_.close();
    if (!stream_) fail();
    if (!in_place_) {
      std::error_code error;
      std::filesystem::rename(written_, path_, error);
      if (error) throw Error(path_.string() + ": cannot write: " + error.message());
    }
    committed_ = true;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(path_.string() + ": cannot write: " + (errno != 0 ? std::strerror(errno) : "output error"));
  }

  std::filesystem::path path_;
  std::filesystem::path written_;
  std::ofstream stream_;
  bool in_place_ = false;
  bool committed_ = false;
};

// Throws Error when it cannot be written.
inline void write_text(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.stream() << text;
  file.commit();
}

// Makes the folder and its parents, and proves that a file can be made in it: better now than after a long
// run.
inline void prepare_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error)) {
    throw Error(folder.string() + ": cannot make this folder" + (error ? ": " + error.message() : ""));
  }
  OutputFile probe(folder / ".write_probe");
}

}  // namespace sslam::io
