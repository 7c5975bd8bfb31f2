// SPDX-License-Identifier: BSD-3-Clause
// What follows a loop that is closed after the last frame.
#include <vector>

#include "sslam/map/map_deformation.hpp"
#include "sslam/track/presets.hpp"
#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace missed_loops_test {

using namespace sslam;
using namespace sslam::testing;

constexpr double kScale = 3;

// Finds one loop after the last frame, which makes the world larger and moves it.
struct OneLoop : NoLoopClosing<double> {
  std::vector<Sim3<double>> new_from_old;

  [[nodiscard]] std::vector<KeyframeId> missed(const Map<double>&) { return {0}; }
  LoopAnswer<double> close_on_trial(Map<double>& map, KeyframeId, TrialEvidence) {
    new_from_old.assign(map.keyframes.size(), {SO3<double>{}, {5, -2, 1}, kScale});
    deform<double>(map, new_from_old);
    return {true, new_from_old};
  }
};
static_assert(LoopStage<OneLoop, double>);

using Without = presets::With<presets::Structure<double>, slots::Loops<NoLoopClosing<double>>>;
using WithLoop = presets::With<presets::Structure<double>, slots::Loops<OneLoop>>;

template <class P>
double length(const P& pipeline) {
  double sum = 0;
  const auto& entries = pipeline.trajectory().entries();
  const auto centre = [&](std::size_t i) -> Vec3<double> {
    return pipeline.trajectory().pose(pipeline.map(), entries[i]).inverse().translation;
  };
  for (std::size_t i = 1; i < entries.size(); ++i) sum += (centre(i) - centre(i - 1)).norm();
  return sum;
}

}  // namespace missed_loops_test

using namespace missed_loops_test;

TEST_CASE("A loop that is closed after the last frame takes trajectory and camera along") {
  Simulation as_it_was(walk(60)), moved(walk(60));
  Without without;
  WithLoop with;
  without.keep_frames = with.keep_frames = true;
  (void)track_first(without, as_it_was, 58);
  (void)track_first(with, moved, 58);
  CHECK_FALSE(without.finish());
  CHECK(with.finish());
  CHECK(length(with) == Approx(kScale * length(without)).epsilon(0.02));
  // The next frame goes on from there.
  Frame<double> next = moved.frame(58);
  const TrackResult<double> result = with.track(next);
  REQUIRE(result.has_pose());
  CHECK(result.reason != Reason::kRelocalised);
  CHECK(position_error(with, moved) < 1.5 * position_error(without, as_it_was));
}

TEST_CASE("A run without a final pass closes no loop after its last frame") {
  Simulation simulation(walk(40));
  WithLoop pipeline;
  (void)track_all(pipeline, simulation);
  const double before = length(pipeline);
  CHECK_FALSE(pipeline.finish());
  CHECK(length(pipeline) == before);
}
