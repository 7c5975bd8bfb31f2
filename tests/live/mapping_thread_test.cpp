// SPDX-License-Identifier: BSD-3-Clause
// Mapping in a thread of its own; .ci/run has this under ThreadSanitizer.
#include "sslam/live/mapping_thread.hpp"

#include <chrono>

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

using LivePipeline = live::Structure<double>;

// Frames come no faster than mapping can bear, whatever machine and sanitizer this runs on.
// A camera would not wait.
TrackResult<double> track(LivePipeline& pipeline, Frame<double> frame) {
  while (pipeline.upkeep.channel.running() && !pipeline.upkeep.channel.room())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return pipeline.track(frame);
}

}  // namespace

TEST_CASE("A walk is tracked while another thread keeps the map") {
  Simulation simulation(walk(150));
  LivePipeline pipeline;
  pipeline.upkeep.channel.max_waiting = 2;  // one in work: a map too old for what is seen loses track
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < simulation.size(); ++k) results.push_back(track(pipeline, simulation.frame(k)));
  pipeline.finish();
  REQUIRE(count(results, State::kInitialising) < 30);
  for (const auto& result : results) {
    INFO("frame " << result.index << " " << name(result.reason));
    CHECK(result.state != State::kLost);
  }
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.06);  // mapping lags by a keyframe at this speed
  REQUIRE(pipeline.map().keyframes.size() > 5);
}

TEST_CASE("A camera that is faster than mapping gets fewer keyframes and no waiting") {
  Simulation simulation(walk(60));
  LivePipeline pipeline;
  pipeline.upkeep.channel.max_waiting = 1;
  pipeline.keyframes.options.min_gap = 0;
  pipeline.keyframes.options.max_baseline = 0;  // each frame wants to be one
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    (void)pipeline.track(frame);
  }
  REQUIRE(pipeline.upkeep.refused() > 0);
  pipeline.finish();
  REQUIRE(pipeline.map().keyframes.size() < simulation.size());
}

TEST_CASE("A pipeline ends while its thread is at work") {
  Simulation simulation(walk(60));
  LivePipeline pipeline;
  for (std::size_t k = 0; k < simulation.size(); ++k) (void)track(pipeline, simulation.frame(k));
  REQUIRE(pipeline.upkeep.channel.running());
}

TEST_CASE("What stops the thread is thrown at the tracker") {
  struct Failing {
    KeyframeId insert(Map<double>&, TrackedFrame<double>&, double) { throw std::bad_alloc(); }
    void begin(Map<double>&, TrackedFrame<double>&, double) {}
  } mapping;
  NoLoopClosing<double> loops;
  Map<double> map;
  map.add_keyframe({});
  live::ThreadedUpkeep<double, Failing, NoLoopClosing<double>> upkeep;
  TrackedFrame<double> frame;
  REQUIRE(upkeep.insert(map, frame, 0, 1, mapping, loops) == 1);
  REQUIRE_THROWS_AS(upkeep.finish(map), std::bad_alloc);
}
