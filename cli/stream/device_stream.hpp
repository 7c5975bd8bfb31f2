// SPDX-License-Identifier: BSD-3-Clause
// A camera on this machine, by OpenCV's reader for Video4Linux.
#pragma once

#include <opencv2/videoio.hpp>
#include <string>

#include "cli/stream/stream_reader.hpp"

namespace sslam::cli {

class DeviceStream : public StreamReader {
 public:
  // `name`: a number, or a file such as /dev/video0. `size`: of the images to ask for; empty: none. Throws
  // Error when there is no such camera.
  DeviceStream(const std::string& name, cv::Size size, Patience& patience);

  [[nodiscard]] bool read(StreamFrame& out) override;
  [[nodiscard]] StreamFlow flow() const override { return StreamFlow::kRuns; }

 private:
  [[nodiscard]] bool grab(cv::Mat& image);

  Patience& patience_;
  std::string file_;
  cv::VideoCapture camera_;
};

}  // namespace sslam::cli
