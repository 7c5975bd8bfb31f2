// SPDX-License-Identifier: BSD-3-Clause
// What compiles quickly and needs the headers and Eigen all the same.
#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/se3.hpp"

int main() {
  const sslam::SE3<float> cam_from_world{sslam::SO3<float>::exp({0, 0.1F, 0}), {0, 0, 2}};
  const sslam::Pinhole<float> pinhole{500, 500, 320, 240};
  const sslam::Vec2<float> pixel = pinhole.project(cam_from_world * sslam::Vec3<float>::Zero());
  return (pixel - sslam::Vec2<float>(320, 240)).norm() < 1e-3F ? 0 : 1;
}
