// SPDX-License-Identifier: BSD-3-Clause
// Which files are a recording of ROS: a bag, or the folder that `ros2 bag record` makes. Its frames are known
// only to who opens it (bag.hpp), and are filled in then.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/bags/messages.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace bag_detail {

[[nodiscard]] inline std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder,
                                                                   std::string_view extension) {
  return list_files(folder,
                    [&](const auto& name) { return lower_case(name.extension().string()) == extension; });
}

[[nodiscard]] inline bool is_packed_bag(const std::filesystem::path& name) {
  return name.extension() == ".zstd" && is_bag_name(name.stem());
}

// "walk_0.db3" and "walk_1.db3" are parts of "walk".
[[nodiscard]] inline std::string name_without_number(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const std::size_t line = name.rfind('_');
  return line != std::string::npos && all_digits(std::string_view(name).substr(line + 1))
             ? name.substr(0, line)
             : name;
}

}  // namespace bag_detail

// A recorder that was killed has not written metadata.yaml: the names of the parts tell then.
[[nodiscard]] inline bool is_bag_folder(const std::filesystem::path& root) {
  std::error_code ignored;
  const auto files = list_files(root, [](const auto& name) {
    return (is_bag_name(name) && lower_case(name.extension().string()) != ".bag") ||
           bag_detail::is_packed_bag(name);
  });
  if (files.empty() || std::filesystem::is_regular_file(root / "metadata.yaml", ignored))
    return !files.empty();
  const auto same = [&](const auto& file) {
    return bag_detail::name_without_number(file) == bag_detail::name_without_number(files.front());
  };
  return std::all_of(files.begin(), files.end(), same);
}

[[nodiscard]] inline Dataset unread_bag(const std::filesystem::path& path) {
  Dataset dataset;
  dataset.layout = Layout::kBag;
  dataset.root = path.has_filename() ? path : path.parent_path();  // "folder/" is no name
  return dataset;
}

namespace bag_detail {

// The names of the parts by metadata.yaml, as the recorder writes it: a list with one a line.
[[nodiscard]] inline std::vector<std::filesystem::path> listed_parts(const std::filesystem::path& metadata) {
  std::vector<std::filesystem::path> parts;
  const std::string text = read_text(metadata);
  bool listed = false;
  for (const TextRow& row : split_rows(text)) {
    const bool item = row.cells.size() > 1 && row.cells[0] == "-";
    if (listed && !item) break;
    if (listed) {  // a name may hold blanks
      const char* const begin = row.cells[1].data();
      const char* const end = row.cells.back().data() + row.cells.back().size();
      parts.emplace_back(std::string(begin, end));
    }
    listed = listed || row.cells[0] == "relative_file_paths:";
  }
  return parts;
}

}  // namespace bag_detail

// Of a folder whose metadata.yaml lists parts that are not there, a line that says so; else empty.
[[nodiscard]] inline std::string missing_parts(const std::filesystem::path& folder) {
  const std::filesystem::path metadata = folder / "metadata.yaml";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(metadata, ignored)) return {};
  std::string first;
  std::size_t missing = 0;
  for (const std::filesystem::path& listed : bag_detail::listed_parts(metadata)) {
    std::filesystem::path part = folder / listed.filename();  // some recorders put the folder in front
    const bool there =
        std::filesystem::exists(part, ignored) ||
        (part.extension() == ".zstd" && std::filesystem::exists(part.replace_extension(), ignored));
    if (!there && missing++ == 0) first = shown_word(listed.filename().string());
  }
  if (missing == 0) return {};
  return metadata.string() + ": lists " + first +
         (missing > 1 ? " and " + std::to_string(missing - 1) + " more" : "") +
         ", not there: what the other parts hold is used";
}

// The files of the recording at `path`, in the order of their numbers. Throws Error where nobody knows which.
[[nodiscard]] inline std::vector<std::filesystem::path> bag_files(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return {path};
  for (const auto& packed : list_files(path, bag_detail::is_packed_bag)) {
    std::filesystem::path unpacked = packed;
    if (!std::filesystem::exists(unpacked.replace_extension(), ignored))
      throw Error(packed.string() + ": is packed as a whole; unpack it first, as by `zstd -d`");
  }
  std::vector<std::filesystem::path> files = bag_detail::files_with(path, ".mcap");
  const std::vector<std::filesystem::path> databases = bag_detail::files_with(path, ".db3");
  if (!files.empty() && !databases.empty())
    throw Error(path.string() + ": holds files of both .mcap and .db3; name the one that is meant");
  if (files.empty()) files = databases;
  if (files.empty()) throw Error(path.string() + ": holds neither .mcap nor .db3 files");
  constexpr std::size_t kMostFiles = 65535;
  if (files.size() > kMostFiles) throw Error(path.string() + ": holds more than 65535 files");
  return files;
}

}  // namespace sslam::io
