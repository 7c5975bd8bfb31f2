// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera and its radial-tangential lens distortion (Brown 1966; the model of OpenCV).
#pragma once

#include <concepts>
#include <type_traits>

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

// The interface of a camera that the residuals need.
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

  [[nodiscard]] bool is_identity() const noexcept {
    return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0;
  }

  [[nodiscard]] Vec2<S> distort(const Vec2<S>& m) const noexcept {
    const S x = m.x(), y = m.y(), r2 = m.squaredNorm();
    const S radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  // d distort / d m.
  [[nodiscard]] Mat2<S> distort_jacobian(const Vec2<S>& m) const noexcept {
    const S x = m.x(), y = m.y(), r2 = m.squaredNorm();
    const S radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const S slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // the gradient of radial is slope times m
    Mat2<S> j;
    j(0, 0) = radial + slope * x * x + 2 * p1 * y + 6 * p2 * x;
    j(0, 1) = j(1, 0) = slope * x * y + 2 * p1 * x + 2 * p2 * y;
    j(1, 1) = radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
    return j;
  }

  // Inverse of distort by Newton's method. The valid field of the lens is where the distortion is monotonic.
  // False if no point of the valid field is seen at `distorted`; m is then the nearest point that the search
  // reached.
  [[nodiscard]] bool undistort(const Vec2<S>& distorted, Vec2<S>& m) const noexcept {
    m = distorted;
    if (is_identity()) return true;
    constexpr int kIterations = 30;
    constexpr S kExact = std::is_same_v<S, float> ? S(1e-6) : S(1e-12);
    Vec2<S> step = Vec2<S>::Zero();
    for (int i = 0; i < kIterations; ++i) {
      const Mat2<S> j = distort_jacobian(m);
      const S determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
      if (determinant > 0 && j.trace() > 0) {
        const Vec2<S> error = distort(m) - distorted;
        if (error.cwiseAbs().maxCoeff() < kExact * (1 + distorted.norm())) return true;
        step = Vec2<S>(j(1, 1) * error.x() - j(0, 1) * error.y(), j(0, 0) * error.y() - j(1, 0) * error.x()) /
               determinant;
        m -= step;
      } else {
        // Outside the valid field: go half way back.
        step /= 2;
        m += step;
      }
    }
    return false;
  }
};

template <Scalar S>
struct Camera {
  Pinhole<S> pinhole;
  RadTan<S> distortion;
  int width = 0, height = 0;  // pixels

  // From a pixel of the lens to the pixel of the ideal pinhole, and back. Beyond the lens's valid field, the
  // nearest point that RadTan::undistort reaches.
  [[nodiscard]] Vec2<S> undistort_pixel(const Vec2<S>& pixel) const noexcept {
    if (distortion.is_identity()) return pixel;
    Vec2<S> m;
    (void)distortion.undistort(pinhole.unproject(pixel).template head<2>(), m);
    return pinhole.project({m.x(), m.y(), S(1)});
  }
  [[nodiscard]] Vec2<S> distort_pixel(const Vec2<S>& pixel) const noexcept {
    const Vec2<S> m = distortion.distort(pinhole.unproject(pixel).template head<2>());
    return pinhole.project({m.x(), m.y(), S(1)});
  }
};

}  // namespace sslam
