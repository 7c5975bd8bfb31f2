// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/drift_watch.hpp"

#include <algorithm>

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace drift_watch_test {

using namespace sslam;
using namespace sslam::testing;

constexpr std::size_t kSteady = 75, kDrift = 24, kAfter = 30;  // frames

// A walk during which the points of some frames look as if the camera turned by 0.8 degrees a frame more than
// it does, as the landmarks of a quick turn do; the lines, of which the map knows none then, do not.
std::vector<TrackResult<double>> track_drift(std::size_t held_by) {
  const std::vector<SE3<double>> path = walk(kSteady + kDrift + kAfter);
  std::vector<SE3<double>> as_points_say = path;
  for (std::size_t k = 0; k < kDrift; ++k) {
    const double more = radians(0.8) * static_cast<double>(k + 1);
    as_points_say[kSteady + k] =
        SE3<double>{SO3<double>::exp({0, more, 0}), Vec3<double>::Zero()} * path[kSteady + k];
  }
  Simulation truth(path), points(as_points_say);
  presets::Structure<double> pipeline;
  Random random(5);
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < path.size(); ++k) {
    Frame<double> frame = truth.frame(k), drifting = points.frame(k);
    if (k >= kSteady && k < kSteady + kDrift) {
      frame.points.assign(
          drifting.points.begin(),
          drifting.points.begin() + static_cast<std::ptrdiff_t>(std::min(held_by, drifting.points.size())));
      for (LineFeature<double>& line : frame.lines)
        for (auto& word : line.descriptor.words) word = random.next();
    }
    results.push_back(pipeline.track(frame));
  }
  return results;
}

// Degrees by which the turn since the last steady frame is off.
double turn_error(const std::vector<TrackResult<double>>& results, std::size_t k) {
  const std::vector<SE3<double>> path = walk(results.size());
  const SO3<double> turned =
      results[k].cam_from_world.rotation * results[kSteady - 1].cam_from_world.rotation.inverse();
  return degrees((turned * (path[k].rotation * path[kSteady - 1].rotation.inverse()).inverse()).log().norm());
}

}  // namespace drift_watch_test

TEST_CASE("A camera that few landmarks hold is lost once it has drifted away from the Manhattan frame") {
  using namespace drift_watch_test;
  const auto results = track_drift(40);
  REQUIRE(results[kSteady - 1].has_pose());
  double worst = 0;
  for (std::size_t k = kSteady; k < results.size(); ++k)
    if (results[k].has_pose()) worst = std::max(worst, turn_error(results, k));
  CHECK(worst > 5);  // what the Manhattan frame cannot tell from its own error
  CHECK(worst < 13);
  CHECK(results[kSteady + kDrift - 1].state == State::kLost);
  CHECK(std::any_of(results.begin(), results.end(), [](const auto& r) {
    return r.state == State::kLost && r.reason == Reason::kManhattanRejected;
  }));
  REQUIRE(results.back().has_pose());
  CHECK(turn_error(results, results.size() - 1) < 1);
}

TEST_CASE("A camera that many landmarks hold is not lost where the walls stand at another angle") {
  using namespace drift_watch_test;
  const auto results = track_drift(200);
  REQUIRE(results[kSteady].point_inliers > 60);
  for (std::size_t k = kSteady; k < kSteady + kDrift; ++k) CHECK(results[k].has_pose());
}

TEST_CASE("A drift begins after the last frame that agreed, or a second before one contradicted") {
  using namespace drift_watch_test;
  TrackedFrame<double> frame;
  frame.manhattan = RotationObservation<double>{SO3<double>{}, 1e-6 * Mat3<double>::Identity()};
  for (const double silent : {0.3, 3.0}) {
    DriftWatch<double> watch;
    const auto weigh = [&](double stamp, bool contradicts) {
      frame.frame.stamp = stamp;
      watch.weigh(frame, contradicts, 20, 0.1);
    };
    for (int k = 0; k <= 40; ++k) weigh(0.1 * k, false);
    for (int k = 0; k < 3; ++k) weigh(4 + silent + 0.1 * k, true);
    REQUIRE(watch.drifted());
    CHECK(watch.began_after() == Approx(std::max(4.0, 3 + silent)));
  }
}
