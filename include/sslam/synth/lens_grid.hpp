// SPDX-License-Identifier: BSD-3-Clause
// Where each pixel of a lens's image lies in the plane of a pinhole: what a lens bends is rendered there,
// point by point, and nothing is resampled.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/synth/face_view.hpp"

namespace sslam::synth {

struct LensPoint {
  Vec2<float> place;                             // pixels of the plane
  Mat2<float> spread = Mat2<float>::Identity();  // d place / d pixel of the image
};

class LensGrid {
 public:
  // The part of the plane that some rows of the image show, with a margin for edges that pass beside it.
  struct Part {
    View view;
    Vec2<float> corner;
  };

  LensGrid() = default;  // no distortion
  explicit LensGrid(const Camera<double>& camera) : width_(camera.width) {
    if (!camera.distortion.is_identity()) fill(camera);
  }

  // False where pixels show nothing in the lens's valid field, or so much that no raster holds it.
  [[nodiscard]] bool usable() const noexcept { return usable_; }

  // Of rows top to bottom (exclusive) of an image with the view's pinhole and pose.
  [[nodiscard]] Part part(const View& image, int top, int bottom) const {
    constexpr int kMargin = 3;
    if (points_.empty()) {
      const double first = top - kMargin;
      Pinhole<double> pinhole = image.pinhole;
      pinhole.cy -= first;
      return {{pinhole, image.width, bottom - top + 2 * kMargin, image.cam_from_world},
              {0.0f, static_cast<float>(first)}};
    }
    const auto row = [&](int y) { return points_.begin() + static_cast<std::ptrdiff_t>(y) * width_; };
    Vec2<float> low = row(top)->place, high = low;
    std::for_each(row(top), row(bottom), [&](const LensPoint& point) {
      low = low.cwiseMin(point.place);
      high = high.cwiseMax(point.place);
    });
    const Vec2<float> corner(std::floor(low.x()) - kMargin, std::floor(low.y()) - kMargin);
    Pinhole<double> pinhole = plane_;
    pinhole.cx -= static_cast<double>(corner.x());
    pinhole.cy -= static_cast<double>(corner.y());
    const Vec2<float> size = high - corner;
    return {{pinhole, static_cast<int>(size.x()) + kMargin, static_cast<int>(size.y()) + kMargin,
             image.cam_from_world},
            corner};
  }

  // A pixel of the image, in pixels of the part.
  [[nodiscard]] LensPoint at(int x, int y, const Part& part) const noexcept {
    if (points_.empty()) return {Vec2<float>(static_cast<float>(x), static_cast<float>(y)) - part.corner};
    LensPoint point = points_[static_cast<std::size_t>(y) * width_ + x];
    point.place -= part.corner;
    return point;
  }

 private:
  // The plane is as coarse as the pixel that shows most of it: no pixel then covers more than one of its own.
  void fill(const Camera<double>& camera) {
    constexpr double kMost = 4.0;
    double widest = 1.0;
    points_.resize(static_cast<std::size_t>(camera.width) * camera.height);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        Vec2<double> ray;
        usable_ = usable_ && camera.distortion.undistort(camera.pinhole.unproject({x, y}).head<2>(), ray);
        if (!usable_) return;
        const Mat2<double> spread = camera.distortion.distort_jacobian(ray).inverse();
        widest = std::max(widest, spread.colwise().norm().maxCoeff());
        points_[static_cast<std::size_t>(y) * width_ + x] = {ray.cast<float>(), spread.cast<float>()};
      }
    }
    usable_ = widest < kMost;
    plane_ = {camera.pinhole.fx / widest, camera.pinhole.fy / widest, 0.0, 0.0};
    const Vec2<float> scale(static_cast<float>(plane_.fx), static_cast<float>(plane_.fy));
    for (LensPoint& point : points_) {
      point.place = point.place.cwiseProduct(scale);
      point.spread /= static_cast<float>(widest);
    }
  }

  int width_ = 0;
  bool usable_ = true;
  Pinhole<double> plane_;
  std::vector<LensPoint> points_;  // empty without distortion
};

}  // namespace sslam::synth
