// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/keyframe_choice.hpp"

#include "support/catch.hpp"

namespace {

using namespace sslam;

// A map of one keyframe with 100 points, of which it knows 60.
Map<double> map_of_one() {
  Map<double> map;
  Keyframe<double> keyframe;
  keyframe.frame.points.resize(100);
  std::vector<LandmarkId> seen(100, kNone);
  for (std::size_t i = 0; i < 60; ++i) seen[i] = static_cast<LandmarkId>(i);
  map.keyframes.push_back(std::move(keyframe).seeing(seen, {}));
  return map;
}

TrackedFrame<double> frame_with(std::size_t points) {
  TrackedFrame<double> frame;
  frame.frame.points.resize(points);
  return frame;
}

}  // namespace

TEST_CASE("A frame that still sees what the reference keyframe sees is no keyframe") {
  const SharedFeatureKeyframes<double> keyframes;
  const Map<double> map = map_of_one();
  CHECK_FALSE(keyframes.choose(map, 0, frame_with(100), 35, 5, 1.0));
  CHECK(keyframes.choose(map, 0, frame_with(100), 25, 5, 1.0));
  CHECK_FALSE(keyframes.choose(map, 0, frame_with(100), 25, keyframes.options.min_gap / 2, 1.0));
}

TEST_CASE("Where much that is new comes into view a keyframe is due though all that is known is seen") {
  const SharedFeatureKeyframes<double> keyframes;
  const Map<double> map = map_of_one();
  CHECK_FALSE(keyframes.choose(map, 0, frame_with(180), 60, 5, 1.0));
  CHECK(keyframes.choose(map, 0, frame_with(250), 60, 5, 1.0));
  CHECK_FALSE(keyframes.choose(map, 0, frame_with(30), 35, 5, 1.0));  // and less is no news
}

TEST_CASE("A frame that has moved or turned far from the reference keyframe is one") {
  const SharedFeatureKeyframes<double> keyframes;
  const Map<double> map = map_of_one();
  TrackedFrame<double> frame = frame_with(100);
  frame.cam_from_world.translation.x() = 0.15;
  CHECK(keyframes.choose(map, 0, frame, 60, 5, 1.0));
  CHECK_FALSE(keyframes.choose(map, 0, frame, 60, 5, 3.0));
  frame.cam_from_world = {SO3<double>::exp({0, radians(15.0), 0}), Vec3<double>::Zero()};
  CHECK(keyframes.choose(map, 0, frame, 60, 5, 3.0));
}
