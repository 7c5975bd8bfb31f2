// SPDX-License-Identifier: BSD-3-Clause
// What all fuzzers do: input as a file, since readers take paths, and an Error as the right answer to most of
// it.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"

namespace sslam::fuzzing {

// One file for each process, in memory where there is such a place.
inline const std::filesystem::path& input_file() {
  static const std::filesystem::path file = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto folder =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    return folder / ("sslam_fuzz_" + std::to_string(getpid()));
  }();
  return file;
}

// Anything but an Error of one line ends the fuzzer.
template <class Read>
void expect_error(Read read) {
  try {
    read();
  } catch (const Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

// The same for readers of the program, which prints any message in one line.
template <class Read>
void expect_message(Read read) {
  try {
    read();
  } catch (const Error&) {
  }
}

template <class Read>
int read_as_file(const std::uint8_t* data, std::size_t size, Read read) {
  std::ofstream(input_file(), std::ios::binary)
      << std::string_view(reinterpret_cast<const char*>(data), size);
  expect_error([&] { read(input_file()); });
  return 0;
}

}  // namespace sslam::fuzzing
