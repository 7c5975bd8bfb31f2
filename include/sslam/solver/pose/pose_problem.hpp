// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of one camera's pose: observed points and lines of the map, and a prior on the
// rotation.
#pragma once

#include <cstdint>
#include <span>

#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/loss.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/least_squares/levenberg_marquardt.hpp"
#include "sslam/solver/pose/rotation_prior.hpp"

namespace sslam {

template <Scalar S>
struct PointObservation {
  Vec3<S> point_world;
  Vec2<S> pixel;  // undistorted
  S sigma = 1;    // of each coordinate, pixels
};

template <Scalar S>
struct LineObservation {
  Line3<S> line_world;
  Segment2<S> segment;  // undistorted, pixels
  S sigma = 1;          // of an end across the segment, pixels
};

namespace detail {

// The pose as a state with three degrees of freedom.
template <Scalar S>
struct TranslationState {
  using ScalarType = S;
  static constexpr int kDof = 3;
  SE3<S> pose;
  [[nodiscard]] TranslationState retract(const Vec3<S>& rho) const noexcept {
    return {{pose.rotation, pose.translation + rho}};
  }
};

template <Scalar S>
[[nodiscard]] const SE3<S>& pose_of(const SE3<S>& pose) noexcept {
  return pose;
}
template <Scalar S>
[[nodiscard]] const SE3<S>& pose_of(const TranslationState<S>& state) noexcept {
  return state.pose;
}

template <Scalar S>
struct PoseProblem {
  const Pinhole<S>& pinhole;
  std::span<const PointObservation<S>> points;
  std::span<const LineObservation<S>> lines;
  std::span<const std::uint8_t> point_inliers, line_inliers;
  const RotationPrior<S>* prior;
  HuberLoss<S> loss;
  HuberLoss<S> prior_loss;

  template <class X>
  Evaluated<S> operator()(const X& x, NormalEquations<S, X::kDof>& equations) const noexcept {
    constexpr int D = X::kDof;
    const SE3<S>& pose = pose_of(x);
    Evaluated<S> sum;
    PointReprojection<S> point;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!point_inliers[i] ||
          !point_reprojection(pinhole, pose, points[i].point_world, points[i].pixel, point))
        continue;
      const S inverse = 1 / (points[i].sigma * points[i].sigma);
      if constexpr (D == 6)
        add<D>(point.error, point.wrt_pose(), inverse, sum, equations);
      else
        add<D>(point.error, point.wrt_translation(), inverse, sum, equations);
    }
    LineReprojection<S> line;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!line_inliers[i] || !line_reprojection(pinhole, pose, lines[i].line_world, lines[i].segment, line))
        continue;
      const S inverse = 1 / (lines[i].sigma * lines[i].sigma);
      if constexpr (D == 6)
        add<D>(line.error, line.wrt_pose(), inverse, sum, equations);
      else
        add<D>(line.error, line.wrt_translation(), inverse, sum, equations);
    }
    if constexpr (D == 6)
      if (prior != nullptr) add_prior(pose, sum, equations);
    return sum;
  }

 private:
  template <int D>
  void add(const Vec2<S>& error, const Mat<S, 2, D>& jacobian, S inverse_variance, Evaluated<S>& sum,
           NormalEquations<S, D>& equations) const noexcept {
    const S squared = error.squaredNorm() * inverse_variance;
    sum.cost += loss.rho(squared);
    ++sum.count;
    const S w = inverse_variance * loss.weight(squared);
    for (int i = 0; i < 2; ++i) equations.add(jacobian.row(i), error[i], w);
  }

  // e = Log(R R_prior^-1), d e / d phi = J^-1(e).
  void add_prior(const SE3<S>& pose, Evaluated<S>& sum, NormalEquations<S, 6>& equations) const noexcept {
    const Vec3<S> e = (pose.rotation * prior->cam_from_world.inverse()).log();
    const Vec3<S> weighted = prior->information * e;
    const S squared = e.dot(weighted);
    sum.cost += prior_loss.rho(squared);
    const S w = prior_loss.weight(squared);
    const Mat3<S> j = left_jacobian_inverse(e);
    equations.H.template topLeftCorner<3, 3>() += w * (j.transpose() * prior->information * j);
    equations.g.template head<3>() += w * (j.transpose() * weighted);
  }
};

// Marks what agrees with the pose within the gate; returns the number that does.
template <Scalar S>
[[nodiscard]] int classify(const Pinhole<S>& pinhole, std::span<const PointObservation<S>> points,
                           std::span<const LineObservation<S>> lines, const SE3<S>& pose, S gate,
                           std::span<std::uint8_t> point_inliers,
                           std::span<std::uint8_t> line_inliers) noexcept {
  int inliers = 0;
  PointReprojection<S> point;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool in = point_reprojection(pinhole, pose, points[i].point_world, points[i].pixel, point) &&
                    point.error.squaredNorm() <= gate * points[i].sigma * points[i].sigma;
    point_inliers[i] = in;
    inliers += in;
  }
  LineReprojection<S> line;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool in = line_reprojection(pinhole, pose, lines[i].line_world, lines[i].segment, line) &&
                    line.error.squaredNorm() <= gate * lines[i].sigma * lines[i].sigma;
    line_inliers[i] = in;
    inliers += in;
  }
  return inliers;
}

template <Scalar S>
[[nodiscard]] bool all_finite(std::span<const PointObservation<S>> points,
                              std::span<const LineObservation<S>> lines, const SE3<S>& pose) noexcept {
  bool finite = pose.translation.allFinite() && pose.rotation.quaternion().coeffs().allFinite();
  for (const auto& p : points)
    finite &= p.point_world.allFinite() && p.pixel.allFinite() && std::isfinite(p.sigma);
  for (const auto& l : lines)
    finite &= l.line_world.moment.allFinite() && l.line_world.direction.allFinite() &&
              l.segment.start.allFinite() && l.segment.end.allFinite() && std::isfinite(l.sigma);
  return finite;
}

}  // namespace detail

}  // namespace sslam
