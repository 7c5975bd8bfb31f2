// SPDX-License-Identifier: BSD-3-Clause
// The pipeline with more than one map: left when the camera is lost in it, met again, joined.
#include <cmath>
#include <numbers>

#include "sslam/io/maps/map_check.hpp"
#include "support/catch.hpp"
#include "track/simulation.hpp"
#include "track/upkeep/step_channel.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

constexpr std::size_t kFirst = 90, kAway = 100, kTurn = 75, kBack = 45;

// A walk, a jump to where the camera looks the other way, and a walk there.
std::vector<SE3<double>> walk_and_jump() {
  std::vector<SE3<double>> path = walk(kFirst);
  for (std::size_t k = 0; k < kAway; ++k) {
    const double t = static_cast<double>(k) / 30;
    path.push_back(look({0.8 - 0.5 * t, 0.1 * std::sin(t), 0.3 * std::sin(0.8 * t)}, std::numbers::pi));
  }
  return path;
}

// Turns back, with steps aside, to where the first walk was, and goes on there.
std::vector<SE3<double>> walk_and_return() {
  std::vector<SE3<double>> path = walk_and_jump();
  const Vec3<double> there = path.back().inverse().translation;
  const std::vector<SE3<double>> first = walk(kFirst);
  const Vec3<double> here = first[kFirst - kBack].inverse().translation;
  for (std::size_t k = 1; k <= kTurn; ++k) {
    const double s = static_cast<double>(k) / kTurn;
    path.push_back(look((1 - s) * there + s * here + Vec3<double>(0, 0.1 * std::sin(9 * s), 0),
                        (1 - s) * std::numbers::pi + s * 0.2 * std::sin(0.5 * (kFirst - kBack) / 30.0)));
  }
  path.insert(path.end(), first.end() - kBack, first.end());
  return path;
}

}  // namespace

TEST_CASE("Where the camera is lost for long a new map is begun and the larger one is the result") {
  Simulation simulation(walk_and_jump());
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(results[kFirst - 1].world == 0);
  REQUIRE(count(results, State::kLost) == std::lround(30 * pipeline.trial.options.leave_after));
  REQUIRE(results.back().world == 1);
  REQUIRE(results.back().has_pose());
  REQUIRE(pipeline.world() == 1);
  pipeline.finish();
  // The second map reaches back over the frames that were lost.
  const bool second_larger = pipeline.world() == 1;
  REQUIRE(pipeline.atlas.worlds().size() == 1);
  REQUIRE(pipeline.trajectory().entries().size() >= pipeline.atlas.worlds()[0].log.entries().size());
  REQUIRE(pipeline.trajectory().entries().size() == (second_larger ? kAway : kFirst));
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  REQUIRE_NOTHROW(io::check_map(pipeline.map()));
}

TEST_CASE("Without an atlas, and in a map that was given, the camera stays lost") {
  Simulation simulation(walk_and_jump());
  presets::Structure<double> alone;
  alone.atlas.options.most = 0;
  REQUIRE(count(track_all(alone, simulation), State::kLost) == kAway);
  REQUIRE(alone.trajectory().entries().size() == kFirst);

  Simulation again(walk_and_jump());
  presets::Structure<double> given;
  given.resume(alone.map());
  const auto results = track_all(given, again);
  REQUIRE(count(results, State::kLost) >= static_cast<int>(kAway));
  REQUIRE(given.world() == 0);
}

TEST_CASE("A camera that jumps back is found in the map that was left") {
  std::vector<SE3<double>> path = walk_and_jump();
  const std::vector<SE3<double>> first = walk(kFirst + 60);
  path.insert(path.end(), first.begin() + 60, first.end());
  Simulation simulation(path);
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(results.back().world == 0);
  REQUIRE(results.back().has_pose());
  const auto found = std::find_if(results.begin() + kFirst + kAway, results.end(),
                                  [](const auto& r) { return r.reason == Reason::kRelocalised; });
  REQUIRE(found - results.begin() < static_cast<std::ptrdiff_t>(kFirst + kAway + 8));
  REQUIRE(found->world == 0);
  pipeline.finish();
  REQUIRE(pipeline.world() == 0);
  REQUIRE(pipeline.trajectory().entries().size() > 2 * kFirst - 10);
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  REQUIRE(pipeline.atlas.worlds().size() == 1);
  REQUIRE(pipeline.atlas.worlds()[0].number == 1);
}

TEST_CASE("Two maps become one where the way leads from one into the other") {
  Simulation simulation(walk_and_return());
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(std::count_if(results.begin(), results.end(), [](const auto& r) { return r.maps_joined; }) == 1);
  REQUIRE(results.back().world == 0);
  REQUIRE(results.back().has_pose());
  REQUIRE(pipeline.atlas.worlds().empty());
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  REQUIRE(pipeline.map().world_from_manhattan.size() == 1);
  REQUIRE_NOTHROW(io::check_map(pipeline.map()));
}

TEST_CASE("A pipeline goes on where another stood, with the map that was left as well") {
  Simulation simulation(walk_and_return());
  constexpr std::size_t kStop = kFirst + kAway;
  presets::Structure<double> stopped, pipeline;
  for (std::size_t k = 0; k < kStop; ++k) {
    Frame<double> frame = simulation.frame(k);
    (void)stopped.track(frame);
  }
  std::vector<World<double>> worlds;
  for (const World<double>* world : stopped.worlds()) {
    World<double>& kept = worlds.emplace_back();
    kept.number = world->number;
    kept.map = world->map;
    kept.log = world->log;
  }
  REQUIRE(worlds.size() == 2);
  REQUIRE(worlds[0].number == 1);
  pipeline.go_on(worlds, stopped.last_number());
  REQUIRE(pipeline.trajectory().entries().size() == stopped.trajectory().entries().size());
  int joined = 0;
  for (std::size_t k = kStop; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    const TrackResult<double> result = pipeline.track(frame);
    REQUIRE(result.has_pose());
    REQUIRE((k > kStop || result.reason == Reason::kRelocalised));
    joined += result.maps_joined ? 1 : 0;
  }
  REQUIRE(joined == 1);
  REQUIRE(pipeline.world() == 0);
  REQUIRE(pipeline.atlas.worlds().empty());
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  REQUIRE_NOTHROW(io::check_map(pipeline.map()));
}

TEST_CASE("Two maps become one while mapping comes late") {
  Simulation simulation(walk_and_return());
  presets::With<presets::Structure<double>, slots::Upkeep<DeferredUpkeep<double, StepChannel>>> pipeline;
  pipeline.upkeep.channel.max_waiting = 3;
  int joined = 0;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    joined += pipeline.track(frame).maps_joined ? 1 : 0;
    if (k % 4 == 0 && pipeline.upkeep.channel.running()) pipeline.upkeep.channel.step();
  }
  pipeline.finish();
  REQUIRE(joined == 1);
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  REQUIRE_NOTHROW(io::check_map(pipeline.map()));
}

TEST_CASE("Without loop closing two maps stay two") {
  Simulation simulation(walk_and_return());
  presets::Structure<double> pipeline;
  pipeline.loops.detection.places.options.most = 0;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(std::none_of(results.begin(), results.end(), [](const auto& r) { return r.maps_joined; }));
  pipeline.finish();
  REQUIRE(pipeline.world() == 1);
  REQUIRE(pipeline.atlas.worlds().size() == 1);
  REQUIRE(position_error(pipeline, simulation) < 0.03);
}
