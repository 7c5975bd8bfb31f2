// SPDX-License-Identifier: BSD-3-Clause
// Datasets and images as commands take them. The readers of io are compiled here, and nowhere else in the
// program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// Where a file lies; "." where its name has no folder.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file);

// io::open_dataset: what lies there, without the frames of videos and bags. Throws Error.
[[nodiscard]] io::Dataset dataset_at(const std::filesystem::path& path);

// As in "TUM RGB-D".
[[nodiscard]] std::string_view layout_name(io::Layout layout);

// With the frames of videos and bags, too: of a video `at_most` of them, if that is not negative. Throws
// Error, also where topics are wanted and this is no bag.
[[nodiscard]] io::Dataset open_frames(const std::filesystem::path& path, const io::OpenOptions& options = {},
                                      const io::BagTopics& topics = {}, std::int64_t at_most = -1);

// All that open_frames takes, or a single image. Throws Error when there is nothing of this kind.
[[nodiscard]] io::Dataset open_images(const std::filesystem::path& path, const io::BagTopics& topics = {});

}  // namespace sslam::cli
