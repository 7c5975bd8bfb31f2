// SPDX-License-Identifier: BSD-3-Clause
// Residuals of bundle adjustment that no image coordinate enters: structure that is known, and the scale that
// is held.
#pragma once

#include "sslam/geometry/sphere.hpp"
#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

// Whitened Log(mean * R^-1); derivative by the left perturbation phi of R: -sqrt_information * J_r^-1(r).
template <Scalar S>
[[nodiscard]] Vec3<S> rotation_tie_residual(const RotationTie<S>& tie, const SO3<S>& R,
                                            Mat3<S>* by_rotation = nullptr) noexcept {
  const Vec3<S> r = (tie.mean * R.inverse()).log();
  // J_r(r) = J_l(-r).
  if (by_rotation) *by_rotation = -tie.sqrt_information * left_jacobian_inverse<S>(-r);
  return tie.sqrt_information * r;
}

// The part of the line's direction across the axis, in the axis' tangent plane: the sine of the angle between
// them.
template <Scalar S>
[[nodiscard]] Vec2<S> axis_tie_residual(const Vec3<S>& axis, const Line3<S>& line,
                                        Mat<S, 2, 4>* by_line = nullptr) noexcept {
  const Mat<S, 2, 3> across = tangent_basis<S>(axis).transpose();
  if (by_line) *by_line = across * line.retract_jacobian().template bottomRows<3>();
  return across * line.direction;
}

// The same for a plane's normal.
template <Scalar S>
[[nodiscard]] Vec2<S> axis_tie_residual(const Vec3<S>& axis, const Plane3<S>& plane,
                                        Mat<S, 2, 3>* by_plane = nullptr) noexcept {
  const Mat<S, 2, 3> across = tangent_basis<S>(axis).transpose();
  if (by_plane) *by_plane << across * tangent_basis(plane.normal), Vec2<S>::Zero();
  return across * plane.normal;
}

// Distance from the held centre over what it should be, less one. The centre is -R^T t; its derivative by xi
// is (0, -R^T).
template <Scalar S>
[[nodiscard]] S scale_tie_residual(const Vec3<S>& held_centre, S distance, const SE3<S>& cam_from_world,
                                   Mat<S, 1, 6>* by_pose = nullptr) noexcept {
  const Vec3<S> between = cam_from_world.inverse().translation - held_centre;
  const S length = between.norm();
  if (by_pose) {
    by_pose->template head<3>().setZero();
    by_pose->template tail<3>() = -(cam_from_world.rotation * between).transpose() / (length * distance);
  }
  return length / distance - 1;
}

}  // namespace sslam
