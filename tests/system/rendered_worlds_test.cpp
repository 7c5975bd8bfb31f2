// SPDX-License-Identifier: BSD-3-Clause
// Accuracy from images to poses, through the real front end: a worse detector or matcher cannot land. Bounds
// are twice what was measured.
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/system/system.hpp"
#include "support/catch.hpp"
#include "support/rendered_room.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

struct Outcome {
  double tracked, ate, rotation_degrees;  // share; metres
};

Outcome track(const synth::HouseOptions& house, int frames) {
  const RenderedRoom room = render_room(house, frames);
  Settings settings;
  settings.camera = room.camera;
  System system(settings);
  for (std::size_t i = 0; i < room.images.size(); ++i) system.track(room.images[i], room.truth[i].stamp);
  system.finish();
  const io::Trajectory trajectory = system.trajectory();
  const io::Evaluation evaluation = io::evaluate(room.truth, trajectory);
  return {static_cast<double>(trajectory.size()) / frames, evaluation.position.rmse,
          degrees(evaluation.rotation_own_offset.rmse)};
}

}  // namespace

TEST_CASE("A camera in a rendered room is tracked as well from images as it was") {
  struct Case {
    const char* name;
    synth::Richness richness;
    synth::World world;
    std::uint64_t seed;
    double ate, rotation_degrees;  // at most
  };
  const auto c = GENERATE(
      Case{"rich, Manhattan", synth::Richness::kRich, synth::World::kManhattan, 1, 0.008, 0.2},
      Case{"poor, Manhattan", synth::Richness::kPoor, synth::World::kManhattan, 2, 0.036, 0.6},
      Case{"rich, a wall at an angle", synth::Richness::kRich, synth::World::kOblique, 3, 0.031, 0.5});
  INFO(c.name);
  synth::HouseOptions house;
  house.seed = c.seed;
  house.richness = c.richness;
  house.world = c.world;
  const Outcome outcome = track(house, 90);
  INFO("tracked " << outcome.tracked << ", ATE " << outcome.ate << " m, " << outcome.rotation_degrees
                  << " degrees");
  CHECK(outcome.tracked == 1);
  CHECK(outcome.ate < c.ate);
  CHECK(outcome.rotation_degrees < c.rotation_degrees);
}
