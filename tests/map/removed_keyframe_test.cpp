// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/removed_keyframe.hpp"

#include <vector>

#include "support/catch.hpp"

namespace removed_keyframe_test {

using namespace sslam;

SE3<double> turned(double yaw, double x) {
  return {SO3<double>::exp({0, yaw, 0}), {x, 0.1, -0.2}};
}

// Keyframes with poses that differ in rotation and translation.
std::vector<Keyframe<double>> four_keyframes() {
  std::vector<Keyframe<double>> keyframes(4);
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    keyframes[k].id = static_cast<KeyframeId>(k);
    keyframes[k].cam_from_world = turned(0.3 * static_cast<double>(k), static_cast<double>(k));
    keyframes[k].frame.points.resize(5);
  }
  return keyframes;
}

double apart(const SE3<double>& a, const SE3<double>& b) {
  return (a * b.inverse()).log().norm();
}

}  // namespace removed_keyframe_test

TEST_CASE("Nothing is left of a removed keyframe but its id and its place at its parent") {
  using namespace removed_keyframe_test;
  const auto keyframes = four_keyframes();
  const Keyframe<double> rest = remains_of(keyframes[1], keyframes[3]);
  CHECK(rest.id == 1);
  CHECK(rest.parent == 3);
  CHECK_FALSE(rest.alive());
  CHECK(rest.frame.points.empty());
  CHECK(apart(rest.cam_from_parent * keyframes[3].cam_from_world, keyframes[1].cam_from_world) < 1e-12);
}

TEST_CASE("A removed keyframe keeps its pose, and moves with the parent that carries it on") {
  using namespace removed_keyframe_test;
  auto keyframes = four_keyframes();
  const SE3<double> was = keyframes[1].cam_from_world;
  keyframes[1] = remains_of(keyframes[1], keyframes[2]);
  keyframes[2] = remains_of(keyframes[2], keyframes[3]);  // the parent goes as well
  CHECK(survivor(keyframes, 0) == 0);
  CHECK(survivor(keyframes, 1) == 3);
  CHECK(survivor(keyframes, 2) == 3);
  CHECK(apart(keyframe_pose(keyframes, 1), was) < 1e-12);
  // The world turns under the survivor: cam_from_world * world_from_new, for all that hangs on it.
  const SE3<double> world_from_new = turned(-0.7, 4);
  keyframes[3].cam_from_world = keyframes[3].cam_from_world * world_from_new;
  CHECK(apart(keyframe_pose(keyframes, 1), was * world_from_new) < 1e-12);
  CHECK(apart(keyframe_pose(keyframes, 0), turned(0, 0)) < 1e-12);
}
