// SPDX-License-Identifier: BSD-3-Clause
// Random poses, points and lines in front of a camera, for the tests of the residuals.
#pragma once

#include "sslam/core/random.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/geometry/line3.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam::testing {

// Entries of two Jacobians over the larger of both: those of one function agree, a mutant's differs.
constexpr double kAgree = 1e-6;
constexpr double kDiffer = 1e-4;

struct ResidualScene {
  Pinhole<double> pinhole{500, 530, 320, 240};  // fx and fy apart, so that one taken for the other shows
  SE3<double> cam_from_world;
  Vec3<double> start, end;  // world
  Segment2<double> observed;

  explicit ResidualScene(Random& random) {
    const auto within = [&](double size) {
      return Vec3<double>{random.uniform(-size, size), random.uniform(-size, size),
                          random.uniform(-size, size)};
    };
    cam_from_world = {SO3<double>::exp(within(1.5)), within(2)};
    const auto in_view = [&] {
      return Vec3<double>{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(1.5, 4.0)};
    };
    Vec3<double> a = in_view(), b = in_view();
    while ((a / a.z() - b / b.z()).norm() < 0.3) b = in_view();
    start = cam_from_world.inverse() * a;
    end = cam_from_world.inverse() * b;
    observed = {pinhole.project(a) + 5 * within(1).head<2>(), pinhole.project(b) + 5 * within(1).head<2>()};
  }
  [[nodiscard]] Line3<double> line() const { return Line3<double>::from_points(start, end); }
};

}  // namespace sslam::testing
