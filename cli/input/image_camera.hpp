// SPDX-License-Identifier: BSD-3-Clause
// The camera of single images, also where nobody knows it.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>

#include "cli/input/camera_choice.hpp"
#include "cli/input/camera_fit.hpp"
#include "cli/input/size_text.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::cli {

class ImageCamera {
 public:
  // Where nothing is known, a pinhole is assumed whose focal length is this share of an image's width. Throws
  // Error when a camera file is wrong.
  ImageCamera(CameraWish wish, const io::Dataset& dataset, double focal_per_width)
      : wish_(std::move(wish)),
        known_(wish_.focal > 0 || wish_.fov > 0 ? std::nullopt : find_camera(wish_.file, dataset)),
        focal_per_width_(focal_per_width) {}

  // The first image's size is that of all. An image of a wide lens becomes what this camera sees of it.
  // Throws Error when the calibration cannot be that image's.
  [[nodiscard]] Camera<double> of(cv::Mat& image) {
    if (!std::exchange(told_, true)) settle(image.cols, image.rows);
    if (!known_) return assumed(image.cols, image.rows);
    const bool same = image.cols == known_->camera.width && image.rows == known_->camera.height;
    if (view_ && same) image = view_->of(image);
    return known_->camera;
  }

 private:
  void settle(int width, int height) {
    if (auto wished = wished_camera(wish_, width, height)) known_ = std::move(wished);
    if (!known_) {
      print_note("the camera is not known: assuming a focal length of " +
                 std::to_string(std::lround(focal_per_width_ * width)) + " pixels for " +
                 size_text(width, height) + " (--camera gives another)");
      return;
    }
    pick_camera(*known_, width, height);
    take_size(*known_, width, height);
    fit_camera(known_->camera, width, height, known_->source, known_->notes, known_->warnings);
    take_view(*known_, wish_.undistort_fov);
    if (known_->wide) view_.emplace(*known_->wide, known_->view_fov);
    print_notes(known_->notes);
    print_warnings(known_->warnings);
  }

  [[nodiscard]] Camera<double> assumed(int width, int height) const {
    return plain_camera(focal_per_width_ * width, width, height, {}, kUnknownFocal).camera;
  }

  CameraWish wish_;
  std::optional<CameraChoice> known_;
  std::optional<WideView> view_;  // of a wide lens
  double focal_per_width_;
  bool told_ = false;
};

}  // namespace sslam::cli
