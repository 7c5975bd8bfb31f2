// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/backfill.hpp"

#include <set>

#include "sslam/track/worlds/trajectory_log.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

// A camera that moves by one unit a frame, and sees nothing in some of them.
struct StepByStep {
  std::set<std::int64_t> blind;

  PoseEstimate<double> track(const Map<double>&, const RecentLandmarks<double>&, const RotationPrior<double>*,
                             TrackedFrame<double>& frame) {
    PoseEstimate<double> estimate;
    if (blind.contains(frame.frame.index)) return estimate;
    frame.cam_from_world.translation.x() -= 1;
    estimate.reason = Reason::kFine;
    return estimate;
  }
};

struct AsItIs {
  PoseEstimate<double> refine(Map<double>&, const RotationPrior<double>*, TrackedFrame<double>&) {
    PoseEstimate<double> estimate;
    estimate.reason = Reason::kFine;
    return estimate;
  }
};

TrackedFrame<double> frame_at(std::int64_t index, double x) {
  TrackedFrame<double> frame;
  frame.frame.index = index;
  frame.frame.stamp = 0.1 * static_cast<double>(index);
  frame.cam_from_world.translation.x() = x;
  return frame;
}

// Frames 0 to 2 have poses, 3 to 9 were lost, and 10 has been found at x = 10: the frames that get a pose.
std::vector<std::int64_t> found_after_loss(Backfill<double>& backfill, const std::set<std::int64_t>& blind) {
  Map<double> map;
  map.add_keyframe({});
  TrajectoryLog<double> log;
  StepByStep fallback{blind};
  AsItIs refinement;
  for (std::int64_t i = 0; i < 10; ++i) backfill.keep(frame_at(i, 0), i < 3);
  backfill.run_back(map, fallback, refinement, frame_at(10, 10), 0, log);
  std::vector<std::int64_t> indices;
  for (const auto& entry : log.entries()) {
    indices.push_back(entry.index);
    CHECK(entry.stamp == Approx(0.1 * static_cast<double>(entry.index)));
  }
  if (blind.empty()) {
    for (const auto& entry : log.entries())
      CHECK(log.pose(map, entry).translation.x() == Approx(static_cast<double>(entry.index)));
  }
  return indices;
}

}  // namespace

TEST_CASE("What was lost is tracked backwards from where the camera is found, up to what has a pose") {
  Backfill<double> backfill;
  CHECK(found_after_loss(backfill, {}) == std::vector<std::int64_t>{9, 8, 7, 6, 5, 4, 3});
  CHECK(found_after_loss(backfill, {}) == std::vector<std::int64_t>{9, 8, 7, 6, 5, 4, 3});
}

TEST_CASE("A blind frame is passed over, too many in a row end the way back") {
  Backfill<double> backfill;
  backfill.options.max_misses = 2;
  CHECK(found_after_loss(backfill, {8, 6}) == std::vector<std::int64_t>{9, 7, 5, 4, 3});
  backfill.clear();
  CHECK(found_after_loss(backfill, {5, 6, 7}) == std::vector<std::int64_t>{9, 8});
}

TEST_CASE("A frame that has got its pose on the way back is not asked again") {
  Backfill<double> backfill;
  CHECK(found_after_loss(backfill, {5}).size() == 6);
  Map<double> map;
  map.add_keyframe({});
  TrajectoryLog<double> log;
  StepByStep fallback;
  AsItIs refinement;
  backfill.run_back(map, fallback, refinement, frame_at(10, 10), 0, log);
  CHECK(log.entries().empty());  // frame 9 has one
  backfill.leave_world();
  backfill.run_back(map, fallback, refinement, frame_at(10, 10), 0, log);
  CHECK(log.entries().size() == 10);  // in another world none of them has
}

TEST_CASE("A joined trajectory has each frame once") {
  Map<double> map;
  map.add_keyframe({});
  TrajectoryLog<double> first, second;
  for (int i = 0; i < 5; ++i) first.add(map, i, 0.1 * i, 0, {});
  for (int i = 3; i < 8; ++i) second.add(map, i, 0.1 * i, 0, {});
  first.append(second, 1, 2.0);
  REQUIRE(first.entries().size() == 8);
  CHECK(first.entries()[4].reference == 0);
  CHECK(first.entries()[5].index == 5);
  CHECK(first.entries()[5].reference == 1);
}
