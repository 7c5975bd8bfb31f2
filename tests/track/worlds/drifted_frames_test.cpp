// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/drifted_frames.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace drifted_frames_test {

using namespace sslam;
using namespace sslam::testing;

// The frames around the last keyframe.
bool drifted(const Map<double>& map, std::int64_t index) {
  const std::int64_t last = map.keyframes[map.index(map.surviving(map.keyframes.back().id))].frame.index;
  return index > last - 3 && index <= last + 2;
}

}  // namespace drifted_frames_test

using namespace drifted_frames_test;

TEST_CASE("Poses and keyframes of frames that had drifted are withdrawn, and nothing else") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  track_all(pipeline, simulation);
  Map<double> map = pipeline.map();
  TrajectoryLog<double> log = pipeline.trajectory();
  log.sort();
  std::int64_t first = 0;
  while (!drifted(pipeline.map(), first)) ++first;
  DriftedFrames frames;
  frames.add((static_cast<double>(first) - 0.5) / 30, (static_cast<double>(first) + 4.5) / 30);
  REQUIRE(frames.withdraw(map, log));
  std::size_t gone = 0;
  for (const Keyframe<double>& before : pipeline.map().keyframes) {
    if (!before.alive()) continue;
    const bool goes = before.id >= 2 && drifted(pipeline.map(), before.frame.index);
    CHECK(map.keyframes[map.index(before.id)].alive() != goes);
    gone += goes;
    // What hangs on it stays where it is.
    CHECK((map.pose(before.id).translation - before.cam_from_world.translation).norm() < 1e-9);
  }
  CHECK(gone > 0);
  for (const auto& entry : pipeline.trajectory().entries())
    CHECK((log.find(entry.index) == nullptr) == drifted(pipeline.map(), entry.index));
  CHECK_FALSE(frames.withdraw(map, log));
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
