// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/refinement.hpp"

#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

// The third keyframe of the map, as a frame that has just been tracked there.
TrackedFrame<double> tracked_again(const Map<double>& map) {
  const Keyframe<double>& keyframe = map.keyframes[2];
  Frame<double> features = keyframe.frame;
  TrackedFrame<double> frame;
  frame.adopt(features);
  frame.read_back(keyframe);
  return frame;
}

struct Counts {
  int visible = 0, found = 0;

  explicit Counts(const Map<double>& map) {
    for (const auto& point : map.points) visible += point.visible, found += point.found;
    for (const auto& line : map.lines) visible += line.visible, found += line.found;
  }
};

}  // namespace

TEST_CASE("A refinement counts what the frame should have seen, and what it has seen") {
  MapScene scene({}, sweep(4));
  Map<double> map = scene.make_map();
  TrackedFrame<double> frame = tracked_again(map);
  const int matched = count_held(frame.point_landmarks) + count_held(frame.line_landmarks);
  const Counts before(map);
  LocalMapRefinement<double> stage;
  REQUIRE(stage.refine(map, nullptr, frame).ok());
  const Counts after(map);
  CHECK(after.visible - before.visible >= matched);
  CHECK(after.found - before.found == count_held(frame.point_landmarks) + count_held(frame.line_landmarks));
}

TEST_CASE("A refined pose is as far from the truth as its covariance says") {
  constexpr int kRooms = 60;
  double squared = 0;
  for (int room = 0; room < kRooms; ++room) {
    MapSceneOptions options;
    options.points = 150, options.lines = 30;
    options.seed = static_cast<std::uint64_t>(room + 1);
    MapScene scene(options, sweep(4));
    Map<double> map = scene.make_map();
    TrackedFrame<double> frame = tracked_again(map);
    LocalMapRefinement<double> stage;
    const PoseEstimate<double> estimate = stage.refine(map, nullptr, frame);
    REQUIRE(estimate.ok());
    const Mat6<double>& covariance = estimate.covariance;
    REQUIRE((covariance - covariance.transpose()).cwiseAbs().maxCoeff() < 1e-12);
    const Vec6<double> xi = (scene.poses[2] * frame.cam_from_world.inverse()).log();
    Mat6<double> information;
    REQUIRE(inverse_of<double>(covariance, information));
    squared += xi.dot(information * xi);
  }
  // Chi-square of six degrees of freedom: six on average, 0.45 its standard deviation over so many rooms.
  CHECK(squared / kRooms > 4);
  CHECK(squared / kRooms < 8);
}

TEST_CASE("A refinement at a place that is only supposed gives the same pose and counts nothing") {
  MapScene scene({}, sweep(4));
  Map<double> map = scene.make_map();
  const Counts before(map);
  TrackedFrame<double> counted = tracked_again(map), uncounted = tracked_again(map);
  LocalMapRefinement<double> stage;
  REQUIRE(stage.refine_uncounted(map, nullptr, uncounted).ok());
  CHECK(Counts(map).visible == before.visible);
  REQUIRE(stage.refine(map, nullptr, counted).ok());
  CHECK((counted.cam_from_world.log().array() == uncounted.cam_from_world.log().array()).all());
  CHECK(counted.point_landmarks == uncounted.point_landmarks);
}
