// SPDX-License-Identifier: BSD-3-Clause
// Names of files: which are images or videos, natural order, wildcards.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/error.hpp"

namespace sslam::io {

[[nodiscard]] inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

[[nodiscard]] inline std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

[[nodiscard]] inline bool has_extension(const std::filesystem::path& path,
                                        std::span<const std::string_view> extensions) {
  const std::string own = lower_case(path.extension().string());
  return std::find(extensions.begin(), extensions.end(), own) != extensions.end();
}

// The first of these that is a file; empty: none is.
[[nodiscard]] inline std::filesystem::path first_file(std::initializer_list<std::filesystem::path> files) {
  std::error_code ignored;
  for (const std::filesystem::path& file : files)
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  return {};
}

[[nodiscard]] inline bool is_image_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 9> kImages{".png", ".jpg", ".jpeg", ".bmp", ".ppm",
                                                    ".pgm", ".tif", ".tiff", ".webp"};
  return has_extension(path, kImages);
}

[[nodiscard]] inline bool is_video_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 30> kVideos{
      ".mp4", ".avi", ".mkv", ".mov",  ".webm", ".m4v", ".mpeg", ".mpg",  ".ogv",   ".wmv",
      ".3gp", ".ts",  ".mts", ".m2ts", ".gif",  ".flv", ".apng", ".h264", ".hevc",  ".vob",
      ".y4m", ".asf", ".3g2", ".mxf",  ".m2v",  ".264", ".265",  ".h265", ".mjpeg", ".mjpg"};
  return has_extension(path, kVideos);
}

// A recording of ROS 1, of ROS 2 in either storage, or of Foxglove.
[[nodiscard]] inline bool is_bag_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 3> kBags{".bag", ".mcap", ".db3"};
  return has_extension(path, kBags);
}

[[nodiscard]] inline bool all_digits(std::string_view text) noexcept {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Natural order: runs of digits compare as numbers, so 9.png comes before 10.png.
[[nodiscard]] inline bool natural_less(std::string_view a, std::string_view b) noexcept {
  const auto digit = [](std::string_view s, std::size_t i) {
    return i < s.size() && std::isdigit(static_cast<unsigned char>(s[i])) != 0;
  };
  const auto run = [&digit](std::string_view s, std::size_t& i) {
    while (digit(s, i) && s[i] == '0') ++i;
    const std::size_t start = i;
    while (digit(s, i)) ++i;
    return s.substr(start, i - start);
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a, i) && digit(b, j)) {
      const std::string_view x = run(a, i);
      const std::string_view y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // equal but for leading zeros
}

// `*` any run of characters, `?` one character.
[[nodiscard]] inline bool matches_wildcards(std::string_view text, std::string_view pattern) noexcept {
  std::size_t t = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

[[nodiscard]] inline bool has_wildcards(std::string_view text) noexcept {
  return text.find_first_of("*?") != std::string_view::npos;
}

// Hidden: what programs keep for themselves, such as ".thumb.jpg", or what macOS leaves beside a file "x" on
// other disks: "._x", with the same extension and none of its content.
[[nodiscard]] inline bool is_hidden(const std::filesystem::path& name) {
  return name.string().starts_with('.');
}

// In the natural order of their names.
inline void sort_by_name(std::vector<std::filesystem::path>& paths) {
  std::sort(paths.begin(), paths.end(), [](const auto& a, const auto& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
}

// A link whose file is not there. Listed as a file, so that who reads it says so.
[[nodiscard]] inline bool is_dead_link(const std::filesystem::directory_entry& entry) {
  std::error_code ignored;
  return entry.is_symlink(ignored) && !entry.exists(ignored);
}

// Files in a folder (not below it), without hidden ones, that `wanted` accepts, in natural order. Empty when
// there is no such folder.
template <class Predicate>
[[nodiscard]] std::vector<std::filesystem::path> list_files(const std::filesystem::path& folder,
                                                            Predicate wanted) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (auto it = std::filesystem::directory_iterator(folder, error);
       !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    const std::filesystem::path name = it->path().filename();
    if ((it->is_regular_file(ignored) || is_dead_link(*it)) && !is_hidden(name) && wanted(name))
      files.push_back(it->path());
  }
  sort_by_name(files);
  return files;
}

// Whether any file lies in a folder that is there.
[[nodiscard]] inline bool holds_files(const std::filesystem::path& folder) {
  return !list_files(folder, [](const auto&) { return true; }).empty();
}

// Folders in a folder, without hidden ones. Empty when there is no such folder.
[[nodiscard]] inline std::vector<std::filesystem::path> list_folders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  for (auto it = std::filesystem::directory_iterator(folder, error);
       !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored) && !is_hidden(it->path().filename())) folders.push_back(it->path());
  }
  sort_by_name(folders);
  return folders;
}

// The folder of this name in another, in small letters or others; empty: none.
[[nodiscard]] inline std::filesystem::path find_folder(const std::filesystem::path& parent,
                                                       std::string_view name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(parent / name, ignored)) return parent / name;
  for (const std::filesystem::path& folder : list_folders(parent))
    if (lower_case(folder.filename().string()) == name) return folder;
  return {};
}

}  // namespace sslam::io
