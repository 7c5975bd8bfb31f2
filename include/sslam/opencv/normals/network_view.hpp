// SPDX-License-Identifier: BSD-3-Clause
// A network's view of the camera's image: warped to the camera that the network knows, lens distortion taken
// out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/normals/normal_manifest.hpp"

namespace sslam {

class NetworkView {
 public:
  // Prepares the maps; does nothing when neither the camera nor the input has changed.
  void set(const Camera<double>& camera, const NetworkInput& input) {
    if (same(camera, input)) return;
    camera_ = camera;
    input_ = input;
    const Pinhole<double>& p = camera.pinhole;
    const double sx = static_cast<double>(input.width) / camera.width,
                 sy = static_cast<double>(input.height) / camera.height;
    pinhole_ = input.focal > 0 ? Pinhole<double>{input.focal, input.focal, 0.5 * (input.width - 1),
                                                 0.5 * (input.height - 1)}
                               : resized(p, sx, sy);
    // Whole-number reduction by averaging first, so that the bilinear sampling of the maps does not alias.
    const double shrink = std::min(p.fx / pinhole_.fx, p.fy / pinhole_.fy);
    const int factor = std::max(1, static_cast<int>(shrink));
    reduced_ = cv::Size(camera.width / factor, camera.height / factor);
    build_maps();
  }

  // The image as 8 bit BGR at the network's size.
  [[nodiscard]] const cv::Mat& warp(const cv::Mat& image) {
    const cv::Mat* colour = &image;
    if (image.channels() != 3) {
      cv::cvtColor(image, colour_, image.channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
      colour = &colour_;
    }
    if (reduced_ != colour->size()) {
      cv::resize(*colour, small_, reduced_, 0, 0, cv::INTER_AREA);
      colour = &small_;
    }
    cv::remap(*colour, warped_, map_, fraction_, cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
    return warped_;
  }

  [[nodiscard]] const Pinhole<double>& pinhole() const noexcept {
    return pinhole_;
  }  // of the network's image
  // Whether the network's pixel shows something that the camera sees; what lies outside is mirrored.
  [[nodiscard]] bool inside(int u, int v) const { return inside_(v, u) != 0; }

 private:
  void build_maps() {
    cv::Mat_<cv::Point2f> map(input_.height, input_.width);
    inside_.create(map.size());
    const double rx = static_cast<double>(reduced_.width) / camera_.width,
                 ry = static_cast<double>(reduced_.height) / camera_.height;
    for (int v = 0; v < map.rows; ++v) {
      for (int u = 0; u < map.cols; ++u) {
        const Vec2<double> pixel =
            camera_.distort_pixel(camera_.pinhole.project(pinhole_.unproject(Vec2<double>(u, v))));
        const double x = (pixel.x() + 0.5) * rx - 0.5, y = (pixel.y() + 0.5) * ry - 0.5;
        inside_(v, u) = x > -0.5 && y > -0.5 && x < reduced_.width - 0.5 && y < reduced_.height - 0.5;
        map(v, u) = {static_cast<float>(x), static_cast<float>(y)};
      }
    }
    cv::convertMaps(map, cv::noArray(), map_, fraction_, CV_16SC2);
  }

  [[nodiscard]] bool same(const Camera<double>& c, const NetworkInput& i) const noexcept {
    const auto& a = c.pinhole;
    const auto& b = camera_.pinhole;
    const auto& d = c.distortion;
    const auto& e = camera_.distortion;
    return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && d.k1 == e.k1 && d.k2 == e.k2 &&
           d.p1 == e.p1 && d.p2 == e.p2 && d.k3 == e.k3 && c.width == camera_.width &&
           c.height == camera_.height && i.width == input_.width && i.height == input_.height &&
           i.focal == input_.focal;
  }

  Camera<double> camera_;
  NetworkInput input_;
  Pinhole<double> pinhole_;
  cv::Size reduced_;
  cv::Mat map_, fraction_, colour_, small_, warped_;
  cv::Mat_<std::uint8_t> inside_;
};

}  // namespace sslam
