// SPDX-License-Identifier: BSD-3-Clause
// Reprojection error of a point, with analytic Jacobians (Li et al. 2020, section V-B).
#pragma once

#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam {

// Depth below which a point counts as behind the camera, in units of the map.
template <Scalar S>
inline constexpr S kMinDepth = S(1e-4);

template <Scalar S>
struct PointReprojection {
  Vec2<S> error;                  // observed minus projected, pixels
  Mat<S, 2, 3> wrt_camera_point;  // d error / d (point in the camera frame)
  Vec3<S> in_camera;

  // d error / d xi for the left perturbation xi = (phi, rho): d X = phi x X + rho.
  [[nodiscard]] Mat<S, 2, 6> wrt_pose() const noexcept {
    Mat<S, 2, 6> j;
    j.template leftCols<3>() = -wrt_camera_point * hat(in_camera);
    j.template rightCols<3>() = wrt_camera_point;
    return j;
  }
  // The right half: the rotation stays.
  [[nodiscard]] const Mat<S, 2, 3>& wrt_translation() const noexcept { return wrt_camera_point; }
  [[nodiscard]] Mat<S, 2, 3> wrt_point(const Mat3<S>& R_cam_world) const noexcept {
    return wrt_camera_point * R_cam_world;
  }
};

// False, with `out` untouched, for a point at or behind the camera.
template <Scalar S, CameraModel<S> CameraType>
[[nodiscard]] bool point_reprojection(const CameraType& camera, const SE3<S>& cam_from_world,
                                      const Vec3<S>& point_world, const Vec2<S>& observed,
                                      PointReprojection<S>& out) noexcept {
  const Vec3<S> x = cam_from_world * point_world;
  if (!(x.z() > kMinDepth<S>)) return false;
  out.in_camera = x;
  out.error = observed - camera.project(x);
  out.wrt_camera_point = -camera.project_jacobian(x);
  return true;
}

}  // namespace sslam
