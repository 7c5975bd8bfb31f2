// SPDX-License-Identifier: BSD-3-Clause
// A folder of files from the bytes of a fuzzer. Each file is a byte that chooses its name, then what it
// holds, up to kNextFile: whatever is put in or taken out, the other files stay as they were.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "fuzz/fuzz_input.hpp"

namespace sslam::fuzzing {

inline constexpr char kNextFile = '\xfe';

// Empty, in memory where there is such a place, the same for the whole process.
inline std::filesystem::path empty_folder() {
  const std::filesystem::path folder = input_file().string() + "_folder";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  return folder;
}

inline void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

// Calls take(name, content) for each file.
template <class Take>
void for_each_file(std::string_view input, std::span<const std::string_view> names, Take take) {
  while (!input.empty()) {
    const std::size_t end = std::min(input.find(kNextFile), input.size());
    const std::string_view file = input.substr(0, end);
    if (!file.empty()) take(names[static_cast<unsigned char>(file[0]) % names.size()], file.substr(1));
    input.remove_prefix(std::min(end + 1, input.size()));
  }
}

// The other way: one file of an input. `name` is one of `names`.
inline std::string file_of(std::span<const std::string_view> names, std::string_view name,
                           std::string_view content) {
  const auto at = std::find(names.begin(), names.end(), name) - names.begin();
  return static_cast<char>(at) + std::string(content) + kNextFile;
}

}  // namespace sslam::fuzzing
