// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/rotation_evidence.hpp"

#include <vector>

#include "sslam/core/median.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

// A room whose walls are not quite square, seen by a lens that is not quite known: the Manhattan rotation is
// off by another degree in each frame, and its covariance does not say so.
class CrookedRotation : public ManhattanRotation<double> {
 public:
  RotationAnswer<double> rotate(const Frame<double>& frame, const SO3<double>& predicted_cam_from_world,
                                const KnownAxes<double>& known) {
    auto answer = ManhattanRotation<double>::rotate(frame, predicted_cam_from_world, known);
    if (answer.seen && known.world_fixed) {
      SO3<double>& turned = answer.seen->rotation.cam_from_world;
      turned = SO3<double>::exp(radians(0.8) * gaussian_vector<3>(random_)) * turned;
    }
    return answer;
  }

 private:
  Random random_{7};
};

using CrookedPipeline = presets::With<presets::Structure<double>, slots::Rotation<CrookedRotation>>;

RotationObservation<double> observation(double sigma_degrees) {
  const double sigma = radians(sigma_degrees);
  return {SO3<double>::exp({0.3, -0.2, 0.1}), sigma * sigma * Mat3<double>::Identity()};
}

SO3<double> turned(const RotationObservation<double>& seen, double degrees) {
  return SO3<double>::exp({0, radians(degrees), 0}) * seen.cam_from_world;
}

}  // namespace

TEST_CASE("A pose holds to the evidence up to three sigmas and a bit") {
  const RotationEvidence<double> evidence;
  const auto seen = observation(0.2);
  const auto prior = evidence.prior(seen);
  CHECK(evidence.holds(prior, turned(seen, 0.6)));
  CHECK_FALSE(evidence.holds(prior, turned(seen, 0.8)));
}

TEST_CASE("Only a rotation that is exact about every axis is held while the translation is solved") {
  const RotationEvidence<double> evidence;
  CHECK(evidence.rigid(observation(0.2)));
  CHECK_FALSE(evidence.rigid(observation(0.4)));
  auto weak = observation(0.2);
  weak.covariance(2, 2) = 1;
  CHECK_FALSE(evidence.rigid(weak));
}

TEST_CASE("How much larger errors are than the votes say is learned from the turns between frames") {
  for (const double truth : {1.0, 4.0, 9.0}) {
    Random random(3);
    RotationEvidence<double> evidence;
    evidence.options.hidden = 1;  // errors here have nothing in common from one frame to the next
    CHECK(evidence.factor() == Approx(evidence.options.first_factor));
    const SO3<double> step = SO3<double>::exp({0.01, 0.02, -0.01});
    SO3<double> solved;
    std::vector<double> factors;
    for (int k = 0; k < 200; ++k) {
      solved = step * solved;
      RotationObservation<double> votes = observation(0.2);
      votes.cam_from_world = SO3<double>::exp(truth * radians(0.2) * gaussian_vector<3>(random)) * solved;
      evidence.learn(k, 0, votes, solved);
      if (k > 40) factors.push_back(evidence.factor());
    }
    CHECK(median<double>(factors) == Approx(truth).epsilon(0.15));
    const auto weighed = evidence.weigh(observation(0.2));
    CHECK(weighed.covariance(0, 0) ==
          Approx(evidence.factor() * evidence.factor() * observation(0.2).covariance(0, 0)));
  }
}

TEST_CASE("Frames that do not follow each other, and those of another Manhattan frame, teach nothing") {
  RotationEvidence<double> evidence;
  for (int k = 0; k < 100; ++k)
    evidence.learn(2 * k, 0, observation(0.2), turned(observation(0.2), 3.0 * (k % 2)));
  for (int k = 0; k < 100; ++k)
    evidence.learn(300 + k, static_cast<std::size_t>(k % 2), observation(0.2),
                   turned(observation(0.2), 3.0 * (k % 2)));
  CHECK(evidence.factor() == Approx(evidence.options.first_factor));
}

TEST_CASE("In a room that is square to the votes' own sigma, the factor is soon near one") {
  Simulation simulation(walk(120));
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  CHECK(pipeline.evidence.factor() < 2);
  CHECK(count_structure(results) > 80);
}

TEST_CASE("A Manhattan rotation that is off by more than it says takes part in the pose by its real error") {
  Simulation simulation(walk(120));
  CrookedPipeline pipeline;
  const auto results = track_all(pipeline, simulation);
  CHECK(pipeline.evidence.factor() > 3);
  REQUIRE(count_structure(results) > 80);
  REQUIRE(count(results, State::kLost) == 0);
  REQUIRE(position_error(pipeline, simulation) < 0.03);
}
