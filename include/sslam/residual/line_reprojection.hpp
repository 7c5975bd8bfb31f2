// SPDX-License-Identifier: BSD-3-Clause
// Reprojection error of an infinite line against an observed segment, with analytic Jacobians. Both errors
// are distances in pixels, so points and lines share one cost.
#pragma once

#include "sslam/geometry/line2.hpp"
#include "sslam/geometry/line3.hpp"

namespace sslam {

// Signed distances of the two observed ends from the projected line.
template <Scalar S>
struct LineReprojection {
  Vec2<S> error;            // of start and end, pixels
  Mat<S, 2, 3> wrt_moment;  // d error / d (moment in the camera frame)
  Line3<S> in_camera;

  // Left perturbation xi = (phi, rho): d n = phi x n + rho x d, d the direction.
  [[nodiscard]] Mat<S, 2, 6> wrt_pose() const noexcept {
    Mat<S, 2, 6> j;
    j.template leftCols<3>() = -wrt_moment * hat(in_camera.moment);
    j.template rightCols<3>() = wrt_translation();
    return j;
  }
  [[nodiscard]] Mat<S, 2, 3> wrt_translation() const noexcept {
    return -wrt_moment * hat(in_camera.direction);
  }

  // With respect to the four degrees of freedom of the line in the world (Line3::retract).
  [[nodiscard]] Mat<S, 2, 4> wrt_line(const SE3<S>& cam_from_world,
                                      const Line3<S>& line_world) const noexcept {
    const Mat3<S> R = cam_from_world.rotation.matrix();
    const Mat<S, 6, 4> update = line_world.retract_jacobian();
    return wrt_moment * (R * update.template topRows<3>() +
                         hat(cam_from_world.translation) * R * update.template bottomRows<3>());
  }
};

// False, with `out` untouched, when the line has no image.
template <Scalar S>
[[nodiscard]] bool line_reprojection(const Pinhole<S>& k, const SE3<S>& cam_from_world,
                                     const Line3<S>& line_world, const Segment2<S>& observed,
                                     LineReprojection<S>& out) noexcept {
  const Line3<S> line = transform(cam_from_world, line_world);
  const Vec3<S>& n = line.moment;
  const Vec3<S> l(k.fy * n.x(), k.fx * n.y(),
                  k.fx * k.fy * n.z() - k.fy * k.cx * n.x() - k.fx * k.cy * n.y());
  const S norm = l.template head<2>().norm();
  if (!(norm > S(1e-9) * std::abs(l.z())) || !(norm > 0)) return false;
  const S inverse = 1 / norm;
  // d l / d n is the constant matrix of the line projection; d (l . p / norm) follows by the quotient rule.
  Mat3<S> projection;
  projection << k.fy, 0, 0, 0, k.fx, 0, -k.fy * k.cx, -k.fx * k.cy, k.fx * k.fy;
  const Vec3<S> unit(l.x() * inverse, l.y() * inverse, 0);
  const auto row = [&](int i, const Vec2<S>& end) {
    const Vec3<S> p(end.x(), end.y(), 1);
    const S distance = l.dot(p) * inverse;
    out.error[i] = distance;
    out.wrt_moment.row(i) = ((p - distance * unit) * inverse).transpose() * projection;
  };
  row(0, observed.start);
  row(1, observed.end);
  out.in_camera = line;
  return true;
}

// The paper's form: distance of a projected end of a 3D segment from the observed line (a, b, c), a^2 + b^2
// = 1.
template <Scalar S>
struct EndpointToLine {
  S error;  // pixels
  Mat<S, 1, 3> wrt_camera_point;
  Vec3<S> in_camera;

  [[nodiscard]] Mat<S, 1, 6> wrt_pose() const noexcept {
    Mat<S, 1, 6> j;
    j.template leftCols<3>() = -wrt_camera_point * hat(in_camera);
    j.template rightCols<3>() = wrt_camera_point;
    return j;
  }
};

template <Scalar S, CameraModel<S> CameraType>
[[nodiscard]] bool endpoint_to_line(const CameraType& camera, const SE3<S>& cam_from_world,
                                    const Vec3<S>& end_world, const Vec3<S>& observed_line,
                                    EndpointToLine<S>& out) noexcept {
  const Vec3<S> x = cam_from_world * end_world;
  if (!(x.z() > S(1e-4))) return false;
  const Vec2<S> p = camera.project(x);
  out.in_camera = x;
  out.error = observed_line.template head<2>().dot(p) + observed_line.z();
  out.wrt_camera_point = observed_line.template head<2>().transpose() * camera.project_jacobian(x);
  return true;
}

}  // namespace sslam
