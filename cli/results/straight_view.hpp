// SPDX-License-Identifier: BSD-3-Clause
// The pinhole's view that holds all that a lens shows, and where each pixel of the lens lies in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sslam/geometry/camera.hpp"

namespace sslam::cli {

class StraightView {
 public:
  explicit StraightView(const Camera<double>& camera)
      : pinhole(camera.pinhole), width(camera.width), height(camera.height), columns_(camera.width) {
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    Vec2<double> low(0, 0), high(width - 1, height - 1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        Vec2<double> place(u, v), m;
        if (!camera.distortion.is_identity()) {
          const bool seen = camera.distortion.undistort(pinhole.unproject(place).head<2>(), m);
          place = seen ? pinhole.project({m.x(), m.y(), 1}) : Vec2<double>::Constant(nowhere);
          if (seen) {
            low = low.cwiseMin(place);
            high = high.cwiseMax(place);
          }
        }
        places_.push_back(place);
      }
    widen(low, high);
  }

  Pinhole<double> pinhole;
  int width, height;

  // Of a pixel of the lens; no numbers where the lens shows nothing, and perhaps beyond the view.
  [[nodiscard]] const Vec2<double>& place(int u, int v) const {
    return places_[static_cast<std::size_t>(v) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(u)];
  }

 private:
  // A lens that sees nearly to the side has no end in a pinhole's view: twice the image to either side do.
  void widen(const Vec2<double>& low, const Vec2<double>& high) {
    constexpr double kMost = 2;
    const auto whole = [](double least, double x, double most) {
      return static_cast<int>(std::clamp(x, least, most));
    };
    const int left = whole(-kMost * width, std::floor(low.x()), 0),
              top = whole(-kMost * height, std::floor(low.y()), 0),
              right = whole(width - 1, std::ceil(high.x()), (1 + kMost) * width),
              bottom = whole(height - 1, std::ceil(high.y()), (1 + kMost) * height);
    width = right - left + 1;
    height = bottom - top + 1;
    pinhole.cx -= left;
    pinhole.cy -= top;
    for (Vec2<double>& place : places_) place -= Vec2<double>(left, top);
  }

  int columns_;
  std::vector<Vec2<double>> places_;
};

}  // namespace sslam::cli
