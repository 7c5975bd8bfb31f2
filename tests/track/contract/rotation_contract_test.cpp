// SPDX-License-Identifier: BSD-3-Clause
// What the pipeline makes of the answers of a rotation stage of a user's own.
#include <algorithm>

#include "sslam/track/presets.hpp"
#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

// Sees axes and knows nothing of the rotation.
struct SeesNoRotation {
  RotationAnswer<double> rotate(const Frame<double>&, const SO3<double>&, const KnownAxes<double>&) {
    return {.seen = {}, .axes_seen = 1};
  }
  void lose() {}
  void forget() {}
};

// A gyroscope that knows no Manhattan frame.
struct Gyroscope {
  SO3<double> cam_from_world;
  bool certain = true;

  RotationAnswer<double> rotate(const Frame<double>& frame, const SO3<double>&,
                                const KnownAxes<double>& known) {
    CHECK(known.world_from_manhattan.empty());
    axes.assign(frame.lines.size() + 1, 0);  // of a Manhattan frame that there is not
    return {.seen = {{{cam_from_world, Mat3<double>::Identity() * 1e-6}, certain}}, .line_axes = axes};
  }
  void lose() {}
  void forget() {}

  std::vector<std::int8_t> axes;
};

using Silent = presets::With<presets::Structure<double>, slots::Rotation<SeesNoRotation>>;
using WithGyroscope = presets::With<presets::Structure<double>, slots::Rotation<Gyroscope>>;

std::vector<TrackResult<double>> track_turned(WithGyroscope& pipeline, Simulation& simulation) {
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    pipeline.rotation.cam_from_world = simulation.truth(k).rotation * simulation.truth(0).rotation.inverse();
    Frame<double> frame = simulation.frame(k);
    results.push_back(pipeline.track(frame));
  }
  return results;
}

}  // namespace

TEST_CASE("A rotation stage that answers without a rotation leaves every frame to the fallback") {
  Simulation simulation(walk(80));
  Silent pipeline;
  const auto results = track_all(pipeline, simulation);
  CHECK(count(results, State::kManhattan) == 0);
  CHECK(count(results, State::kFallback) > 50);
  CHECK(std::all_of(results.begin(), results.end(), [](const auto& r) { return r.axes_seen == 1; }));
  CHECK_FALSE(pipeline.last_frame().manhattan.has_value());
  CHECK(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("A rotation that does not come from a Manhattan frame gives no line an axis") {
  Simulation simulation(walk(80));
  WithGyroscope pipeline;
  const auto results = track_turned(pipeline, simulation);
  CHECK(count(results, State::kManhattan) > 50);
  CHECK(pipeline.last_frame().manhattan.has_value());
  const auto& axes = pipeline.last_frame().line_axes;
  REQUIRE_FALSE(axes.empty());
  CHECK(std::all_of(axes.begin(), axes.end(), [](auto axis) { return axis == kNone; }));
  CHECK(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("A rotation that is not certain takes part in the fallback alone") {
  Simulation simulation(walk(80));
  WithGyroscope pipeline;
  pipeline.rotation.certain = false;
  const auto results = track_turned(pipeline, simulation);
  CHECK(count(results, State::kManhattan) == 0);
  CHECK(pipeline.last_frame().manhattan.has_value());
  CHECK(position_error(pipeline, simulation) < 0.03);
}

TEST_CASE("The map keeps the Manhattan frames, and a stage that knows none leaves them there") {
  Simulation simulation(walk(60));
  presets::Structure<double> first;
  track_all(first, simulation);
  REQUIRE(first.map().world_from_manhattan.size() == 1);
  Silent second;
  second.resume(first.map());
  Frame<double> frame = simulation.frame(40);
  CHECK(second.track(frame).has_pose());
  CHECK(second.map().world_from_manhattan.size() == 1);
}
