// SPDX-License-Identifier: BSD-3-Clause
// Named pipes as files: what their writers give, without a wait that never ends where nobody writes.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "sslam/core/error.hpp"

namespace sslam::io {

// A process in its place, such as <(zcat a.gz), may take a while before it begins.
inline constexpr std::chrono::milliseconds kLongestSilence{60'000};

[[nodiscard]] inline bool is_pipe(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_fifo(path, ignored);
}

// Everything up to its end. Throws Error when nothing comes for `silence`, when it cannot be read, or gives
// more than `most` bytes.
[[nodiscard]] inline std::string read_pipe(const std::filesystem::path& path, std::size_t most,
                                           std::chrono::milliseconds silence = kLongestSilence) {
  struct File {
    int number;
    ~File() { close(number); }
  };
  // Without a writer, opening it otherwise would wait.
  const File file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  const auto fail = [&path](const char* what) { throw Error(path.string() + ": " + what); };
  if (file.number < 0) fail(std::strerror(errno));
  std::string text;
  for (std::vector<char> block(std::size_t{1} << 16);;) {
    // It hangs up when its last writer goes, not before the first comes.
    pollfd wait{file.number, POLLIN, 0};
    const int heard = poll(&wait, 1, static_cast<int>(silence.count()));
    if (heard < 0 && errno == EINTR) continue;
    if (heard == 0)
      throw Error(path.string() + ": is a named pipe, and nothing has come through it for " +
                  std::to_string(silence.count() / 1000) +
                  " s; expected a file, or a program that writes into it");
    const ssize_t got = ::read(file.number, block.data(), block.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) fail(std::strerror(errno));
    if (got == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(got));
    if (text.size() > most)
      throw Error(path.string() + ": is longer than " + std::to_string(most) + " bytes, or has no end");
  }
}

}  // namespace sslam::io
