// SPDX-License-Identifier: BSD-3-Clause
// A video by FFmpeg's libraries: frames with their times in the container, and how they are to be turned.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "cli/input/image_header.hpp"

namespace sslam::cli {

struct VideoInfo {
  cv::Size size;              // of the stored pixels
  ImageTurn turn = kUpright;  // what players do with them
  double odd_turn = 0;        // degrees clockwise that a tag asks for and that are no right angle; 0: none
  double frame_rate = 0;      // frames a second, on average; 0: not known
  double pixel_aspect = 1;    // width of a pixel over its height; 1 also where it is not said
  bool interlaced = false;    // every other row is of another moment
  std::int64_t claimed = 0;   // frames that the container claims to hold; 0: it does not say
};

// What is in the container, without decoding it.
struct VideoTimes {
  std::vector<double>
      times;  // of the frames, seconds on the container's clock, in order of display; empty: not known
  std::int64_t frames = 0;  // that are there to be shown
  bool whole = true;        // these are all
};

class VideoReader {
 public:
  // Throws Error, one line, when this is no video or no decoder of this machine reads it.
  explicit VideoReader(const std::filesystem::path& file);
  ~VideoReader();
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;

  [[nodiscard]] const VideoInfo& info() const noexcept;

  // Decodes the next frame; false at the end. What cannot be decoded is passed over.
  [[nodiscard]] bool advance();
  // Of that frame, on the container's clock; empty: not known.
  [[nodiscard]] std::optional<double> time() const;
  // Of that frame: 8 bit BGR, as stored, not turned. Empty: its pixels cannot be converted.
  [[nodiscard]] cv::Mat image();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Reads the container until `at_most` frames are known; negative: to its end. Throws as VideoReader does.
[[nodiscard]] VideoTimes read_video_times(const std::filesystem::path& file, std::int64_t at_most);

}  // namespace sslam::cli
