// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera and its radial-tangential lens distortion (Brown 1966; the model of OpenCV).
#pragma once

#include <cmath>
#include <concepts>

#include "sslam/core/types.hpp"

namespace sslam {

template <Scalar S>
struct Pinhole {
  S fx = 1, fy = 1, cx = 0, cy = 0;  // pixels

  // Camera frame to pixel; z must not be 0.
  [[nodiscard]] Vec2<S> project(const Vec3<S>& x) const noexcept {
    return {fx * x.x() / x.z() + cx, fy * x.y() / x.z() + cy};
  }
  // Pixel to normalised coordinates (x, y, 1).
  [[nodiscard]] Vec3<S> unproject(const Vec2<S>& pixel) const noexcept {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, S(1)};
  }
  // d project / d x, pixels per unit of x.
  [[nodiscard]] Mat<S, 2, 3> project_jacobian(const Vec3<S>& x) const noexcept {
    const S inverse_z = 1 / x.z();
    Mat<S, 2, 3> j;
    j << fx * inverse_z, 0, -fx * x.x() * inverse_z * inverse_z, 0, fy * inverse_z,
        -fy * x.y() * inverse_z * inverse_z;
    return j;
  }
};

// What the residuals ask of a camera.
template <class C, class S>
concept CameraModel = requires(const C camera, const Vec3<S>& x, const Vec2<S>& pixel) {
  { camera.project(x) } -> std::convertible_to<Vec2<S>>;
  { camera.unproject(pixel) } -> std::convertible_to<Vec3<S>>;
  { camera.project_jacobian(x) } -> std::convertible_to<Mat<S, 2, 3>>;
};
static_assert(CameraModel<Pinhole<float>, float> && CameraModel<Pinhole<double>, double>);

// Distortion acts on normalised coordinates.
template <Scalar S>
struct RadTan {
  S k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  [[nodiscard]] bool is_identity() const noexcept { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }

  [[nodiscard]] Vec2<S> distort(const Vec2<S>& m) const noexcept {
    const S x = m.x(), y = m.y(), r2 = m.squaredNorm();
    const S radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  // Inverse of distort by fixed-point iteration; where it does not settle, beyond the lens's valid field, the last
  // finite iterate.
  [[nodiscard]] Vec2<S> undistort(const Vec2<S>& distorted) const noexcept {
    if (is_identity()) return distorted;
    constexpr int kIterations = 20;
    Vec2<S> m = distorted;
    for (int i = 0; i < kIterations; ++i) {
      const Vec2<S> next = m - (distort(m) - distorted);
      if (!next.allFinite() || next.squaredNorm() > 100) break;
      const bool settled = (next - m).squaredNorm() < S(1e-14);
      m = next;
      if (settled) break;
    }
    return m;
  }
};

template <Scalar S>
struct Camera {
  Pinhole<S> pinhole;
  RadTan<S> distortion;
  int width = 0, height = 0;  // pixels

  // A pixel of the lens to the pixel of the ideal pinhole, and back.
  [[nodiscard]] Vec2<S> undistort_pixel(const Vec2<S>& pixel) const noexcept {
    if (distortion.is_identity()) return pixel;
    const Vec2<S> m = distortion.undistort(pinhole.unproject(pixel).template head<2>());
    return pinhole.project({m.x(), m.y(), S(1)});
  }
  [[nodiscard]] Vec2<S> distort_pixel(const Vec2<S>& pixel) const noexcept {
    const Vec2<S> m = distortion.distort(pinhole.unproject(pixel).template head<2>());
    return pinhole.project({m.x(), m.y(), S(1)});
  }
};

}  // namespace sslam
