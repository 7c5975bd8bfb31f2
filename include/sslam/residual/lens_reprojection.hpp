// SPDX-License-Identifier: BSD-3-Clause
// Reprojection errors of points and lines in the image as the lens made it, with derivatives by the camera as
// well: what self-calibration minimises.
#pragma once

#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/point_reprojection.hpp"

namespace sslam {

// The unknowns of a camera: the logarithm of the focal length over a given one, the shift of the principal
// point, pixels, and what is added to k1 and k2. The ratio of fx and fy, p1, p2 and k3 stay.
inline constexpr int kLensDof = 5;
template <Scalar S>
using LensChange = Mat<S, kLensDof, 1>;

template <Scalar S>
[[nodiscard]] Camera<S> changed(const Camera<S>& camera, const LensChange<S>& change) noexcept {
  using std::exp;
  Camera<S> out = camera;
  const S scale = exp(change[0]);
  out.pinhole = {camera.pinhole.fx * scale, camera.pinhole.fy * scale, camera.pinhole.cx + change[1],
                 camera.pinhole.cy + change[2]};
  out.distortion.k1 += change[3];
  out.distortion.k2 += change[4];
  return out;
}

// d distort(m) / d (k1, k2).
template <Scalar S>
[[nodiscard]] Mat2<S> radial_jacobian(const Vec2<S>& m) noexcept {
  const S r2 = m.squaredNorm();
  Mat2<S> j;
  j << m * r2, m * r2 * r2;
  return j;
}

// `raw` is a pixel of the image, distorted. False where the point is behind the camera.
template <Scalar S>
[[nodiscard]] bool lens_point_reprojection(const Camera<S>& camera, const SE3<S>& cam_from_world,
                                           const Vec3<S>& point_world, const Vec2<S>& raw,
                                           PointReprojection<S>& out,
                                           Mat<S, 2, kLensDof>* by_camera = nullptr) noexcept {
  const Vec3<S> x = cam_from_world * point_world;
  if (!(x.z() > kMinDepth<S>)) return false;
  const Vec2<S> m = x.template head<2>() / x.z();
  const Vec2<S> d = camera.distortion.distort(m);
  const Vec2<S> focal(camera.pinhole.fx, camera.pinhole.fy);
  const Vec2<S> from_centre = focal.cwiseProduct(d);
  out.in_camera = x;
  out.error = raw - Vec2<S>(camera.pinhole.cx, camera.pinhole.cy) - from_centre;
  Mat<S, 2, 3> m_by_x;
  m_by_x << 1 / x.z(), 0, -m.x() / x.z(), 0, 1 / x.z(), -m.y() / x.z();
  out.wrt_camera_point = -(focal.asDiagonal() * camera.distortion.distort_jacobian(m) * m_by_x);
  if (by_camera) {
    by_camera->col(0) = -from_centre;
    by_camera->template block<2, 2>(0, 1) = -Mat2<S>::Identity();
    by_camera->template block<2, 2>(0, 3) = -(focal.asDiagonal() * radial_jacobian(m));
  }
  return true;
}

// Distances of a segment's ends from a line, pixels of the ideal pinhole: a line is straight there only, so
// the ends are undistorted. Their derivative is that of an implicit function, distort(m; k) = (raw - c) / f.
// False where the line goes through the camera's centre, or the lens does not reach an end.
template <Scalar S>
[[nodiscard]] bool lens_line_reprojection(const Camera<S>& camera, const SE3<S>& cam_from_world,
                                          const Line3<S>& line_world, const Segment2<S>& raw,
                                          LineReprojection<S>& out,
                                          Mat<S, 2, kLensDof>* by_camera = nullptr) noexcept {
  const Line3<S> line = transform(cam_from_world, line_world);
  const Vec3<S>& n = line.moment;
  const Pinhole<S>& k = camera.pinhole;
  // The length of the line's normal in the image: distance = (n . (m, 1)) / length.
  const Vec2<S> in_image(n.x() / k.fx, n.y() / k.fy);
  const S length = in_image.norm();
  if (!(length > S(1e-9) * std::abs(n.z()) / k.fx) || !(length > 0)) return false;
  const Vec3<S> length_by_n(in_image.x() / (k.fx * length), in_image.y() / (k.fy * length), 0);
  const auto row = [&](int i, const Vec2<S>& end) {
    const Vec2<S> d = k.unproject(end).template head<2>();
    Vec2<S> m;
    if (!camera.distortion.undistort(d, m)) return false;
    const Vec3<S> ray(m.x(), m.y(), S(1));
    const S distance = n.dot(ray) / length;
    out.error[i] = distance;
    out.wrt_moment.row(i) = (ray - distance * length_by_n).transpose() / length;
    if (!by_camera) return true;
    Mat<S, 2, kLensDof> right;  // of distort_jacobian(m) * dm
    right.col(0) = -d;
    right.template block<2, 2>(0, 1) = Vec2<S>(-1 / k.fx, -1 / k.fy).asDiagonal();
    right.template block<2, 2>(0, 3) = -radial_jacobian(m);
    const Mat<S, 2, kLensDof> m_by_camera = camera.distortion.distort_jacobian(m).inverse() * right;
    by_camera->row(i) = n.template head<2>().transpose() * m_by_camera / length;
    (*by_camera)(i, 0) += distance;  // a pixel is a smaller angle with a longer lens
    return true;
  };
  out.in_camera = line;
  return row(0, raw.start) && row(1, raw.end);
}

}  // namespace sslam
