// SPDX-License-Identifier: BSD-3-Clause
// The size at which images are worked on. An image with more pixels than its lens resolves has features that
// are no better placed, windows and thresholds in pixels are narrower there, and each frame costs more.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/image_input.hpp"

namespace sslam {

// The camera whose images are those of `camera`, shrunk so that neither side is longer than `longest` pixels;
// the camera itself where they are not, or where `longest` is 0.
[[nodiscard]] inline Camera<double> shrunk_camera(const Camera<double>& camera, int longest) {
  const int side = std::max(camera.width, camera.height);
  if (longest <= 0 || side <= longest) return camera;
  const double share = static_cast<double>(longest) / side;
  const auto shrunk = [share](int length) {
    return std::max(1, static_cast<int>(std::lround(length * share)));
  };
  return resized(camera, shrunk(camera.width), shrunk(camera.height));
}

// The image, and what is registered to it, in the size of that camera.
[[nodiscard]] inline ImageInput shrunk_input(const ImageInput& input, const Camera<double>& small) {
  ImageInput out = input;
  const cv::Size size(small.width, small.height);
  cv::resize(input.image, out.image, size, 0, 0, cv::INTER_AREA);
  if (input.mask.size() == input.image.size()) {
    // A pixel that is left out in part is left out.
    cv::resize(input.mask != 0, out.mask, size, 0, 0, cv::INTER_AREA);
    out.mask = out.mask == 255;
  }
  if (input.depth.size() == input.image.size())
    cv::resize(input.depth, out.depth, size, 0, 0, cv::INTER_NEAREST);
  return out;
}

}  // namespace sslam
