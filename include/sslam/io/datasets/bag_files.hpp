// SPDX-License-Identifier: BSD-3-Clause
// Which files are a recording of ROS: a bag, or the folder that `ros2 bag record` makes. Its frames are known
// only to who opens it (bag.hpp), and are filled in then.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// Which topics to take; empty: found.
struct BagTopics {
  std::string images, depth;
};

namespace bag_detail {

[[nodiscard]] inline std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder,
                                                                   std::string_view extension) {
  return list_files(folder,
                    [&](const auto& name) { return lower_case(name.extension().string()) == extension; });
}

}  // namespace bag_detail

[[nodiscard]] inline bool is_bag_folder(const std::filesystem::path& root) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(root / "metadata.yaml", ignored) &&
         !list_files(root, [](const auto& name) {
            return is_bag_name(name) || name.string().find(".mcap.") != std::string::npos ||
                   name.string().find(".db3.") != std::string::npos;
          }).empty();
}

[[nodiscard]] inline Dataset unread_bag(const std::filesystem::path& path) {
  Dataset dataset;
  dataset.layout = Layout::kBag;
  dataset.root = path.has_filename() ? path : path.parent_path();  // "folder/" is no name
  return dataset;
}

// The files of the recording at `path`, in the order of their numbers. Throws Error where they are of a kind
// that is not read.
[[nodiscard]] inline std::vector<std::filesystem::path> bag_files(const std::filesystem::path& path) {
  const auto refuse_sqlite = [&] {
    throw Error(
        path.string() +
        ": is a ROS 2 bag in SQLite (.db3); `ros2 bag convert` makes an MCAP file of it, which is read");
  };
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) {
    if (lower_case(path.extension().string()) == ".db3") refuse_sqlite();
    return {path};
  }
  std::vector<std::filesystem::path> files = bag_detail::files_with(path, ".mcap");
  if (files.empty() && !bag_detail::files_with(path, ".db3").empty()) refuse_sqlite();
  if (files.empty())
    throw Error(path.string() +
                ": holds no .mcap file; files that are packed as a whole are not read: unpack them first");
  constexpr std::size_t kMostFiles = 65535;
  if (files.size() > kMostFiles) throw Error(path.string() + ": holds more than 65535 files");
  return files;
}

}  // namespace sslam::io
