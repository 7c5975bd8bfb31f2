// SPDX-License-Identifier: BSD-3-Clause
// The similarity that brings one list of points closest to another: Umeyama, TPAMI 1991, eqs. 39-43.
#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"
#include "sslam/geometry/sim3.hpp"

namespace sslam::io {

enum class Alignment { kNone, kSe3, kSim3 };

[[nodiscard]] constexpr std::string_view name(Alignment alignment) noexcept {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kSe3:
      return "se3";
    case Alignment::kSim3:
      return "sim3";
  }
  return "";
}

// Root mean square distance from the middle.
[[nodiscard]] inline double spread_of(std::span<const Vec3<double>> points) {
  Vec3<double> mean = Vec3<double>::Zero();
  for (const Vec3<double>& point : points) mean += point / static_cast<double>(points.size());
  double sum = 0;
  for (const Vec3<double>& point : points) sum += (point - mean).squaredNorm();
  return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}

// Whether what moves is less than numbers of this size can tell, or nothing beside what the other does.
[[nodiscard]] inline bool stands_still(std::span<const Vec3<double>> points, double other_spread) {
  constexpr double kRounding = 1e-8, kNothing = 1e-4;
  double size = 0;
  for (const Vec3<double>& point : points) size = std::max(size, point.norm());
  const double spread = spread_of(points);
  return spread <= kRounding * size || spread <= kNothing * other_spread;
}

// Least squares over x' = s R x + t: x in `from`, x' in `to`, in equal numbers. With points on one line, the
// turn about that line is arbitrary. Throws Error with fewer than 3 points, or without any motion to fix a
// scale.
[[nodiscard]] inline Sim3<double> align(std::span<const Vec3<double>> from, std::span<const Vec3<double>> to,
                                        Alignment alignment) {
  Sim3<double> to_from;
  to_from.scale = 1;
  to_from.translation.setZero();
  if (alignment == Alignment::kNone) return to_from;
  if (from.size() != to.size() || from.size() < 3) {
    throw Error("alignment needs at least 3 pairs of poses, found " + std::to_string(from.size()));
  }

  const double n = static_cast<double>(from.size());
  Vec3<double> from_mean = Vec3<double>::Zero();
  Vec3<double> to_mean = Vec3<double>::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i] / n;
    to_mean += to[i] / n;
  }
  Mat3<double> covariance = Mat3<double>::Zero();
  double variance = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += (to[i] - to_mean) * (from[i] - from_mean).transpose() / n;
    variance += (from[i] - from_mean).squaredNorm() / n;
  }
  const Eigen::JacobiSVD<Mat3<double>> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3<double> sign = Vec3<double>::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign.z() = -1;
  to_from.rotation = SO3<double>::from_matrix(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose());
  if (alignment == Alignment::kSim3) {
    // With one that stands still the scale is that of its noise, and may fit by chance.
    if (stands_still(from, spread_of(to)))
      throw Error("alignment with scale needs motion: the estimate stands still");
    to_from.scale = svd.singularValues().dot(sign) / variance;
    if (stands_still(to, spread_of(from)) || !(to_from.scale > 0))
      throw Error("alignment with scale needs motion: the ground truth stands still");
  }
  to_from.translation = to_mean - to_from.scale * (to_from.rotation * from_mean);
  return to_from;
}

}  // namespace sslam::io
