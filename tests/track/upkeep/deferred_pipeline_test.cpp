// SPDX-License-Identifier: BSD-3-Clause
// The pipeline with its map kept elsewhere, and later.
#include "support/catch.hpp"
#include "track/simulation.hpp"
#include "track/upkeep/step_channel.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

using LatePipeline =
    presets::With<presets::Structure<double>, slots::Upkeep<DeferredUpkeep<double, StepChannel>>>;

// A keyframe gets into the map with every `pause`-th frame.
std::vector<TrackResult<double>> track_all(LatePipeline& pipeline, Simulation& simulation,
                                           std::size_t pause) {
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    results.push_back(pipeline.track(frame));
    if (k % pause == 0 && pipeline.upkeep.channel.running()) pipeline.upkeep.channel.step();
  }
  pipeline.finish();
  return results;
}

}  // namespace

TEST_CASE("A walk is tracked as well when mapping comes late") {
  presets::Structure<double> at_once;
  Simulation same(walk(150));
  testing::track_all(at_once, same);
  for (const std::size_t pause : {1, 4, 20}) {
    Simulation simulation(walk(150));
    LatePipeline pipeline;
    pipeline.upkeep.channel.max_waiting = 1;
    pipeline.keyframes.options.max_baseline = 0.03;  // more keyframes than this mapping can take
    const auto results = track_all(pipeline, simulation, pause);
    INFO("pause " << pause << ", keyframes not made " << pipeline.upkeep.refused());
    REQUIRE(count(results, State::kLost) == 0);
    REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
    REQUIRE(position_error(pipeline, simulation) < 2 * position_error(at_once, same) + 0.005);
    if (pause == 20) REQUIRE(pipeline.upkeep.refused() > 0);
  }
}

TEST_CASE("All that was posted is in the last map and the next frame goes on from there") {
  Simulation simulation(walk(120));
  LatePipeline pipeline;
  pipeline.upkeep.channel.max_waiting = 100;
  std::size_t keyframes = 0;
  for (std::size_t k = 0; k < 90; ++k) {
    Frame<double> frame = simulation.frame(k);
    keyframes += pipeline.track(frame).keyframe ? 1 : 0;
    if (k < 60 && pipeline.upkeep.channel.running()) pipeline.upkeep.channel.step();
  }
  pipeline.finish();
  REQUIRE_FALSE(pipeline.upkeep.channel.running());
  REQUIRE(pipeline.map().keyframes.size() >= keyframes);
  REQUIRE(pipeline.map().points.back().visible > 0);
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  for (std::size_t k = 90; k < 120; ++k) {
    Frame<double> frame = simulation.frame(k);
    REQUIRE(pipeline.track(frame).has_pose());
  }
  pipeline.finish();
  REQUIRE(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("A later run goes on in the map of an earlier one and mapping comes late") {
  Simulation simulation(walk(140));
  presets::Structure<double> first;
  track_first(first, simulation, 100);
  LatePipeline second;
  second.resume(first.map());
  for (std::size_t k = 60; k < 140; ++k) {
    Frame<double> frame = k < 110 || k > 115 ? simulation.frame(k) : simulation.dark_frame(k);
    const TrackResult<double> result = second.track(frame);
    REQUIRE(result.has_pose() == (k < 110 || k > 115));
    if (k % 6 == 0 && second.upkeep.channel.running()) second.upkeep.channel.step();
  }
  second.finish();
  REQUIRE(second.map().keyframes.size() > first.map().keyframes.size());
  REQUIRE(position_error(second, simulation) < 0.03);
}
