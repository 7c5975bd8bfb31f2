// SPDX-License-Identifier: BSD-3-Clause
// Lenses that see more than a pinhole can, or bend it more than radial-tangential coefficients can say.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sslam/geometry/camera.hpp"

namespace sslam {

enum class WideModel {
  kFisheye,       // k1 to k4 of Kannala and Brandt, PAMI 2006, as OpenCV's fisheye module has them
  kFov,           // omega of Devernay and Faugeras, 2001
  kOmni,          // xi of Mei and Rives, ICRA 2007, then k1 k2 p1 p2 in its plane
  kDoubleSphere,  // xi, alpha of Usenko, Demmel and Cremers, 3DV 2018
  kUnified,       // alpha, beta of the extended unified model: Khomutenko, Garcia and Martinet, RA-L 2016
};

// A camera with such a lens.
struct WideLens {
  WideModel model = WideModel::kFisheye;
  std::array<double, 5> k{};  // in the order of the model; what it has not is 0
  Pinhole<double> pinhole;    // of the model's own plane, pixels
  int width = 0, height = 0;  // of the images, pixels

  // The pixel of a direction in the camera frame, of any length but 0. False where the model has none.
  [[nodiscard]] bool project(const Vec3<double>& direction, Vec2<double>& pixel) const noexcept {
    Vec2<double> bent;
    if (!bend(direction.normalized(), bent)) return false;
    pixel = pinhole.project({bent.x(), bent.y(), 1});
    return std::isfinite(pixel.x()) && std::isfinite(pixel.y());
  }

  [[nodiscard]] bool is_inside(const Vec2<double>& pixel) const noexcept {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width - 1 && pixel.y() <= height - 1;
  }

  // How far off its axis, in radians, the lens sees towards the unit vector `side` of the image plane: to the
  // image's edge, or to where the model turns back.
  [[nodiscard]] double reach(const Vec2<double>& side) const noexcept {
    constexpr double kStep = radians(0.25), kMost = radians(130.0);
    double seen = 0, before = 0;
    const Vec2<double> middle(pinhole.cx, pinhole.cy);
    for (double angle = kStep; angle < kMost; angle += kStep) {
      Vec2<double> pixel;
      const double sine = std::sin(angle);
      if (!project({sine * side.x(), sine * side.y(), std::cos(angle)}, pixel) || !is_inside(pixel)) break;
      const double away = (pixel - middle).norm();
      if (!(away > before)) break;
      before = away;
      seen = angle;
    }
    return seen;
  }

 private:
  // To the plane that `pinhole` makes pixels of.
  [[nodiscard]] bool bend(const Vec3<double>& ray, Vec2<double>& bent) const noexcept {
    const double r = ray.head<2>().norm(), angle = std::atan2(r, ray.z());
    const auto at = [&](double radius) {
      bent = r > 0 ? Vec2<double>(ray.head<2>() * (radius / r)) : Vec2<double>(0, 0);
      return true;
    };
    const auto over = [&](double z) {
      bent = ray.head<2>() / z;
      return z > 1e-6;
    };
    switch (model) {
      case WideModel::kFisheye: {
        const double a2 = angle * angle;
        return at(angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))));
      }
      case WideModel::kFov:
        // atan(2 tan(angle) tan(omega / 2)) / omega, on past a right angle.
        return at(std::atan2(2 * r * std::tan(k[0] / 2), ray.z()) / k[0]);
      case WideModel::kOmni: {
        if (!over(ray.z() + k[0])) return false;
        bent = RadTan<double>{k[1], k[2], k[3], k[4], 0}.distort(bent);
        return ray.z() > -std::min(k[0], 1 / k[0]);
      }
      case WideModel::kDoubleSphere: {
        const double z = k[0] + ray.z(), far = std::sqrt(r * r + z * z);
        return over(k[1] * far + (1 - k[1]) * z);
      }
      case WideModel::kUnified:
        return over(k[0] * std::sqrt(k[1] * r * r + ray.z() * ray.z()) + (1 - k[0]) * ray.z());
    }
    return false;
  }
};

}  // namespace sslam
