// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/drifted_frames.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace drifted_frames_test {

using namespace sslam;
using namespace sslam::testing;

// As tracking leaves it.
struct Walk {
  Map<double> map;
  TrajectoryLog<double> log;

  explicit Walk(std::size_t frames) {
    Simulation simulation(walk(frames));
    presets::Structure<double> pipeline;
    track_all(pipeline, simulation);
    map = pipeline.map();
    log = pipeline.trajectory();
    log.sort();
  }
};

// The frames around the last keyframe.
bool drifted(const Map<double>& map, std::int64_t index) {
  const std::int64_t last = map.keyframes[map.index(map.surviving(map.keyframes.back().id))].frame.index;
  return index > last - 3 && index <= last + 2;
}

}  // namespace drifted_frames_test

using namespace drifted_frames_test;

TEST_CASE("Poses and keyframes of frames that had drifted are withdrawn, and nothing else") {
  const Walk tracked(60);
  Map<double> map = tracked.map;
  TrajectoryLog<double> log = tracked.log;
  std::int64_t first = 0;
  while (!drifted(tracked.map, first)) ++first;
  DriftedFrames frames;
  frames.add((static_cast<double>(first) - 0.5) / 30, (static_cast<double>(first) + 4.5) / 30);
  REQUIRE(frames.withdraw(map, log));
  std::size_t gone = 0;
  for (const Keyframe<double>& before : tracked.map.keyframes) {
    if (!before.alive()) continue;
    const bool goes = before.id >= 2 && drifted(tracked.map, before.frame.index);
    CHECK(map.keyframes[map.index(before.id)].alive() != goes);
    gone += goes;
    // What hangs on it stays where it is.
    CHECK((map.pose(before.id).translation - before.cam_from_world.translation).norm() < 1e-9);
  }
  CHECK(gone > 0);
  for (const auto& entry : tracked.log.entries())
    CHECK((log.find(entry.index) == nullptr) == drifted(tracked.map, entry.index));
  // Once: what the final pass finds for these frames is kept.
  log = tracked.log;
  CHECK_FALSE(frames.withdraw(map, log));
  CHECK(log.entries().size() == tracked.log.entries().size());
}

TEST_CASE("Without a drift nothing is withdrawn, and the first two keyframes never are") {
  const Walk tracked(40);
  Map<double> map = tracked.map;
  TrajectoryLog<double> log = tracked.log;
  CHECK_FALSE(DriftedFrames().withdraw(map, log));
  CHECK(log.entries().size() == tracked.log.entries().size());
  DriftedFrames all;
  all.add(-1, 39 / 30.0);
  CHECK(all.withdraw(map, log));
  CHECK(map.keyframes[0].alive());
  CHECK(map.keyframes[1].alive());
  CHECK(log.entries().empty());
}
