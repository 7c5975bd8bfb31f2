// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/neighbour_tracking.hpp"

#include <utility>
#include <vector>

#include "sslam/solver/pose/rotation_prior.hpp"
#include "support/catch.hpp"

namespace neighbour_tracking_test {

using namespace sslam;

using Ids = std::vector<LandmarkId>;

// Answers as it is told, moves the frame by one metre, and notes what it was asked for.
struct Fallback {
  Reason reason = Reason::kFine;
  Ids points, lines;

  PoseEstimate<double> track(Map<double>&, const RecentLandmarks<double>& recent,
                             const RotationPrior<double>* prior, TrackedFrame<double>& frame) {
    REQUIRE(prior == nullptr);
    points = recent.points;
    lines = recent.lines;
    frame.cam_from_world.translation.x() += 1;
    PoseEstimate<double> estimate;
    estimate.reason = reason;
    estimate.point_inliers = 7;
    return estimate;
  }
};

struct Refinement {
  Reason reason = Reason::kFine;
  int calls = 0;

  PoseEstimate<double> refine(Map<double>&, const RotationPrior<double>* prior, TrackedFrame<double>& frame) {
    REQUIRE(prior == nullptr);
    ++calls;
    frame.cam_from_world.translation.y() += 1;
    PoseEstimate<double> estimate;
    estimate.reason = reason;
    estimate.point_inliers = 40;
    return estimate;
  }
};

TrackedFrame<double> with_matches(Ids points, Ids lines) {
  TrackedFrame<double> frame;
  frame.point_landmarks = std::move(points);
  frame.line_landmarks = std::move(lines);
  return frame;
}

struct Scene {
  TrackedFrame<double> beside = with_matches({4, kNone, 2}, {9});
  TrackedFrame<double> behind = with_matches({2, 7}, {kNone, 3, 9});
  TrackedFrame<double> frame;
  Map<double> map;
  Fallback fallback;
  Refinement refinement;
  NeighbourTracking<double> tracking;

  PoseEstimate<double> track() {
    frame.cam_from_world.translation = {5, 0, 0};
    return tracking.track(beside, behind, map, fallback, refinement, frame);
  }
};

}  // namespace neighbour_tracking_test

TEST_CASE("A frame is tracked by the landmarks of both neighbours, and what counts is the refined pose") {
  neighbour_tracking_test::Scene scene;
  const auto estimate = scene.track();
  CHECK(estimate.ok());
  CHECK(estimate.point_inliers == 40);
  CHECK(scene.fallback.points == neighbour_tracking_test::Ids{2, 4, 7});
  CHECK(scene.fallback.lines == neighbour_tracking_test::Ids{3, 9});
  CHECK(scene.frame.cam_from_world.translation == sslam::Vec3<double>(6, 1, 0));
  scene.beside = neighbour_tracking_test::with_matches({8}, {});
  scene.behind = scene.beside;
  CHECK(scene.track().ok());
  CHECK(scene.fallback.points == neighbour_tracking_test::Ids{8});  // nothing is left of those before
  CHECK(scene.fallback.lines.empty());
}

TEST_CASE("A frame that its neighbours do not find is not refined") {
  neighbour_tracking_test::Scene scene;
  scene.fallback.reason = sslam::Reason::kNoConsensus;
  const auto estimate = scene.track();
  CHECK(estimate.reason == sslam::Reason::kNoConsensus);
  CHECK(estimate.point_inliers == 7);
  CHECK(scene.refinement.calls == 0);
}

TEST_CASE("A frame whose refinement fails has no pose") {
  neighbour_tracking_test::Scene scene;
  scene.refinement.reason = sslam::Reason::kTooFewMatches;
  CHECK_FALSE(scene.track().ok());
  CHECK(scene.refinement.calls == 1);
}
