// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/map_extension.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sslam/track/worlds/final_pass.hpp"
#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace map_extension_test {

using namespace sslam;
using namespace sslam::testing;

constexpr std::size_t kTurn = 90, kFrames = 150;

// A walk that begins with a turn of two radians: the first frames show nothing of what the last ones see.
std::vector<SE3<double>> turn_and_walk() {
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const double t = static_cast<double>(k) / 30, left = 1 - static_cast<double>(k) / kTurn;
    const double yaw = left > 0 ? 1 - std::cos(std::numbers::pi * left) : 0;
    path.push_back(look({0.5 * std::sin(0.8 * t), 0.1 * std::sin(1.1 * t), 0.2 * t - 2}, yaw, 0.02));
  }
  return path;
}

// The pipeline has tracked the walk without the turn.
struct WalkAlone {
  explicit WalkAlone(Simulation& simulation) {
    for (std::size_t k = kTurn; k < kFrames; ++k) {
      Frame<double> frame = simulation.frame(k);
      (void)pipeline.track(frame);
    }
    map = pipeline.map();
    log = pipeline.trajectory();
    log.sort();
  }
  presets::Structure<double> pipeline;
  Map<double> map;
  TrajectoryLog<double> log;
};

}  // namespace map_extension_test

TEST_CASE("The final pass extends the map into a turn that the map does not show") {
  using namespace map_extension_test;
  Simulation simulation(turn_and_walk());
  WalkAlone known(simulation);
  FinalPass<double> pass;
  for (std::size_t k = 0; k < kFrames; ++k) {
    TrackedFrame<double> tracked;
    Frame<double> frame = simulation.frame(k);
    tracked.adopt(frame);
    pass.keep(tracked);
  }
  const std::size_t keyframes = known.map.keyframes.size();
  pass.run(known.map, known.pipeline, known.log);
  CHECK(known.log.entries().size() == kFrames);
  CHECK(known.map.keyframes.size() > keyframes + 3);
  CHECK(position_error(known.map, known.log, simulation) < 0.05);  // measured: 0.025
}

TEST_CASE("A map is extended up to frames that cannot be tracked, and not beyond them") {
  using namespace map_extension_test;
  Simulation simulation(turn_and_walk());
  WalkAlone known(simulation);
  std::vector<Frame<double>> frames;
  constexpr std::size_t kDark = 60, kMisses = 5;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const bool dark = k > kDark - 6 - kMisses && k <= kDark;
    frames.push_back(dark ? simulation.dark_frame(k) : simulation.frame(k));
  }
  MapExtension<double> extension;
  extension.run(
      frames, kMisses, [&](std::size_t i, KeyframeId) { return frames[i]; }, known.map, known.pipeline,
      known.log);
  for (std::size_t k = 0; k < kFrames; ++k)
    CHECK((known.log.find(static_cast<std::int64_t>(k)) != nullptr) == (k > kDark));
}

TEST_CASE("Without a frame that has a pose no map is extended") {
  using namespace map_extension_test;
  Simulation simulation(walk(3));
  std::vector<Frame<double>> frames;
  for (std::size_t k = 0; k < simulation.size(); ++k) frames.push_back(simulation.frame(k));
  Map<double> map;
  TrajectoryLog<double> log;
  presets::Structure<double> pipeline;
  MapExtension<double> extension;
  extension.run(
      frames, 5, [&](std::size_t i, KeyframeId) { return frames[i]; }, map, pipeline, log);
  CHECK(log.entries().empty());
}
