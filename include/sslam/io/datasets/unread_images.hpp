// SPDX-License-Identifier: BSD-3-Clause
// Images in formats that are not read, in a folder where no others are.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/files/files.hpp"

namespace sslam::io {

[[nodiscard]] inline bool is_unread_image_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 25> kFormats{
      ".heic", ".heif", ".avif", ".jp2", ".j2k", ".jxl", ".dng", ".cr2", ".cr3",
      ".nef",  ".arw",  ".raf",  ".orf", ".rw2", ".raw", ".exr", ".hdr", ".npy",
      ".pfm",  ".tga",  ".psd",  ".svg", ".pcx", ".dpx", ".xcf"};
  return has_extension(path, kFormats);
}

// "120 files such as 0001.heic are images in a format that is not read"; empty: there are none.
[[nodiscard]] inline std::string unread_images(const std::filesystem::path& root) {
  const std::vector<std::filesystem::path> files = list_files(root, is_unread_image_name);
  if (files.empty()) return {};
  return std::to_string(files.size()) + " files such as " + files.front().filename().string() +
         " are in a format that is not read; convert them to PNG or JPEG";
}

}  // namespace sslam::io
