// SPDX-License-Identifier: BSD-3-Clause
// The camera of single images, also where nobody knows it.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>

#include "cli/input/camera_choice.hpp"
#include "cli/input/size_text.hpp"
#include "cli/shell/messages.hpp"

namespace sslam::cli {

class ImageCamera {
 public:
  // Where nothing is known, a pinhole is assumed whose focal length is this share of an image's width.
  ImageCamera(std::optional<CameraChoice> known, double focal_per_width)
      : known_(std::move(known)), focal_per_width_(focal_per_width) {}

  // A calibration that leaves the size out is for images of the size of the first.
  [[nodiscard]] Camera<double> of(const cv::Mat& image) {
    if (!known_) return assumed(image.cols, image.rows);
    Camera<double>& camera = known_->camera;
    if (camera.width == 0 || camera.height == 0) {
      camera.width = image.cols;
      camera.height = image.rows;
    }
    return camera;
  }

 private:
  [[nodiscard]] Camera<double> assumed(int width, int height) {
    const double focal = focal_per_width_ * width;
    if (!std::exchange(told_, true))
      print_note("the camera is not known: assuming a focal length of " + std::to_string(std::lround(focal)) +
                 " pixels for " + size_text(width, height) + " (--camera gives another)");
    return {{focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)}, {}, width, height};
  }

  std::optional<CameraChoice> known_;
  double focal_per_width_;
  bool told_ = false;
};

}  // namespace sslam::cli
