// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/gap_bridge.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace gap_bridge_test {

using namespace sslam;
using namespace sslam::testing;

constexpr std::size_t kFrames = 20;  // at 30 a second

// A hand that turns by 60 degrees and back within the gap, while it moves straight by 10 cm.
std::vector<SE3<double>> quick_turn() {
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const double t = static_cast<double>(k) / (kFrames - 1);
    path.push_back(look({0.1 * t, 0, -1}, radians(60.0) * std::sin(3 * t), radians(5.0) * t));
  }
  return path;
}

struct Gap {
  Simulation simulation{quick_turn()};
  std::vector<Frame<double>> frames;
  GapBridge<double> bridge;
  Map<double> map;
  TrajectoryLog<double> log;

  Gap() {
    for (std::size_t k = 0; k < kFrames; ++k) frames.push_back(simulation.frame(k));
    Keyframe<double> origin;
    origin.cam_from_world = simulation.truth(0);
    map.add_keyframe(origin);
    for (const std::size_t k : {std::size_t{0}, kFrames - 1})
      log.add(map, frames[k].index, frames[k].stamp, 0, simulation.truth(k));
  }
  const std::vector<SE3<double>>& between(const SE3<double>& first, const SE3<double>& last) {
    return bridge.between(frames, first, last);
  }
};

}  // namespace gap_bridge_test

TEST_CASE("Frames of a short gap turn as their features say, and stand between its ends") {
  gap_bridge_test::Gap gap;
  gap.bridge.run(gap.frames, gap.map, gap.log);
  const auto& entries = gap.log.entries();
  REQUIRE(entries.size() == gap_bridge_test::kFrames);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const sslam::SE3<double> pose = gap.log.pose(gap.map, entries[k]);
    const sslam::SE3<double>& truth = gap.simulation.truth(k);
    CHECK(angle_between(pose.rotation, truth.rotation) < sslam::radians(1.5));
    CHECK((pose.inverse().translation - truth.inverse().translation).norm() < 1e-9);
    CHECK(entries[k].bridged == (k != 0 && k + 1 != entries.size()));
  }
  CHECK(gap.log.bridged().size() == gap_bridge_test::kFrames - 2);
  CHECK(gap.log.bridged().front() == gap.frames[1].stamp);
}

TEST_CASE("A gap that is too long, or shows nothing in between, stays a gap") {
  gap_bridge_test::Gap longer, dark, off;
  longer.bridge.options.longest = 0.5;
  longer.bridge.run(longer.frames, longer.map, longer.log);
  CHECK(longer.log.entries().size() == 2);
  dark.frames[9] = dark.simulation.dark_frame(9);
  dark.bridge.run(dark.frames, dark.map, dark.log);
  CHECK(dark.log.entries().size() == 2);
  off.bridge.options.longest = 0;
  off.bridge.run(off.frames, off.map, off.log);
  CHECK(off.log.entries().size() == 2);
}

TEST_CASE("Turns that do not lead to the pose at the far end bridge nothing") {
  gap_bridge_test::Gap gap;
  const sslam::SE3<double> first = gap.simulation.truth(0);
  sslam::SE3<double> last = gap.simulation.truth(gap_bridge_test::kFrames - 1);
  CHECK(gap.between(first, last).size() == gap_bridge_test::kFrames - 2);
  last.rotation = sslam::SO3<double>::exp({0, sslam::radians(8.0), 0}) * last.rotation;
  CHECK(gap.between(first, last).empty());
}

TEST_CASE("Frames before the first pose and after the last are not bridged") {
  gap_bridge_test::Gap gap;
  gap.log.withdraw([](const auto& entry) { return entry.index == 0; });
  gap.bridge.run(gap.frames, gap.map, gap.log);
  CHECK(gap.log.entries().size() == 1);
}
