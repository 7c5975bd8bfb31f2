// SPDX-License-Identifier: BSD-3-Clause
// Depth of triangles in a pinhole's view: a z-buffer that keeps which triangle is the nearest in each pixel.
// Inverse depth is linear in the image, and so is the share of each corner in a ray (Olano and Greer 1997):
// both are exact at the middle of a pixel, and a triangle that reaches behind the camera needs no clipping.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/dense/dense_view.hpp"

namespace sslam::dense {

class DepthRaster {
 public:
  struct Surface {
    Vec3<double> inverse;  // inverse depth in pixel (u, v): inverse . (u, v, 1)
    Vec3<double> normal;   // camera frame, unit, towards the camera

    [[nodiscard]] double inverse_depth(const Vec2<double>& pixel) const {
      return inverse.dot(pixel.homogeneous());
    }
  };

  // Empties it for another view.
  void begin(const Pinhole<double>& pinhole, int width, int height) {
    pinhole_ = pinhole;
    width_ = width;
    height_ = height;
    surfaces_.clear();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    nearest_.assign(pixels, 0);
    shown_.assign(pixels, -1);
  }

  // A triangle in the camera frame, which is seen from both sides.
  void add(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
    constexpr double kFlat = 1e-12;
    const double volume = a.dot(b.cross(c));
    if (!(std::abs(volume) > kFlat * a.norm() * b.norm() * c.norm())) return;  // seen along its plane
    // Times (u, v, 1), by how much of each corner the pixel's ray with z = 1 is made up.
    const auto share = [&](const Vec3<double>& n) -> Vec3<double> { return ray_form(pinhole_, n) / volume; };
    const Vec3<double> shares[] = {share(b.cross(c)), share(c.cross(a)), share(a.cross(b))};
    const Vec3<double> normal = (b - a).cross(c - a).normalized();
    const Surface surface{shares[0] + shares[1] + shares[2], volume < 0 ? normal : Vec3<double>(-normal)};
    const auto id = static_cast<std::int32_t>(surfaces_.size());
    surfaces_.push_back(surface);
    const auto [top, bottom] = rows_of(a, b, c);
    for (int v = top; v <= bottom; ++v) {
      const auto [left, right] = columns_of(shares, v);
      for (int u = left; u <= right; ++u) {
        const double inverse = surface.inverse_depth({u, v});
        const std::size_t i = index(u, v);
        if (!(inverse > nearest_[i])) continue;
        nearest_[i] = inverse;
        shown_[i] = id;
      }
    }
  }

  // What the pixel nearest to a place in the image shows; null: nothing, or beyond the image.
  [[nodiscard]] const Surface* at(const Vec2<double>& pixel) const {
    const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < width_ - 0.5 &&
                        pixel.y() < height_ - 0.5;  // false of what is no number
    if (!inside) return nullptr;
    const std::int32_t id =
        shown_[index(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())))];
    return id < 0 ? nullptr : &surfaces_[static_cast<std::size_t>(id)];
  }

 private:
  struct Span {
    int first = 0, last = -1;
  };

  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  // All of them where the triangle reaches behind the camera.
  [[nodiscard]] Span rows_of(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) const {
    constexpr double kBefore = 1e-6;
    Span rows{0, height_ - 1};
    const double farthest = std::max({a.norm(), b.norm(), c.norm()});
    if (!(std::min({a.z(), b.z(), c.z()}) > kBefore * farthest)) return rows;
    const double v[] = {pinhole_.project(a).y(), pinhole_.project(b).y(), pinhole_.project(c).y()};
    const auto [low, high] = std::minmax_element(std::begin(v), std::end(v));
    rows.first = static_cast<int>(std::clamp(std::floor(*low), 0.0, static_cast<double>(height_)));
    rows.last = static_cast<int>(std::clamp(std::ceil(*high), -1.0, height_ - 1.0));
    return rows;
  }

  // Where no share is negative. A pixel on the edge between two triangles belongs to both.
  [[nodiscard]] Span columns_of(const Vec3<double> (&shares)[3], int v) const {
    constexpr double kOnEdge = 1e-7;  // pixels
    double low = 0, high = width_ - 1.0;
    for (const Vec3<double>& share : shares) {
      const double slope = share.x(), constant = share.y() * v + share.z();
      if (slope > 0) {
        low = std::max(low, -constant / slope - kOnEdge);
      } else if (slope < 0) {
        high = std::min(high, -constant / slope + kOnEdge);
      } else if (constant < 0) {
        return {};
      }
    }
    if (!(low <= high)) return {};
    return {static_cast<int>(std::ceil(low)), static_cast<int>(std::floor(high))};
  }

  Pinhole<double> pinhole_;
  int width_ = 0, height_ = 0;
  std::vector<Surface> surfaces_;
  std::vector<double> nearest_;  // inverse depth by pixel; 0: nothing
  std::vector<std::int32_t> shown_;
};

}  // namespace sslam::dense
