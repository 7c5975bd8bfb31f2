// SPDX-License-Identifier: BSD-3-Clause
// Frames on their way from the disk to the tracker: a thread decodes and extracts ahead, the tracker takes in
// order.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/input/frame_reader.hpp"
#include "cli/input/normal_choice.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/opencv/image_frontend.hpp"

namespace sslam::cli {

struct StreamSettings {
  ImageFrontend<NormalChoice> frontend;
  double depth_factor = 5000;  // depth image units a metre
  bool use_points = true;
  bool use_lines = true;
  bool keep_pictures = false;  // hand the images on with their frames
  double pace = 0;             // seconds a unit of the stamps, to deliver as a camera would; 0: at once
};

struct ExtractedFrame {
  Frame<double> frame;
  FrontendReport report;
  std::string image;       // file name, for people
  std::string warning;     // not empty: something is wrong with this frame
  bool usable = true;      // false: the frame could not be read and is skipped
  cv::Mat picture;         // the image, if pictures are kept
  cv::Mat normal_picture;  // its normals in small, if pictures are kept and there are any
};

class FrameStream {
 public:
  FrameStream(const io::Dataset& dataset, StreamSettings settings);
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  [[nodiscard]] std::size_t size() const noexcept { return dataset_.frames.size(); }
  [[nodiscard]] const Camera<double>& camera() const noexcept { return settings_.frontend.camera; }

  // The next frame in order; false at the end. The old contents of `out` are recycled.
  [[nodiscard]] bool next(ExtractedFrame& out);

 private:
  void produce();
  [[nodiscard]] bool wait_until_due(std::unique_lock<std::mutex>& lock, const io::FrameEntry& entry);
  void fill(const io::FrameEntry& entry, ExtractedFrame& out);
  void keep_pictures(const ImageInput& input, ExtractedFrame& out) const;
  void read_depth(const io::FrameEntry& entry, ImageInput& input, ExtractedFrame& out) const;

  const io::Dataset& dataset_;
  StreamSettings settings_;
  FrameReader reader_;

  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();

  static constexpr std::size_t kAhead = 3;  // frames extracted before they are asked for
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ExtractedFrame> ready_;
  std::vector<ExtractedFrame> spare_;
  std::exception_ptr failure_;
  bool finished_ = false;
  bool stop_ = false;
  std::thread producer_;
};

}  // namespace sslam::cli
