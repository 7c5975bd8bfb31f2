// SPDX-License-Identifier: BSD-3-Clause
// The images of a dataset in order, whether they are files, the frames of a video or the messages of a bag.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "cli/input/bag_reader.hpp"
#include "cli/input/image_header.hpp"
#include "cli/input/image_range.hpp"
#include "cli/input/video_reader.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// The name, without extension, of files that belong to one frame of a video.
[[nodiscard]] std::string video_frame_stem(const std::filesystem::path& video, std::int64_t index);

// What is read of images that are stored `stored` and shown turned: a calibration is of the stored pixels
// where its size says so, else of the upright ones. Video is shown turned by everything that writes
// calibrations from it; of images that are stored upside down, most programs see the stored pixels.
[[nodiscard]] ImageTurn turn_for_camera(cv::Size stored, ImageTurn turn, cv::Size camera, bool video);

class FrameReader {
 public:
  // `camera`: the size that the calibration is for; empty: there is no calibration, and images are shown
  // upright. The dataset must outlive the reader. Throws Error when a video cannot be opened.
  explicit FrameReader(const io::Dataset& dataset, cv::Size camera = {});

  // 8 bit BGR; entries must come in the order of the dataset. Empty, with the reason in `why`, when it cannot
  // be decoded.
  [[nodiscard]] cv::Mat read(const io::FrameEntry& entry, std::string& why);

  // Of an entry that has depth: in the image's own type, with 0 for what was not measured. Empty as above.
  [[nodiscard]] cv::Mat read_depth(const io::FrameEntry& entry, std::string& why);

  // For people.
  [[nodiscard]] std::string label(const io::FrameEntry& entry) const;

  // The name, without folder and extension, of files that belong to the frame, such as its normals.
  [[nodiscard]] std::string stem(const io::FrameEntry& entry) const;

  // Of 16 bit images, once one has been read.
  [[nodiscard]] const std::optional<ImageRange>& range() const noexcept { return range_; }

 private:
  [[nodiscard]] bool is_video() const noexcept { return video_ != nullptr; }
  // Within one file, and known by their numbers.
  [[nodiscard]] bool are_counted() const noexcept { return is_video() || images_; }
  [[nodiscard]] cv::Mat read_still(const io::FrameEntry& entry, std::string& why);
  [[nodiscard]] cv::Mat load(const io::FrameEntry& entry, ImageTurn& turn, std::string& why);
  [[nodiscard]] cv::Mat read_video(const io::FrameEntry& entry, std::string& why);
  void find_range(const cv::Mat& read);

  const io::Dataset& dataset_;
  cv::Size camera_;
  std::unique_ptr<VideoReader> video_;
  bool decoded_ = false;     // the video has decoded a frame that nobody has asked for yet
  std::int64_t frame_ = -1;  // its number
  std::optional<BagReader> images_, depths_;
  std::optional<ImageRange> range_;
};

}  // namespace sslam::cli
