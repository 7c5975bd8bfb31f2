// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulation.hpp"
#include "sslam/map/map_deformation.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// Leaves the frame those of its points that lie nearest to the middle of the image.
void keep_middle(Frame<double>& frame, std::size_t points) {
  const auto aside = [&](const PointFeature<double>& point) {
    return (point.pixel - Vec2<double>(frame.width, frame.height) / 2).norm();
  };
  std::sort(frame.points.begin(), frame.points.end(),
            [&](const auto& a, const auto& b) { return aside(a) < aside(b); });
  frame.points.resize(std::min(points, frame.points.size()));
  frame.lines.clear();
}

// Poses that are uncertain are answered, instead of being refused as too uncertain to use.
void accept_uncertain(presets::Structure<double>& pipeline) {
  for (PoseAcceptance<double>* acceptance :
       {&pipeline.fallback.options.acceptance, &pipeline.refinement.options.acceptance}) {
    acceptance->max_rotation_sigma = radians(20.0);
    acceptance->max_position_sigma = 0.5;
  }
}

}  // namespace

TEST_CASE("The pipeline starts early and tracks a walk through a room") {
  Simulation simulation(walk(150));
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(count(results, State::kInitialising) < 30);
  REQUIRE(count(results, State::kLost) == 0);
  REQUIRE(count_structure(results) > 100);
  // The frames before the first map have their poses too.
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.02);
  REQUIRE(std::any_of(results.begin(), results.end(), [](const auto& r) { return r.axes_seen >= 2; }));
  REQUIRE(results.back().point_inliers > 50);
  REQUIRE(results.back().line_inliers > 5);
}

TEST_CASE("A turn in place gives no map and says why") {
  Simulation simulation(turn_in_place(60));
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(count(results, State::kInitialising) == 60);
  REQUIRE(pipeline.map().empty());
  REQUIRE(std::count_if(results.begin(), results.end(),
                        [](const auto& r) { return r.reason == Reason::kLowParallax; }) > 40);
}

TEST_CASE("The map starts once a turn in place becomes a walk") {
  std::vector<SE3<double>> path = turn_in_place(30);
  for (int k = 1; k <= 60; ++k) path.push_back(look({0.02 * k, 0, -2}, 0.3 * std::sin(29.0 / 30), 0.02));
  Simulation simulation(path);
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(results[29].state == State::kInitialising);
  REQUIRE(results.back().has_pose());
  REQUIRE(position_error(pipeline, simulation) < 0.03);  // of 1.2 m
}

TEST_CASE("A map that starts late reaches back to where the walk began") {
  Simulation simulation(walk(120));
  presets::Structure<double> pipeline;
  pipeline.initialisation.options.min_points = 120;
  pipeline.initialisation.options.triangulation.min_parallax = radians(4.0);
  const auto results = track_all(pipeline, simulation);
  REQUIRE(count(results, State::kInitialising) > 20);
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE(position_error(pipeline, simulation) < 0.03);
  // The way back has keyframes of its own.
  const auto& keyframes = pipeline.map().keyframes;
  REQUIRE(keyframes[2].frame.index < keyframes[1].frame.index);
}

TEST_CASE("Without a Manhattan world the fallback carries the whole walk") {
  Simulation simulation(walk(120));
  presets::Features<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(count(results, State::kManhattan) == 0);
  REQUIRE(count(results, State::kFallback) > 80);
  REQUIRE(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("A covered lens is a loss with a reason and the pose is found again") {
  Simulation simulation(walk(140));
  presets::Structure<double> pipeline;
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    const bool covered = k >= 80 && k < 95;
    Frame<double> frame = covered ? simulation.dark_frame(k) : simulation.frame(k);
    results.push_back(pipeline.track(frame));
  }
  REQUIRE(results[80].state == State::kLost);
  REQUIRE(results[80].reason == Reason::kTooFewMatches);
  REQUIRE(results[94].state == State::kLost);
  REQUIRE(std::any_of(results.begin() + 95, results.end(),
                      [](const auto& r) { return r.reason == Reason::kRelocalised; }));
  REQUIRE(results.back().has_pose());
  REQUIRE(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("The motion carries over a short loss, where it is believed") {
  Simulation simulation(walk(120));
  presets::Structure<double> pipeline;
  const double horizon = GENERATE(0.3, 0.0);
  pipeline.motion.options.horizon = horizon;
  track_first(pipeline, simulation, 80);
  for (std::size_t k = 80; k < 84; ++k) {
    Frame<double> frame = simulation.dark_frame(k);
    REQUIRE(pipeline.track(frame).state == State::kLost);
  }
  Frame<double> frame = simulation.frame(84);
  const TrackResult<double> found = pipeline.track(frame);
  REQUIRE(found.has_pose());
  REQUIRE((found.reason == Reason::kRelocalised) == (horizon == 0));
}

TEST_CASE("While little holds a pose it is uncertain, and no keyframe is made of it") {
  constexpr std::size_t kFrom = 80, kTo = 86;
  const bool looked_at = GENERATE(true, false);
  Simulation simulation(walk(140));
  presets::Structure<double> pipeline;
  accept_uncertain(pipeline);
  if (!looked_at) pipeline.certainty.options = {0, 0};
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    if (k >= kFrom && k < kTo) keep_middle(frame, 12);
    results.push_back(pipeline.track(frame));
  }
  const auto begin = results.begin() + kFrom, end = results.begin() + kTo;
  const auto uncertain = [](const auto& r) { return r.state == State::kUncertain; };
  const auto keyframe = [](const auto& r) { return r.keyframe; };
  REQUIRE(std::all_of(begin, end, [](const auto& r) { return r.has_pose() && r.has_covariance(); }));
  REQUIRE(std::all_of(begin, end, [&](const auto& r) { return uncertain(r) == looked_at; }));
  REQUIRE(std::any_of(begin, end, keyframe) == !looked_at);
  REQUIRE(std::none_of(end, results.end(), uncertain));
  REQUIRE(std::any_of(end, results.end(), keyframe));
  REQUIRE(pipeline.trajectory().entries().size() == simulation.size());
  REQUIRE((position_error(pipeline, simulation) < 0.04) == looked_at);
}

TEST_CASE("A lost camera that little tells where it is has an uncertain pose until more does") {
  Simulation simulation(walk(120));
  presets::Structure<double> pipeline;
  accept_uncertain(pipeline);
  pipeline.motion.options.horizon = 0;
  track_first(pipeline, simulation, 80);
  Frame<double> dark = simulation.dark_frame(80);
  REQUIRE(pipeline.track(dark).state == State::kLost);
  Frame<double> bare = simulation.frame(81);
  keep_middle(bare, 12);
  const TrackResult<double> found = pipeline.track(bare);
  REQUIRE(found.state == State::kUncertain);
  REQUIRE(found.reason == Reason::kRelocalised);
  REQUIRE_FALSE(found.keyframe);
  Frame<double> whole = simulation.frame(82);
  const TrackResult<double> tracked = pipeline.track(whole);
  REQUIRE(tracked.has_pose());
  REQUIRE(tracked.state != State::kUncertain);
  REQUIRE(tracked.reason != Reason::kRelocalised);
}

TEST_CASE("A later run finds its place in the map of an earlier one") {
  Simulation simulation(walk(140));
  presets::Structure<double> first;
  track_first(first, simulation, 100);
  REQUIRE(first.map().world_from_manhattan.size() == 1);
  presets::Structure<double> second;
  second.resume(first.map());
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 60; k < 140; ++k) {
    Frame<double> frame = simulation.frame(k);
    results.push_back(second.track(frame));
  }
  REQUIRE(results[0].state == State::kFallback);
  REQUIRE(results[0].reason == Reason::kRelocalised);
  REQUIRE(count_structure(results) > 60);
  // In the coordinates, and the scale, of the first run.
  const auto& entries = first.trajectory().entries();
  for (const auto& entry : entries)
    if (entry.index == 80) {
      const SE3<double> known = first.trajectory().pose(first.map(), entry);
      REQUIRE((known.inverse().translation - results[20].cam_from_world.inverse().translation).norm() < 0.02);
    }
}

TEST_CASE("Wherever a later run starts in a map its first frame is recognised") {
  Simulation simulation(walk(150));
  presets::Structure<double> first;
  track_all(first, simulation);
  for (const std::size_t start : {0, 40, 90, 149}) {
    presets::Structure<double> second;
    second.resume(first.map());
    Frame<double> frame = simulation.frame(start);
    REQUIRE(second.track(frame).reason == Reason::kRelocalised);
  }
}

TEST_CASE("A place that stands inconsistent to the Manhattan frame is not taken for the one that was lost") {
  Simulation simulation(walk(100));
  presets::Structure<double> first;
  track_all(first, simulation);
  for (const double turn : {0.0, 10.0}) {
    Map<double> map = first.map();
    const SO3<double> turned = SO3<double>::exp(Vec3<double>(0, radians(turn), 0));
    std::vector<Sim3<double>> moves(map.keyframes.size(), Sim3<double>{turned, Vec3<double>::Zero(), 1});
    deform<double>(map, moves);  // and the Manhattan frame stays
    presets::Structure<double> second;
    second.resume(map);
    Frame<double> frame = simulation.frame(60);
    REQUIRE(second.track(frame).state == (turn == 0 ? State::kFallback : State::kLost));
  }
}

TEST_CASE("A map that does not fit is kept and the frames are lost") {
  Simulation simulation(walk(60));
  presets::Structure<double> first;
  track_all(first, simulation);
  MapSceneOptions elsewhere = Simulation::room();
  elsewhere.seed = 77;
  Simulation other(walk(30), elsewhere, 5);
  presets::Structure<double> second;
  second.resume(first.map());
  const auto results = track_all(second, other);
  REQUIRE(count(results, State::kLost) == 30);
  REQUIRE(second.map().keyframes.size() == first.map().keyframes.size());
}

TEST_CASE("A standstill is no movement and adds no keyframes") {
  std::vector<SE3<double>> path = walk(90);
  for (int k = 0; k < 60; ++k) path.push_back(path[89]);
  const std::vector<SE3<double>> further = walk(120);
  path.insert(path.end(), further.begin() + 90, further.end());
  Simulation simulation(path);
  presets::Structure<double> pipeline;
  std::vector<TrackResult<double>> results;
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = simulation.frame(k);
    results.push_back(pipeline.track(frame));
    if (k == 92) before = pipeline.map().keyframes.size();
    if (k == 149) after = pipeline.map().keyframes.size();
  }
  REQUIRE(count(results, State::kLost) == 0);
  REQUIRE(after <= before + 1);
  for (std::size_t k = 100; k < 150; ++k) {
    const Vec3<double> step =
        results[k].cam_from_world.inverse().translation - results[100].cam_from_world.inverse().translation;
    REQUIRE(step.norm() < 0.01);
  }
  REQUIRE(position_error(pipeline, simulation) < 0.02);
}

TEST_CASE("A turn in place in the middle of a walk moves nothing") {
  std::vector<SE3<double>> path = walk(90);
  const SE3<double> stop = path.back();
  for (int k = 1; k <= 60; ++k)
    path.push_back(SE3<double>{SO3<double>::exp({0, 0.4 * std::sin(k * std::numbers::pi / 30), 0}),
                               Vec3<double>::Zero()} *
                   stop);
  Simulation simulation(path);
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  REQUIRE(count(results, State::kLost) == 0);
  for (std::size_t k = 90; k < path.size(); ++k) {
    const Vec3<double> step =
        results[k].cam_from_world.inverse().translation - results[89].cam_from_world.inverse().translation;
    REQUIRE(step.norm() < 0.03);
  }
}

TEST_CASE("A jump to a place that the map does not know is a loss and the way back is found") {
  std::vector<SE3<double>> path = walk(90);
  for (int k = 0; k < 20; ++k)  // looks the other way
    path.push_back(SE3<double>{SO3<double>::exp({0, std::numbers::pi, 0}), Vec3<double>::Zero()} * path[60]);
  for (std::size_t k = 70; k < 90; ++k) path.push_back(path[k]);
  Simulation simulation(path);
  presets::Structure<double> pipeline;
  const auto results = track_all(pipeline, simulation);
  for (std::size_t k = 90; k < 110; ++k) REQUIRE(results[k].state == State::kLost);
  REQUIRE(std::any_of(results.begin() + 110, results.begin() + 115,
                      [](const auto& r) { return r.reason == Reason::kRelocalised; }));
  REQUIRE(results.back().has_pose());
  REQUIRE(position_error(pipeline, simulation) < 0.02);
}

TEST_CASE("A frame without features never becomes a map") {
  Simulation simulation(walk(5));
  presets::Structure<double> pipeline;
  for (std::size_t k = 0; k < 5; ++k) {
    Frame<double> frame = simulation.dark_frame(k);
    const auto result = pipeline.track(frame);
    REQUIRE(result.state == State::kInitialising);
    REQUIRE(result.reason == Reason::kTooFewFeatures);
  }
}

TEST_CASE("The same frames give the same poses bit for bit") {
  std::vector<Vec6<double>> runs[2];
  for (auto& poses : runs) {
    Simulation simulation(walk(80));
    presets::Structure<double> pipeline;
    track_all(pipeline, simulation);
    for (const auto& e : pipeline.trajectory().entries())
      poses.push_back(pipeline.trajectory().pose(pipeline.map(), e).log());
  }
  REQUIRE(runs[0].size() == runs[1].size());
  for (std::size_t i = 0; i < runs[0].size(); ++i) REQUIRE((runs[0][i].array() == runs[1][i].array()).all());
}
