// SPDX-License-Identifier: BSD-3-Clause
// Resamples an image as the ideal pinhole would have seen it, so that straight edges are straight.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/opencv/camera/same_camera.hpp"

namespace sslam {

class Undistorter {
 public:
  // An image of the camera's size. Without distortion the result is the image itself, sharing its memory.
  [[nodiscard]] const cv::Mat& undistort(const cv::Mat& image, const Camera<double>& camera) {
    if (camera.distortion.is_identity()) return image;
    if (!same_camera(camera, camera_)) prepare(camera);
    cv::remap(image, undistorted_, coarse_, fine_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return undistorted_;
  }

 private:
  void prepare(const Camera<double>& camera) {
    camera_ = camera;
    cv::Mat map(camera.height, camera.width, CV_32FC2);
    for (int v = 0; v < map.rows; ++v)
      for (int u = 0; u < map.cols; ++u) {
        const Vec2<double> from = camera.distort_pixel(Vec2<double>(u, v));
        map.at<cv::Vec2f>(v, u) = {static_cast<float>(from.x()), static_cast<float>(from.y())};
      }
    cv::convertMaps(map, cv::noArray(), coarse_, fine_, CV_16SC2);
  }

  Camera<double> camera_;
  cv::Mat coarse_, fine_, undistorted_;
};

}  // namespace sslam
