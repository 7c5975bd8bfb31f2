// SPDX-License-Identifier: BSD-3-Clause
// The images of a wide lens as a pinhole of a chosen field of view would have seen them: straight edges are
// straight in it, which lines and normals need. What lies beyond that field is not seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/opencv/camera/wide_lens.hpp"

namespace sslam {

// The pinhole's camera: its images have the size of the lens's, square pixels, and the axis in their middle.
[[nodiscard]] inline Camera<double> view_camera(const WideLens& lens, double degrees_across) noexcept {
  const double focal = 0.5 * lens.width / std::tan(radians(degrees_across) / 2);
  return {{focal, focal, 0.5 * (lens.width - 1), 0.5 * (lens.height - 1)}, {}, lens.width, lens.height};
}

class WideView {
 public:
  // Across, degrees. A pinhole's pixels grow with the square of the angle's secant: beyond, its corners are
  // blown up and its middle is small.
  static constexpr double kUsual = 110, kWidest = 140;

  // Degrees across that the lens sees to both sides of its axis.
  [[nodiscard]] static double field_of(const WideLens& lens) noexcept {
    return degrees(2 * std::min(lens.reach({1, 0}), lens.reach({-1, 0})));
  }

  // `degrees_across` in (0, 180), at most field_of(lens).
  WideView(const WideLens& lens, double degrees_across) : camera_(view_camera(lens, degrees_across)) {
    cv::Mat map(lens.height, lens.width, CV_32FC2);
    seen_ = cv::Mat(map.size(), CV_8UC1, cv::Scalar(0));
    for (int v = 0; v < map.rows; ++v)
      for (int u = 0; u < map.cols; ++u) {
        const Vec3<double> ray = camera_.pinhole.unproject(Vec2<double>(u, v));
        Vec2<double> from(-1, -1);
        const bool seen = lens.project(ray, from) && lens.is_inside(from);
        if (seen) seen_.at<std::uint8_t>(v, u) = 255;
        map.at<cv::Vec2f>(v, u) = {static_cast<float>(from.x()), static_cast<float>(from.y())};
      }
    cv::convertMaps(map, cv::noArray(), coarse_, fine_, CV_16SC2);
    whole_ = cv::countNonZero(seen_) == map.rows * map.cols;
    if (!whole_) cv::erode(seen_, seen_, cv::Mat(), {-1, -1}, kRim);
  }

  [[nodiscard]] const Camera<double>& camera() const noexcept { return camera_; }

  // An image of the lens; `interpolation` as cv::remap takes it.
  [[nodiscard]] cv::Mat of(const cv::Mat& image, int interpolation = cv::INTER_LINEAR) const {
    cv::Mat view;
    cv::remap(image, view, coarse_, interpolation == cv::INTER_NEAREST ? cv::noArray() : fine_, interpolation,
              cv::BORDER_CONSTANT);
    return view;
  }

  // Which pixels of the view to use, of an image with this mask; empty, of both: all.
  [[nodiscard]] cv::Mat mask(const cv::Mat& of_image) const {
    if (of_image.empty()) return seen();
    cv::Mat mask = of(of_image, cv::INTER_NEAREST);
    if (!whole_) mask &= seen_;
    return mask;
  }

  // Where the lens sees something, less a rim in which its image's edge would be a feature; empty:
  // everywhere.
  [[nodiscard]] const cv::Mat& seen() const noexcept { return whole_ ? kEverywhere : seen_; }

 private:
  static constexpr int kRim = 8;  // pixels
  inline static const cv::Mat kEverywhere{};

  Camera<double> camera_;
  cv::Mat coarse_, fine_, seen_;
  bool whole_ = true;
};

}  // namespace sslam
