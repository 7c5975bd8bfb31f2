// SPDX-License-Identifier: BSD-3-Clause
// From corners in many views to a camera (Zhang, PAMI 2000, and for fisheyes Kannala and Brandt, PAMI 2006,
// as OpenCV does it).
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/calibrate/board.hpp"
#include "sslam/opencv/camera/wide_lens.hpp"

namespace sslam::cli {

enum class LensKind {
  kPinhole,  // k1 k2 p1 p2
  kThird,    // and k3
  kFisheye,  // k1 to k4 of the angle off the axis
};

struct Calibration {
  Camera<double> camera;                // of a fisheye: its plane, without distortion
  std::optional<WideLens> wide;         // the fisheye
  double error = 0;                     // reprojection, RMS over all corners, pixels
  double fx_sigma = 0, fy_sigma = 0;    // standard deviations, pixels
  std::vector<BoardView> views;         // that were used
  std::vector<double> view_errors;      // RMS of each
  std::vector<BoardView> left_out;      // outliers
  std::vector<double> left_out_errors;  // of each, by the camera before it was left out
  double largest_tilt = 0;              // of a board against the image plane, degrees
};

inline constexpr std::size_t kLeastViews = 5;

// Leaves out views that fit much worse than the others. Throws Error when the views do not give a camera.
[[nodiscard]] Calibration calibrate(const std::vector<BoardView>& views, cv::Size size, LensKind kind);

}  // namespace sslam::cli
