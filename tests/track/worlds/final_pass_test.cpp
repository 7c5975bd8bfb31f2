// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/final_pass.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// A walk whose frames 30 to 33 are dark.
template <class P>
void track_walk(P& pipeline, Simulation& simulation) {
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    Frame<double> frame = k >= 30 && k < 34 ? simulation.dark_frame(k) : simulation.frame(k);
    (void)pipeline.track(frame);
  }
  pipeline.finish();
}

// As the tracker hands it over where it has found no landmark.
TrackedFrame<double> unmatched(Frame<double> frame) {
  TrackedFrame<double> tracked;
  tracked.adopt(frame);
  return tracked;
}

}  // namespace

TEST_CASE("Frames that are tracked again in the finished map are nearer to the truth") {
  Simulation once(walk(90)), again(walk(90));
  presets::Structure<double> as_tracked, twice;
  twice.keep_frames = true;
  track_walk(as_tracked, once);
  track_walk(twice, again);
  CHECK(position_error(twice, again) < 0.8 * position_error(as_tracked, once));
  REQUIRE(twice.trajectory().entries().size() == as_tracked.trajectory().entries().size());
}

TEST_CASE("The final pass gives a pose to frames that had none, and keeps the others in order") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  track_all(pipeline, simulation);
  Map<double> map = pipeline.map();
  TrajectoryLog<double> log;
  for (const auto& entry : pipeline.trajectory().entries())
    if (entry.index < 20 || entry.index > 22)
      log.add(map, entry.index, entry.stamp, entry.reference, pipeline.trajectory().pose(map, entry));
  const std::size_t known = log.entries().size();
  FinalPass<double> pass;
  for (std::size_t k = 0; k < simulation.size(); ++k) pass.keep(unmatched(simulation.frame(k)));
  pass.run(map, pipeline, log);
  REQUIRE(log.entries().size() == known + 3);
  for (std::size_t k = 0; k < log.entries().size(); ++k)
    REQUIRE(log.entries()[k].index == static_cast<std::int64_t>(k) + log.entries()[0].index);
}

TEST_CASE("The final pass recognises frames from which no neighbour with a pose is near") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  track_all(pipeline, simulation);
  Map<double> map = pipeline.map();
  const TrajectoryLog<double>& tracked = pipeline.trajectory();
  constexpr std::int64_t kCut = 20, kDark = 12;
  TrajectoryLog<double> log;
  for (const auto& entry : tracked.entries())
    if (entry.index >= kCut + kDark)
      log.add(map, entry.index, entry.stamp, entry.reference, tracked.pose(map, entry));
  const std::size_t known = log.entries().size();
  FinalPass<double> pass;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    const bool dark = k >= kCut && k < kCut + kDark;
    pass.keep(unmatched(dark ? simulation.dark_frame(k) : simulation.frame(k)));
  }
  pass.run(map, pipeline, log);
  REQUIRE(log.entries().size() == known + kCut);
  for (const auto& entry : log.entries()) {
    CHECK((entry.index < kCut || entry.index >= kCut + kDark));
    const auto* before = tracked.find(entry.index);
    if (before == nullptr) continue;
    const SE3<double> off = log.pose(map, entry) * tracked.pose(pipeline.map(), *before).inverse();
    CHECK(off.translation.norm() < 0.02);
    CHECK(off.rotation.log().norm() < radians(1.0));
  }
}

TEST_CASE("A frame that shows nothing gets no pose from the final pass") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  pipeline.keep_frames = true;
  track_walk(pipeline, simulation);
  for (const auto& entry : pipeline.trajectory().entries()) CHECK((entry.index < 30 || entry.index > 33));
}

TEST_CASE("Frames beyond the limit keep the pose that they were tracked with") {
  Simulation simulation(walk(60));
  presets::Structure<double> pipeline;
  pipeline.final_pass.options.max_frames = 0;
  pipeline.keep_frames = true;
  track_all(pipeline, simulation);
  const auto before = pipeline.trajectory().entries();
  const Map<double> map = pipeline.map();
  pipeline.finish();
  REQUIRE(pipeline.trajectory().entries().size() == before.size());
  CHECK(pipeline.map().keyframes.back().cam_from_world.translation ==
        map.keyframes.back().cam_from_world.translation);
  CHECK(pipeline.trajectory().entries().back().frame_from_reference.translation ==
        before.back().frame_from_reference.translation);
}

TEST_CASE("An empty map, or a run without a frame, has a final pass without effect") {
  Map<double> map;
  TrajectoryLog<double> log;
  presets::Structure<double> pipeline;
  FinalPass<double> pass;
  pass.run(map, pipeline, log);
  pass.keep(unmatched({}));
  pass.run(map, pipeline, log);
  CHECK(log.entries().empty());
}

TEST_CASE("A final pass says when it keeps no further frame") {
  CHECK(NoFinalPass<double>().full());
  Simulation simulation(walk(3));
  FinalPass<double> pass;
  pass.options.max_frames = 2;
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    CHECK(pass.full() == (k >= 2));
    pass.keep(unmatched(simulation.frame(k)));
  }
}
