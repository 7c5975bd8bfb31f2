// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/drifted_frames.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace drifted_frames_test {

using namespace sslam;
using namespace sslam::testing;

bool drifted(std::int64_t index) {
  return (index >= 20 && index <= 29) || index == 50;
}

DriftedFrames some_frames() {
  DriftedFrames frames;
  frames.add(19 / 30.0, 29 / 30.0);
  frames.add(49 / 30.0, 50 / 30.0);
  return frames;
}

}  // namespace drifted_frames_test

using namespace drifted_frames_test;

TEST_CASE("Poses and keyframes of frames that had drifted are withdrawn, and nothing else") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  track_all(pipeline, simulation);
  Map<double> map = pipeline.map();
  TrajectoryLog<double> log = pipeline.trajectory();
  REQUIRE(some_frames().withdraw(map, log));
  std::size_t gone = 0;
  for (const Keyframe<double>& before : pipeline.map().keyframes) {
    if (!before.alive()) continue;
    const bool goes = before.id >= 2 && drifted(before.frame.index);
    CHECK(map.keyframes[map.index(before.id)].alive() != goes);
    gone += goes;
    // What hangs on it stays where it is.
    CHECK((map.pose(before.id).translation - before.cam_from_world.translation).norm() < 1e-9);
  }
  CHECK(gone > 0);
  for (const auto& entry : pipeline.trajectory().entries())
    CHECK((log.find(entry.index) == nullptr) == drifted(entry.index));
  CHECK_FALSE(some_frames().withdraw(map, log));
}

TEST_CASE("Without a drift nothing is withdrawn, and the first two keyframes never are") {
  Simulation simulation(walk(40));
  presets::Structure<double> pipeline;
  track_all(pipeline, simulation);
  Map<double> map = pipeline.map();
  TrajectoryLog<double> log = pipeline.trajectory();
  CHECK_FALSE(DriftedFrames().withdraw(map, log));
  CHECK(log.entries().size() == pipeline.trajectory().entries().size());
  DriftedFrames all;
  all.add(-1, 39 / 30.0);
  CHECK(all.withdraw(map, log));
  CHECK(map.keyframes[0].alive());
  CHECK(map.keyframes[1].alive());
  CHECK(log.entries().empty());
}
