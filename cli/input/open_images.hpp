// SPDX-License-Identifier: BSD-3-Clause
// Images for commands that take them one by one: all that `sslam run` takes, or a single image.
#pragma once

#include <filesystem>

#include "cli/input/image_file.hpp"
#include "sslam/io/datasets/open_dataset.hpp"

namespace sslam::cli {

[[nodiscard]] inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

// Throws Error when there is nothing of this kind.
[[nodiscard]] inline io::Dataset open_images(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    if (io::is_image_name(path))
      return io::frames_from_images(folder_of(path), {path}, io::kDefaultFrameRate);
    if (!io::is_video_name(path))
      throw Error(path.string() + ": is neither an image (png, jpg, ...) nor a video (mp4, avi, ...)");
  }
  io::Dataset dataset = io::open_dataset(path);
  if (dataset.layout == io::Layout::kVideo) list_video_frames(dataset);
  return dataset;
}

}  // namespace sslam::cli
