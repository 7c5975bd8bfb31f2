// SPDX-License-Identifier: BSD-3-Clause
// Other models of a lens as radial-tangential ones: within the image of a lens that is not too wide, the
// five coefficients come as near as a fraction of a pixel.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sslam/geometry/camera.hpp"

namespace sslam {
namespace detail {

// One ray, undistorted and as the lens shows it; normalised coordinates.
struct LensSample {
  Vec2<double> straight, seen;
};

// The tilt of the sensor about x and y, radians, as OpenCV's calibration module has it.
[[nodiscard]] inline Vec2<double> tilted(double tau_x, double tau_y, const Vec2<double>& m) {
  const double cx = std::cos(tau_x), sx = std::sin(tau_x), cy = std::cos(tau_y), sy = std::sin(tau_y);
  Mat3<double> about_x, about_y;
  about_x << 1, 0, 0, 0, cx, sx, 0, -sx, cx;
  about_y << cy, 0, -sy, 0, 1, 0, sy, 0, cy;
  const Mat3<double> turn = about_y * about_x;
  Mat3<double> onto = Mat3<double>::Identity();
  onto(0, 0) = onto(1, 1) = turn(2, 2);
  onto(0, 2) = -turn(0, 2);
  onto(1, 2) = -turn(1, 2);
  const Vec3<double> seen = onto * turn * Vec3<double>(m.x(), m.y(), 1);
  return seen.head<2>() / seen.z();
}

// k1 k2 p1 p2 k3 k4 k5 k6 of OpenCV's rational model, s1 to s4 of a thin prism, tau_x and tau_y of a tilt.
[[nodiscard]] inline LensSample rational_sample(const std::array<double, 14>& k, const Vec2<double>& m) {
  const double r2 = m.squaredNorm();
  const RadTan<double> above{k[0], k[1], 0, 0, k[4]}, below{k[5], k[6], 0, 0, k[7]},
      sideways{0, 0, k[2], k[3], 0};
  const double factor = (1 + r2 * (above.k1 + r2 * (above.k2 + r2 * above.k3))) /
                        (1 + r2 * (below.k1 + r2 * (below.k2 + r2 * below.k3)));
  const Vec2<double> prism(r2 * (k[8] + r2 * k[9]), r2 * (k[10] + r2 * k[11]));
  const Vec2<double> seen = m * factor + sideways.distort(m) - m + prism;
  return {m, k[12] == 0 && k[13] == 0 ? seen : tilted(k[12], k[13], seen)};
}

// k1 to k4 of Kannala and Brandt 2006, as OpenCV's fisheye module has them.
[[nodiscard]] inline LensSample fisheye_sample(const std::array<double, 4>& k, const Vec2<double>& m) {
  const double r = m.norm(), angle = std::atan(r), a2 = angle * angle;
  const double bent = angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
  return {m, r > 0 ? Vec2<double>(m * (bent / r)) : m};
}

// Devernay and Faugeras 2001, as PTAM and DSO have it.
[[nodiscard]] inline LensSample fov_sample(double omega, const Vec2<double>& m) {
  const double r = m.norm(), bent = std::atan(2 * r * std::tan(omega / 2)) / omega;
  return {m, r > 0 ? Vec2<double>(m * (bent / r)) : m};
}

struct LensFit {
  RadTan<double> lens;
  double worst = 0;     // pixels, within the image
  bool covers = false;  // false: the image shows more than a pinhole can, or the lens turns back in it
};

// Least squares over rays that fill the image of `camera`, whose lens is not asked. sample(m) is a LensSample
// of which one grows with m.
template <class Sample>
[[nodiscard]] LensFit fit_lens(const Camera<double>& camera, const Sample& sample) {
  constexpr int kDirections = 48;
  constexpr double kStep = radians(1.0), kSteepest = radians(72.0);  // off the optical axis
  LensFit fit;
  std::vector<LensSample> samples;
  for (int i = 0; i < kDirections; ++i) {
    const double around = 2 * std::numbers::pi * i / kDirections;
    const Vec2<double> direction(std::cos(around), std::sin(around));
    LensSample before{Vec2<double>::Zero(), Vec2<double>::Zero()};
    for (double angle = kStep;; angle += kStep) {
      const LensSample now = sample(Vec2<double>(std::tan(angle) * direction));
      if (angle > kSteepest || !(now.seen.norm() > before.seen.norm()) ||
          !(now.straight.norm() > before.straight.norm()))
        return fit;
      samples.push_back(now);
      const Vec2<double> pixel = camera.pinhole.project({now.seen.x(), now.seen.y(), 1});
      if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > camera.width - 0.5 ||
          pixel.y() > camera.height - 0.5)
        break;
      before = now;
    }
  }
  Mat<double, 5, 5> normal = Mat<double, 5, 5>::Zero();
  Vec<double, 5> right = Vec<double, 5>::Zero();
  const std::array<RadTan<double>, 5> units{
      {{1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {0, 0, 1, 0, 0}, {0, 0, 0, 1, 0}, {0, 0, 0, 0, 1}}};
  for (const auto& [m, seen] : samples) {
    Mat<double, 2, 5> row;
    for (Eigen::Index j = 0; j < 5; ++j) row.col(j) = units[static_cast<std::size_t>(j)].distort(m) - m;
    const double weight = m.norm();  // rays of a ring stand for its area
    normal += weight * row.transpose() * row;
    right += weight * row.transpose() * (seen - m);
  }
  const Vec<double, 5> k = normal.ldlt().solve(right);
  fit.lens = {k[0], k[1], k[2], k[3], k[4]};
  fit.covers = true;
  for (const auto& [m, seen] : samples) {
    const Vec2<double> off = fit.lens.distort(m) - seen;
    fit.worst = std::max(fit.worst, std::hypot(off.x() * camera.pinhole.fx, off.y() * camera.pinhole.fy));
  }
  return fit;
}

}  // namespace detail
}  // namespace sslam
