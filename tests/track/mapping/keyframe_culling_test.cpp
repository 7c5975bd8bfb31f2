// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/keyframe_culling.hpp"

#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

// A camera that sways in place and always sees the same walls.
Map<double> crowded_map(int keyframes) {
  MapSceneOptions options;
  options.points = 300;
  options.lines = 60;
  std::vector<SE3<double>> path;
  for (int k = 0; k < keyframes; ++k) path.push_back(look({0.02 * (k % 3), 0, -2}, 0, 0));
  return MapScene(options, path).make_map();
}

int count_alive(const Map<double>& map) {
  return static_cast<int>(
      std::count_if(map.keyframes.begin(), map.keyframes.end(), [](const auto& kf) { return kf.alive(); }));
}

}  // namespace

TEST_CASE("Keyframes that see what others see are removed down to those that are needed") {
  Map<double> map = crowded_map(20);
  KeyframeCulling<double> culling;
  culling.cull(map, 19);
  // The first two, the five spared and the newest; every landmark is still seen by four of them.
  REQUIRE(count_alive(map) == 7);
  REQUIRE((map.keyframes[0].alive() && map.keyframes[1].alive() && map.keyframes[19].alive()));
  for (const auto& kf : map.keyframes)
    for (const Neighbour& n : kf.neighbours) REQUIRE(map.keyframes[map.index(n.keyframe)].alive());
  for (const auto& point : map.points) {
    if (point.alive) REQUIRE(point.observations.size() >= 4);
    for (const Observation& o : point.observations) REQUIRE(map.keyframes[map.index(o.keyframe)].alive());
  }
}

TEST_CASE("A keyframe that alone sees a part of the scene stays") {
  Map<double> map = crowded_map(12);
  // Keyframe 4 sees landmarks of its own: every third of its points is no other's.
  auto& kf = map.keyframes[4];
  for (std::size_t i = 0; i < kf.point_landmarks.size(); i += 3) {
    if (kf.point_landmarks[i] == kNone) continue;
    const auto observations = map.points[map.index(kf.point_landmarks[i])].observations;
    for (const Observation& o : observations)
      if (o.keyframe > 4) map.forget_point(kf.point_landmarks[i], o.keyframe);
    for (const Observation& o : observations)
      if (o.keyframe < 3) map.forget_point(kf.point_landmarks[i], o.keyframe);
  }
  KeyframeCulling<double> culling;
  culling.cull(map, 11);
  REQUIRE(map.keyframes[4].alive());
  REQUIRE_FALSE(map.keyframes[5].alive());
}

TEST_CASE("A share over 1 removes nothing") {
  Map<double> map = crowded_map(20);
  KeyframeCulling<double> culling;
  culling.options.redundant_share = 1.01;
  culling.cull(map, 19);
  REQUIRE(count_alive(map) == 20);
}
