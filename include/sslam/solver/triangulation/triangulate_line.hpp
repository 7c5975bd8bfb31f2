// SPDX-License-Identifier: BSD-3-Clause
// A line from two or more views with known poses: meeting of the interpretation planes, then
// Levenberg-Marquardt on the distances of the observed ends, with all four degrees of freedom or along a
// known direction.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/triangulation/line_problem.hpp"

namespace sslam {

template <Scalar S>
struct LineTriangulationOptions {
  S min_parallax = radians(
      S(2));  // largest angle between two interpretation planes: less, or within the noise, is kLowParallax
  S max_relative_sigma = S(0.2);  // uncertainty of an end over its distance: more is kLowParallax
  S max_error = S(3);             // distance of an observed end from the projected line, standard deviations
  S min_depth = S(1e-4);          // along z of the seen ends in each view, units of the map
  S max_stretch = 30;             // length over distance from the nearest camera: more is kDegenerate
  LmOptions solver;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    // min_parallax is listed by the stage that triangulates, under a name of its own.
    visit("max_relative_sigma", self.max_relative_sigma, Unit::kNumber, 0, 10,
          "uncertainty of an end over its distance");
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "distance of a seen end from the projected line, standard deviations");
    visit("min_depth", self.min_depth, Unit::kNumber, 0, 1e6,
          "of the seen ends in every view, units of the map");
    visit("max_stretch", self.max_stretch, Unit::kNumber, 0, 1e6,
          "length over the distance from the nearest camera");
    visit_within("solver.", self.solver, visit);
  }
};
static_assert(Described<LineTriangulationOptions<double>>);

template <Scalar S>
struct LineTriangulation {
  Status status = Status::kTooFew;
  Line3<S> line;                    // world; its direction is that of the first view's segment, start to end
  Vec3<S> start = Vec3<S>::Zero();  // world, on the line: the ends of all that the views show of it
  Vec3<S> end = Vec3<S>::Zero();
  Mat3<S> covariance = Mat3<S>::Zero();  // of the middle of that stretch, across the line (rank 2)
  S parallax = 0;                        // largest angle between two interpretation planes, rad
  S max_error = 0;                       // largest distance of an observed end, standard deviations
  S overlap = 0;  // what all views show, over the shortest stretch that one of them shows
};

namespace detail {

// Trims the line to what the views show of it, turns it the way the first of them does, and checks that they
// can. `line` is relative to the origin.
template <Scalar S>
[[nodiscard]] Status trim(std::span<const LineView<S>> views, const Vec3<S>& origin, Line3<S> line,
                          const LineTriangulationOptions<S>& options, LineTriangulation<S>& result) noexcept {
  if (!seen_stretch(LineGeometry<S>(views[0], origin), line, options.min_depth).forward)
    line = {-line.moment, -line.direction};
  constexpr S kFar = std::numeric_limits<S>::max();
  S low = kFar, high = -kFar, common_low = -kFar, common_high = kFar, shortest = kFar, distance = kFar;
  for (const LineView<S>& view : views) {
    const LineGeometry<S> geometry(view, origin);
    const LineStretch<S> stretch = seen_stretch(geometry, line, options.min_depth);
    if (!stretch.in_front) return Status::kBehind;
    if (!stretch.bounded) return Status::kDegenerate;
    low = std::min(low, stretch.low);
    high = std::max(high, stretch.high);
    common_low = std::max(common_low, stretch.low);
    common_high = std::min(common_high, stretch.high);
    shortest = std::min(shortest, stretch.high - stretch.low);
    distance = std::min(distance, (line.point_closest_to(geometry.centre) - geometry.centre).norm());
  }
  if (!(high - low < options.max_stretch * distance) || !(shortest > 0)) return Status::kDegenerate;
  const Vec3<S> foot = line.closest_point_to_origin() + origin;
  result.start = foot + low * line.direction;
  result.end = foot + high * line.direction;
  result.overlap = std::max(common_high - common_low, S(0)) / shortest;
  result.line = {line.moment + origin.cross(line.direction), line.direction};
  return Status::kOk;
}

// From a start to the result: minimise, check, trim, judge the uncertainty.
template <Scalar S, class Line>
[[nodiscard]] Status finish(std::span<const LineView<S>> views, const Vec3<S>& origin, Line line,
                            const LineTriangulationOptions<S>& options,
                            LineTriangulation<S>& result) noexcept {
  constexpr int D = Line::kDof;
  const LineProblem<S> problem{views, origin};
  const LmSummary<S, D> summary = minimize(problem, line, options.solver);
  if (summary.status != Status::kOk && summary.status != Status::kNotConverged) return Status::kDegenerate;
  const Line3<S> found = line_of(line);
  result.max_error = problem.largest_error(found);
  const Status trimmed = trim(views, origin, found, options, result);
  if (trimmed != Status::kOk) return trimmed;
  Mat<S, D, D> line_covariance;
  if (!inverse_of<S, D>(summary.information, line_covariance)) return Status::kLowParallax;
  const auto covariance = [&](const Vec3<S>& at) -> Mat3<S> {
    const Mat<S, 3, D> j = across_jacobian(line, Vec3<S>(at - origin));
    return j * line_covariance * j.transpose();
  };
  result.covariance = covariance((result.start + result.end) / 2);
  for (const Vec3<S>& end : {result.start, result.end}) {
    const S distance = (end - origin).norm();
    if (!(covariance(end).trace() < std::pow(options.max_relative_sigma * distance, 2)))
      return Status::kLowParallax;
  }
  return result.max_error > options.max_error ? Status::kNoConsensus : Status::kOk;
}

template <Scalar S>
[[nodiscard]] Status check(std::span<const LineView<S>> views) noexcept {
  for (const LineView<S>& view : views)
    if (!is_finite(view)) return Status::kNotFinite;
  if (views.size() < 2) return Status::kTooFew;
  for (const LineView<S>& view : views)
    if (!(view.segment.length() > view.sigma)) return Status::kDegenerate;
  return Status::kOk;
}

}  // namespace detail

// min over the line of  sum dist(end_i, proj_i(line))^2 / sigma_i^2  (Bartoli and Sturm, CVIU 2005). A line
// in or near an epipolar plane has parallel interpretation planes: kLowParallax.
template <Scalar S>
[[nodiscard]] LineTriangulation<S> triangulate_line(
    std::span<const LineView<S>> views, const LineTriangulationOptions<S>& options = {}) noexcept {
  LineTriangulation<S> result;
  result.status = detail::check(views);
  if (!usable(result.status)) return result;
  const Vec3<S> origin = LineGeometry<S>(views[0], Vec3<S>::Zero()).centre;
  const auto plane = [&](const LineView<S>& view) {
    return detail::ViewPlane<S>(LineGeometry<S>(view, origin));
  };
  result.parallax = detail::plane_parallax(views, plane);
  result.status = Status::kLowParallax;
  if (result.parallax < options.min_parallax) return result;

  Mat3<S> normals = Mat3<S>::Zero();
  for (const LineView<S>& view : views) {
    const Vec3<S> n = plane(view).normal;
    normals += n * n.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3<S>> eigen(normals);
  const Vec3<S> direction = eigen.eigenvectors().col(0);
  const Mat<S, 3, 2> basis = tangent_basis(direction);
  Vec2<S> place;
  if (!detail::place_across(views, origin, basis, plane, place)) return result;
  const Vec3<S> foot = basis * place;
  result.status = detail::finish(views, origin, Line3<S>{foot.cross(direction), direction}, options, result);
  return result;
}

// The same along a known unit direction in the world, such as a Manhattan axis: with two unknowns instead of
// four the tilt of a short segment does no harm, and half of the parallax does. kNoConsensus when a segment
// does not follow it.
template <Scalar S>
[[nodiscard]] LineTriangulation<S> triangulate_line_along(
    std::span<const LineView<S>> views, const Vec3<S>& direction_world,
    const LineTriangulationOptions<S>& options = {}) noexcept {
  LineTriangulation<S> result;
  result.status = detail::check(views);
  const S length = direction_world.norm();
  if (!std::isfinite(length)) result.status = Status::kNotFinite;
  if (!usable(result.status)) return result;
  result.status = Status::kDegenerate;
  if (!(length > 0)) return result;
  const Vec3<S> direction = direction_world / length;
  const Vec3<S> origin = LineGeometry<S>(views[0], Vec3<S>::Zero()).centre;
  const auto plane = [&](const LineView<S>& view) {
    return detail::ViewPlane<S>(LineGeometry<S>(view, origin), direction);
  };
  result.parallax = detail::plane_parallax(views, plane);
  result.status = Status::kLowParallax;
  if (!(result.parallax >= options.min_parallax / 2)) return result;
  const Mat<S, 3, 2> basis = tangent_basis(direction);
  Vec2<S> place;
  if (!detail::place_across(views, origin, basis, plane, place)) return result;
  result.status =
      detail::finish(views, origin, detail::ParallelLine<S>{direction, basis, place}, options, result);
  return result;
}

}  // namespace sslam
