// SPDX-License-Identifier: BSD-3-Clause
// A point from two or more views with known poses: linear start, Gauss-Newton on the reprojection errors, and
// a status that says why there is no usable depth.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/two_view/epipolar.hpp"

namespace sslam {

template <Scalar S>
struct PointView {
  SE3<S> cam_from_world;
  Vec2<S> normalised;    // undistorted, at depth 1
  S sigma = S(1) / 500;  // standard deviation of each coordinate: pixels over focal length
};

template <Scalar S>
struct PointTriangulationOptions {
  S min_parallax = radians(S(1));  // largest angle between two of the rays: less is kLowParallax
  S min_depth = S(1e-4);           // along z in every view, units of the map
  S max_error = 3;  // reprojection error of every view, standard deviations (98.9 % in two dimensions)
  int max_iterations = 8;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    // min_parallax is listed by the stage that triangulates, under a name of its own.
    visit("min_depth", self.min_depth, Unit::kNumber, 0, 1e6, "in every view, units of the map");
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "reprojection error in every view, standard deviations");
    visit("max_iterations", self.max_iterations, Unit::kCount, 1, 1000, "of the refinement");
  }
};
static_assert(Described<PointTriangulationOptions<double>>);

template <Scalar S>
struct PointTriangulation {
  Status status = Status::kTooFew;
  Vec3<S> point = Vec3<S>::Zero();       // world
  Mat3<S> covariance = Mat3<S>::Zero();  // of the point, for the stated sigmas
  S parallax = 0;                        // largest angle between two of the rays, rad
  S max_error = 0;                       // largest reprojection error of a view, standard deviations
};

namespace detail {

template <Scalar S>
[[nodiscard]] Vec3<S> centre(const SE3<S>& cam_from_world) noexcept {
  return -(cam_from_world.rotation.inverse() * cam_from_world.translation);
}

template <Scalar S>
[[nodiscard]] Vec3<S> world_ray(const PointView<S>& view) noexcept {
  return view.cam_from_world.rotation.inverse() *
         Vec3<S>(view.normalised.x(), view.normalised.y(), 1).normalized();
}

template <Scalar S>
[[nodiscard]] S largest_parallax(std::span<const PointView<S>> views) noexcept {
  S sine2 = 0, cosine = 1;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vec3<S> ray = world_ray(views[i]);
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const Vec3<S> other = world_ray(views[j]);
      const S s = ray.cross(other).squaredNorm(), c = ray.dot(other);
      if (c < cosine) sine2 = s, cosine = c;
    }
  }
  return std::atan2(std::sqrt(sine2), cosine);
}

// The point nearest to all rays, relative to `origin`: sum of (I - d d^T)(X - c) = 0 (midpoint, for two
// views).
template <Scalar S>
[[nodiscard]] bool nearest_to_rays(std::span<const PointView<S>> views, const Vec3<S>& origin,
                                   Vec3<S>& x) noexcept {
  Mat3<S> a = Mat3<S>::Zero();
  Vec3<S> b = Vec3<S>::Zero();
  for (const PointView<S>& view : views) {
    const Vec3<S> d = world_ray(view);
    const Vec3<S> c = centre(view.cam_from_world) - origin;
    a += Mat3<S>::Identity() - d * d.transpose();
    b += c - d * d.dot(c);
  }
  const Eigen::LLT<Mat3<S>> factor(a);
  if (factor.info() != Eigen::Success) return false;
  x = factor.solve(b);
  return x.allFinite();
}

// Weighted squared reprojection errors and their normal equations at x, relative to `origin`.
template <Scalar S>
struct PointEquations {
  Mat3<S> h = Mat3<S>::Zero();
  Vec3<S> g = Vec3<S>::Zero();
  S cost = 0, worst = 0;  // squares, variances
  bool in_front = true;

  PointEquations(std::span<const PointView<S>> views, const Vec3<S>& origin, const Vec3<S>& x,
                 S min_depth) noexcept {
    for (const PointView<S>& view : views) {
      const Mat3<S> R = view.cam_from_world.rotation.matrix();
      const Vec3<S> p = R * x + (R * origin + view.cam_from_world.translation);
      if (!(p.z() > min_depth)) {
        in_front = false;
        return;
      }
      const S scale = 1 / (p.z() * view.sigma);
      const Vec2<S> seen = p.template head<2>() / p.z();
      const Vec2<S> r = (view.normalised - seen) / view.sigma;
      const Mat<S, 2, 3> j = scale * (R.template topRows<2>() - seen * R.row(2));  // d (-r) / d x
      h += j.transpose() * j;
      g += j.transpose() * r;
      cost += r.squaredNorm();
      worst = std::max(worst, r.squaredNorm());
    }
  }
};

}  // namespace detail

// min over X of  sum |normalised_i - pi(T_i X)|^2 / sigma_i^2. kLowParallax before anything is solved;
// kBehind when X lies behind a camera; kNoConsensus when one view disagrees with the rest.
template <Scalar S>
[[nodiscard]] PointTriangulation<S> triangulate_point(
    std::span<const PointView<S>> views, const PointTriangulationOptions<S>& options = {}) noexcept {
  PointTriangulation<S> result;
  const auto refuse = [&](Status status) {
    result.status = status;
    return result;
  };
  for (const PointView<S>& view : views)
    if (!view.cam_from_world.translation.allFinite() || !view.cam_from_world.rotation.matrix().allFinite() ||
        !view.normalised.allFinite() || !std::isfinite(view.sigma) || !(view.sigma > 0))
      return refuse(Status::kNotFinite);
  if (views.size() < 2) return result;
  result.parallax = detail::largest_parallax(views);
  if (result.parallax < options.min_parallax) return refuse(Status::kLowParallax);

  // Relative to the first camera, so that a float keeps its digits far from the origin of the map.
  const Vec3<S> origin = detail::centre(views[0].cam_from_world);
  Vec3<S> x;
  if (!detail::nearest_to_rays(views, origin, x)) return refuse(Status::kLowParallax);
  detail::PointEquations<S> now(views, origin, x, options.min_depth);
  if (!now.in_front) return refuse(Status::kBehind);
  for (int i = 0; i < options.max_iterations; ++i) {
    const Eigen::LLT<Mat3<S>> factor(now.h);
    if (factor.info() != Eigen::Success) break;
    const Vec3<S> step = factor.solve(now.g);
    const detail::PointEquations<S> next(views, origin, x + step, options.min_depth);
    if (!next.in_front || !(next.cost < now.cost)) break;
    const bool settled = now.cost - next.cost < S(1e-4);  // variances
    x += step;
    now = next;
    if (settled) break;
  }
  result.max_error = std::sqrt(now.worst);
  if (!inverse_of<S, 3>(now.h, result.covariance)) return refuse(Status::kLowParallax);
  result.point = x + origin;
  return refuse(result.max_error > options.max_error ? Status::kNoConsensus : Status::kOk);
}

// Two views: the point and its covariance are in the frame of camera 0.
template <Scalar S>
[[nodiscard]] PointTriangulation<S> triangulate_point(
    const BearingMatch<S>& match, const SE3<S>& cam1_from_cam0,
    const PointTriangulationOptions<S>& options = {}) noexcept {
  const std::array<PointView<S>, 2> views{
      PointView<S>{{}, match.ray0.template head<2>(), match.sigma},
      PointView<S>{cam1_from_cam0, match.ray1.template head<2>(), match.sigma}};
  return triangulate_point(std::span<const PointView<S>>(views), options);
}

}  // namespace sslam
