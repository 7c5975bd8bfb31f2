// SPDX-License-Identifier: BSD-3-Clause
// The views of a run's frames in a file: "SSLAMVW1", then each view behind its size (u32).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/byte_archive.hpp"

namespace sslam::cli {

inline constexpr std::string_view kViewMagic = "SSLAMVW1";

// Throws Error when it cannot be written.
inline void write_views(const std::filesystem::path& path, std::span<const std::string> views) {
  io::OutputFile file(path);
  file.stream() << kViewMagic;
  for (const std::string& view : views) {
    io::ByteWriter size;
    size(static_cast<std::uint32_t>(view.size()));
    file.stream() << size.bytes << view;
  }
  file.commit();
}

// The views that are whole. Throws Error when the file cannot be read or is none; a warning says where it
// is cut off.
[[nodiscard]] inline std::vector<std::string> read_views(const std::filesystem::path& path,
                                                         io::Warnings& warnings) {
  const std::string text = io::read_text(path);
  if (!text.starts_with(kViewMagic)) throw Error(path.string() + ": holds no views of a run");
  io::ByteReader reader{std::string_view(text).substr(kViewMagic.size())};
  std::vector<std::string> views;
  try {
    while (!reader.left().empty()) {
      std::uint32_t size = 0;
      reader(size);
      views.emplace_back(reader.take(size));
    }
  } catch (const Error&) {
    warnings.push_back(path.string() + ": is cut off after " + std::to_string(views.size()) + " views");
  }
  return views;
}

}  // namespace sslam::cli
