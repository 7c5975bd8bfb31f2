// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a line seen by several views, over all four degrees of freedom or along a
// known direction, and a linear start for it.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sslam/solver/least_squares/levenberg_marquardt.hpp"
#include "sslam/solver/triangulation/line_view.hpp"

namespace sslam {
namespace detail {

// A line of known direction: two degrees of freedom, its place across the direction.
template <Scalar S>
struct ParallelLine {
  using ScalarType = S;
  static constexpr int kDof = 2;
  Vec3<S> direction;
  Mat<S, 3, 2> basis;  // across the direction
  Vec2<S> place;

  [[nodiscard]] ParallelLine retract(const Vec2<S>& delta) const noexcept {
    return {direction, basis, place + delta};
  }
  [[nodiscard]] Line3<S> line() const noexcept { return {(basis * place).cross(direction), direction}; }
};

template <Scalar S>
[[nodiscard]] const Line3<S>& line_of(const Line3<S>& line) noexcept {
  return line;
}
template <Scalar S>
[[nodiscard]] Line3<S> line_of(const ParallelLine<S>& line) noexcept {
  return line.line();
}
template <Scalar S>
[[nodiscard]] Mat<S, 2, 4> jacobian(const LineReprojection<S>& r, const SE3<S>& cam,
                                    const Line3<S>& line) noexcept {
  return r.wrt_line(cam, line);
}
template <Scalar S>
[[nodiscard]] Mat2<S> jacobian(const LineReprojection<S>& r, const SE3<S>& cam,
                               const ParallelLine<S>& line) noexcept {
  return -r.wrt_moment * cam.rotation.matrix() * hat(line.direction) * line.basis;
}

// How a point `at` of the line moves across the line with the degrees of freedom of the minimisation.
template <Scalar S>
[[nodiscard]] Mat<S, 3, 4> across_jacobian(const Line3<S>& line, const Vec3<S>& at) noexcept {
  const Mat<S, 6, 4> j = line.retract_jacobian();
  return hat(line.direction) * (j.template topRows<3>() - hat(at) * j.template bottomRows<3>());
}
template <Scalar S>
[[nodiscard]] Mat<S, 3, 2> across_jacobian(const ParallelLine<S>& line, const Vec3<S>&) noexcept {
  return line.basis;
}

// Squared distances of the observed ends from the projected line, in variances.
template <Scalar S>
struct LineProblem {
  std::span<const LineView<S>> views;
  Vec3<S> origin;

  template <class Line>
  [[nodiscard]] Evaluated<S> operator()(const Line& line,
                                        NormalEquations<S, Line::kDof>& equations) const noexcept {
    Evaluated<S> sum;
    LineReprojection<S> r;
    for (const LineView<S>& view : views) {
      const SE3<S> cam = LineGeometry<S>(view, origin).camera_from_origin();
      if (!line_reprojection(Pinhole<S>{}, cam, line_of(line), view.segment, r)) continue;
      const S weight = 1 / (view.sigma * view.sigma);
      sum.cost += weight * r.error.squaredNorm();
      sum.count += 2;
      const Mat<S, 2, Line::kDof> j = jacobian(r, cam, line);
      for (int i = 0; i < 2; ++i) equations.add(j.row(i), r.error[i], weight);
    }
    return sum;
  }

  [[nodiscard]] S largest_error(const Line3<S>& line) const noexcept {
    S worst = 0;
    LineReprojection<S> r;
    for (const LineView<S>& view : views) {
      const SE3<S> cam = LineGeometry<S>(view, origin).camera_from_origin();
      if (!line_reprojection(Pinhole<S>{}, cam, line, view.segment, r)) return std::numeric_limits<S>::max();
      worst = std::max(worst, r.error.template lpNorm<Eigen::Infinity>() / view.sigma);
    }
    return worst;
  }
};

// A plane through a camera centre, and the variance of its normal in the direction in which that is known
// least.
template <Scalar S>
struct ViewPlane {
  Vec3<S> normal;
  S variance;  // rad^2

  // Through both ends of the segment: a short one leaves its tilt about the viewing ray open.
  ViewPlane(const LineGeometry<S>& geometry) noexcept {
    const Vec3<S> across = geometry.ray[0].cross(geometry.ray[1]);
    const S sine = across.norm(), sigma = geometry.view.sigma;
    normal = across / sine;
    variance = 2 * sigma * sigma / (sine * sine);
  }
  // Through the middle of the segment, along a known direction.
  ViewPlane(const LineGeometry<S>& geometry, const Vec3<S>& direction) noexcept {
    const Vec3<S> across = (geometry.ray[0] + geometry.ray[1]).normalized().cross(direction);
    const S sine = across.norm(), sigma = geometry.view.sigma;
    normal = across / sine;
    variance = sigma * sigma / (2 * sine * sine);
  }
};

// Largest angle between two planes, among those pairs where it stands out of the noise; plane(view) gives
// them.
template <Scalar S, class Plane>
[[nodiscard]] S plane_parallax(std::span<const LineView<S>> views, Plane plane) noexcept {
  constexpr S kClear = S(2.5);  // standard deviations
  S largest = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const ViewPlane<S> a = plane(views[i]), b = plane(views[j]);
      const S sine2 = a.normal.cross(b.normal).squaredNorm();
      if (sine2 > kClear * kClear * (a.variance + b.variance)) largest = std::max(largest, sine2);
    }
  return std::asin(std::min(std::sqrt(largest), S(1)));
}

// The point across `basis` that is nearest to all planes: sum of (n . (X - c))^2 is least.
template <Scalar S, class Plane>
[[nodiscard]] bool place_across(std::span<const LineView<S>> views, const Vec3<S>& origin,
                                const Mat<S, 3, 2>& basis, Plane plane, Vec2<S>& place) noexcept {
  Mat2<S> a = Mat2<S>::Zero();
  Vec2<S> b = Vec2<S>::Zero();
  for (const LineView<S>& view : views) {
    const Vec3<S> n = ViewPlane<S>(plane(view)).normal;
    const Vec2<S> row = basis.transpose() * n;
    a += row * row.transpose();
    b += row * n.dot(LineGeometry<S>(view, origin).centre);
  }
  const Eigen::LLT<Mat2<S>> factor(a);
  if (factor.info() != Eigen::Success) return false;
  place = factor.solve(b);
  return place.allFinite();
}

}  // namespace detail
}  // namespace sslam
