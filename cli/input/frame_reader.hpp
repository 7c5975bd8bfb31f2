// SPDX-License-Identifier: BSD-3-Clause
// The images of a dataset in order, whether they are files or the frames of a video.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "cli/input/image_file.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// The name, without extension, of files that belong to one frame of a video.
[[nodiscard]] inline std::string video_frame_stem(const std::filesystem::path& video, std::int64_t index) {
  char number[32];
  std::snprintf(number, sizeof number, "_%06lld", static_cast<long long>(index));
  return video.stem().string() + number;
}

class FrameReader {
 public:
  // The dataset must outlive the reader.
  explicit FrameReader(const io::Dataset& dataset) : dataset_(dataset) {
    if (is_video()) video_.open(dataset_.root.string());
  }

  // 8 bit BGR; entries must come in the order of the dataset. Empty, with the reason in `why`, when it cannot
  // be decoded.
  [[nodiscard]] cv::Mat read(const io::FrameEntry& entry, std::string& why) {
    if (!is_video()) return load_image(entry.image, cv::IMREAD_COLOR, why);
    cv::Mat image;
    while (next_ < entry.index && video_.grab()) ++next_;
    if (next_ == entry.index && video_.read(image)) ++next_;
    if (image.empty()) why = entry.image + ": cannot decode frame " + std::to_string(entry.index);
    return image;
  }

  // For people.
  [[nodiscard]] std::string label(const io::FrameEntry& entry) const {
    const std::string file = std::filesystem::path(entry.image).filename().string();
    return is_video() ? file + " frame " + std::to_string(entry.index) : file;
  }

  // The name, without folder and extension, of files that belong to the frame, such as its normals.
  [[nodiscard]] std::string stem(const io::FrameEntry& entry) const {
    return is_video() ? video_frame_stem(entry.image, entry.index)
                      : std::filesystem::path(entry.image).stem().string();
  }

 private:
  [[nodiscard]] bool is_video() const noexcept { return dataset_.layout == io::Layout::kVideo; }

  const io::Dataset& dataset_;
  cv::VideoCapture video_;
  std::int64_t next_ = 0;  // frame that the video gives next
};

}  // namespace sslam::cli
