// SPDX-License-Identifier: BSD-3-Clause
// An image on its way to the tracker: what the front end has found in it.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "sslam/map/frame.hpp"
#include "sslam/opencv/image_frontend.hpp"

namespace sslam {

struct Extraction {
  Frame<double> frame;
  FrontendReport report;
  ImageInput asked_of;  // what normals on demand are found in: a copy; no image where they are not on demand
  std::string label;    // what the caller calls the image, for observers
  // The image and its normals in small, where Settings::keep_pictures asks for them; empty otherwise.
  cv::Mat picture, normal_picture;
  Pinhole<double> normal_pinhole;  // of the normals' pixels, lens distortion taken out

  [[nodiscard]] bool usable() const noexcept { return report.image == ImageStatus::kOk; }
};

}  // namespace sslam
