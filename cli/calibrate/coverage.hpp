// SPDX-License-Identifier: BSD-3-Clause
// Which parts of the image the corners of a calibration have seen: where there were none, the lens is
// extrapolated.
#pragma once

#include <opencv2/core.hpp>

#include "cli/calibrate/calibration.hpp"

namespace sslam::cli {

// Share of the cells of a grid of 10 x 8 that hold a corner.
[[nodiscard]] double coverage_share(const Calibration& calibration);

// Cells without corners in red; corners from green to orange, at an error of a pixel, by that of their view;
// those left out as crosses.
[[nodiscard]] cv::Mat coverage_picture(const Calibration& calibration);

}  // namespace sslam::cli
