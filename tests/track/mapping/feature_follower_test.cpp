// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/feature_follower.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace feature_follower_test {

using namespace sslam;
using namespace sslam::testing;

constexpr double kRadius = 30;  // pixels

// A camera that stands and turns more and more quickly: by up to 6 degrees, 50 pixels, from frame to frame.
std::vector<SE3<double>> quickening_turn() {
  std::vector<SE3<double>> path;
  double yaw = -0.3;
  for (int k = 0; k < 12; ++k) {
    path.push_back(look({0, 0, -2}, yaw, 0));
    yaw += radians(0.5 * (k + 1));
  }
  return path;
}

TrackedFrame<double> tracked(const Keyframe<double>& keyframe, const SO3<double>& rotation) {
  TrackedFrame<double> out;
  Frame<double> frame = keyframe.frame;
  out.adopt(frame);
  out.cam_from_world.rotation = rotation;
  return out;
}

// Follows the first of the keyframes, with the rotations that are told of them. How many pairs there are with
// the last one, all of which must be right.
std::size_t pairs_with_last(const std::vector<Keyframe<double>>& keyframes,
                            const std::vector<SO3<double>>& told) {
  const TrackedFrame<double> reference = tracked(keyframes.front(), told.front());
  FeatureFollower<double> follower;
  follower.begin(reference);
  std::size_t count = 0, wrong = 0;
  for (std::size_t k = 1; k < keyframes.size(); ++k) {
    const std::vector<IndexPair>& pairs =
        follower.follow(reference, tracked(keyframes[k], told[k]), kRadius, 18, {}, 1);
    count = pairs.size();
    wrong = 0;
    for (const IndexPair& p : pairs)
      wrong += keyframes.front().point_landmarks[static_cast<std::size_t>(p.first)] !=
               keyframes[k].point_landmarks[static_cast<std::size_t>(p.second)];
  }
  CHECK(wrong * 50 <= count);
  return count;
}

}  // namespace feature_follower_test

TEST_CASE("features are followed through a turn that no rotation tells of") {
  using namespace feature_follower_test;
  Simulation simulation(quickening_turn());
  const Map<double> map = simulation.true_map(1);
  CHECK(pairs_with_last(map.keyframes, std::vector<SO3<double>>(simulation.size())) > 20);
}

TEST_CASE("rotations that jump, as a network's may, do not keep features from being followed") {
  using namespace feature_follower_test;
  Simulation simulation(walk(12));
  const Map<double> map = simulation.true_map(1);
  std::vector<SO3<double>> jumping(simulation.size());
  for (std::size_t k = 1; k < jumping.size(); k += 2)
    jumping[k] = SO3<double>::exp(Vec3<double>(0, radians(20.0), 0));
  const std::size_t undisturbed = pairs_with_last(map.keyframes, std::vector<SO3<double>>(simulation.size()));
  CHECK(pairs_with_last(map.keyframes, jumping) == undisturbed);
}
