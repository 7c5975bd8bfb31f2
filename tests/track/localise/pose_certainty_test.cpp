// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/pose_certainty.hpp"

#include <limits>
#include <utility>

#include "sslam/geometry/so3.hpp"
#include "support/catch.hpp"

namespace pose_certainty_test {

using namespace sslam;

// Standard deviations about and along one slanted direction; a tenth of them about and along the others.
PoseEstimate<double> pose_of(double rotation_degrees, double position_share, double scene_depth = 3) {
  const Mat3<double> axes = SO3<double>::exp({0.4, -0.7, 0.3}).matrix();
  const auto spread = [&](double sigma) -> Mat3<double> {
    return axes * (sigma * sigma * Vec3<double>(0.01, 1, 0.01)).asDiagonal() * axes.transpose();
  };
  PoseEstimate<double> pose;
  pose.covariance.topLeftCorner<3, 3>() = spread(radians(rotation_degrees));
  pose.covariance.bottomRightCorner<3, 3>() = spread(position_share * scene_depth);
  pose.scene_depth = scene_depth;
  return pose;
}

// The same pose in a map whose lengths are `scale` times as long.
PoseEstimate<double> scaled(PoseEstimate<double> pose, double scale) {
  pose.covariance.topRightCorner<3, 3>() *= scale;
  pose.covariance.bottomLeftCorner<3, 3>() *= scale;
  pose.covariance.bottomRightCorner<3, 3>() *= scale * scale;
  pose.scene_depth *= scale;
  return pose;
}

PoseCertainty<double> limits(double rotation_degrees, double position_share) {
  PoseCertainty<double> certainty;
  certainty.options = {radians(rotation_degrees), position_share};
  return certainty;
}

TEST_CASE("A pose is certain while neither its rotation nor its place may be off by more than the limits") {
  const PoseCertainty<double> certainty = limits(1, 0.02);
  CHECK(certainty.certain(pose_of(0.9, 0.018)));
  CHECK_FALSE(certainty.certain(pose_of(1.1, 0.018)));
  CHECK_FALSE(certainty.certain(pose_of(0.9, 0.022)));
}

TEST_CASE("Whether a pose is certain does not hang on the unit of the map") {
  const PoseCertainty<double> certainty = limits(1, 0.02);
  for (const double share : {0.019, 0.021}) {
    PoseEstimate<double> pose = pose_of(0.9, share);
    pose.covariance(1, 4) = pose.covariance(4, 1) = 1e-5;
    CHECK(certainty.certain(pose) == (share < 0.02));
    CHECK(certainty.certain(scaled(pose, 10)) == (share < 0.02));
    CHECK(certainty.certain(scaled(pose, 0.001)) == (share < 0.02));
  }
}

TEST_CASE("A limit of 0 is none, and a large one lets every pose pass") {
  CHECK(limits(0, 0.02).certain(pose_of(50, 0.01)));
  CHECK_FALSE(limits(0, 0.02).certain(pose_of(50, 0.03)));
  CHECK(limits(1, 0).certain(pose_of(0.5, 100)));
  CHECK_FALSE(limits(1, 0).certain(pose_of(2, 100)));
  CHECK(limits(180, 1e6).certain(pose_of(50, 100)));
}

TEST_CASE("A covariance that is not finite is no certain pose's, and a pose without one is taken as it is") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const auto& [row, column] : {std::pair(0, 0), {2, 1}, {5, 0}, {4, 4}}) {
      PoseEstimate<double> pose = pose_of(0.1, 0.001);
      pose.covariance(row, column) = bad;
      CHECK_FALSE(limits(1, 0.02).certain(pose));
      CHECK_FALSE(limits(0, 0).certain(pose));
    }
  CHECK(limits(1, 0.02).certain(PoseEstimate<double>()));
}

}  // namespace pose_certainty_test
