// SPDX-License-Identifier: BSD-3-Clause
// The result of the front end for one image, ready for the tracker.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "sslam/map/frame.hpp"
#include "sslam/opencv/image_frontend.hpp"

namespace sslam {

struct Extraction {
  Frame<double> frame;
  FrontendReport report;
  ImageInput asked_of;  // copy of the image for normals on demand; empty if they are not on demand
  std::string label;    // the caller's name of the image, for observers
  // Small pictures of the image and its normals, if Settings::keep_pictures is set; else empty.
  cv::Mat picture, normal_picture;
  cv::Mat picture_mask;            // of the picture's size, as ImageInput::mask; empty: all is used
  Pinhole<double> normal_pinhole;  // of the normals' pixels, without lens distortion

  [[nodiscard]] bool usable() const noexcept { return report.image == ImageStatus::kOk; }
};

}  // namespace sslam
