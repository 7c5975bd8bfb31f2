// SPDX-License-Identifier: BSD-3-Clause
// A video that appears under its name only when it is complete: written next to it, then renamed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/videoio.hpp>

namespace sslam::cli {

class VideoFile {
 public:
  // H.264 for .mp4 (MPEG-4 part 2, with a note, where there is no encoder), Motion JPEG for .avi. Throws
  // Error when the name, the place or the encoders do not do.
  VideoFile(std::filesystem::path path, cv::Size size, double frames_per_second);
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;
  ~VideoFile();

  // 8 bit BGR, of the video's size.
  void write(const cv::Mat& frame);

  // Throws Error when not every frame has reached the file. A video of no frame is no file.
  void commit();

 private:
  void check_place();
  [[nodiscard]] bool open(const char* fourcc, double frames_per_second);
  [[nodiscard]] bool is_complete() const;

  std::filesystem::path path_;
  std::filesystem::path written_;
  cv::Size size_;
  cv::VideoWriter writer_;
  std::int64_t frames_ = 0;
};

}  // namespace sslam::cli
