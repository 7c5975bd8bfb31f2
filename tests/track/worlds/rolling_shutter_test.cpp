// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/rolling_shutter.hpp"

#include <cmath>
#include <optional>

#include "support/catch.hpp"
#include "track/simulation.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace rolling_shutter_tests {

constexpr double kReadOut = 0.03;  // seconds
constexpr std::size_t kFrames = 90;

// A walk with a hand that trembles three times a second, by half a degree or a multiple of that.
SE3<double> pose_at(double t, double tremor = 1) {
  return look({0.5 * std::sin(0.8 * t), 0.1 * std::sin(1.1 * t), 0.2 * t - 2},
              0.2 * std::sin(0.5 * t) + tremor * 0.01 * std::sin(19 * t),
              0.05 * std::sin(t) + tremor * 0.0075 * std::sin(17 * t));
}

std::vector<SE3<double>> trembling_walk(double tremor = 1) {
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < kFrames; ++k) path.push_back(pose_at(static_cast<double>(k) / 30, tremor));
  return path;
}

// What a frame sees whose rows are read one after the other; points alone.
std::vector<Frame<double>> rolled_frames(Simulation& simulation, double tremor = 1) {
  const Map<double> map = simulation.true_map(1);
  std::vector<Frame<double>> frames;
  for (const Keyframe<double>& keyframe : map.keyframes) {
    Frame<double>& frame = frames.emplace_back(keyframe.frame);
    frame.lines.clear();
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      const Vec3<double>& position = map.points[map.index(keyframe.point_landmarks[i])].position;
      Vec2<double>& pixel = frame.points[i].pixel;
      const Vec2<double> noise = pixel - frame.pinhole.project(pose_at(frame.stamp, tremor) * position);
      for (int round = 0; round < 4; ++round) {  // the row that sees it depends on where it is seen
        const double moment = row_offset<double>(kReadOut, pixel.y(), frame.height);
        pixel = frame.pinhole.project(pose_at(frame.stamp + moment, tremor) * position) + noise;
      }
    }
  }
  return frames;
}

// Tracked with the final pass. No read-out: it is looked for.
void track(presets::Structure<double>& pipeline, const std::vector<Frame<double>>& frames,
           std::optional<double> read_out = {}) {
  pipeline.keep_frames = true;
  pipeline.final_pass.options.read_out = read_out.value_or(0);
  pipeline.final_pass.shutter.search.options.search = !read_out;
  for (Frame<double> frame : frames) (void)pipeline.track(frame);
  pipeline.finish();
  REQUIRE(pipeline.trajectory().entries().size() > kFrames / 2);
}

}  // namespace rolling_shutter_tests

using namespace rolling_shutter_tests;

TEST_CASE("The motion at a frame is that of a spline through the poses around it") {
  std::vector<TimedPose<double>> poses;
  for (int k = 0; k < 40; ++k) {
    const double stamp = k / 30.0 + (k % 3) * 0.004;  // uneven steps
    poses.push_back({stamp, pose_at(stamp)});
  }
  const auto motions = frame_motions<double>(poses);
  for (std::size_t k = 3; k + 3 < poses.size(); ++k) {
    REQUIRE(motions[k]);
    for (const double later : {-0.015, -0.005, 0.01, 0.015}) {
      const SE3<double> predicted = SE3<double>::exp(motions[k]->until(later)) * *poses[k].cam_from_world;
      const Vec6<double> error = (predicted * pose_at(poses[k].stamp + later).inverse()).log();
      CHECK(error.head<3>().norm() < 0.1 * 0.3 * std::abs(later));  // a tenth of the tremor's largest rate
      CHECK(error.tail<3>().norm() < 2e-3);
    }
  }
}

TEST_CASE("A frame without a pose, or behind a gap, has no motion") {
  std::vector<TimedPose<double>> poses;
  for (int k = 0; k < 6; ++k) poses.push_back({k / 30.0, pose_at(k / 30.0)});
  poses[2].cam_from_world.reset();
  poses.push_back({2.0, pose_at(2.0)});
  const auto motions = frame_motions<double>(poses);
  REQUIRE(motions.size() == 7);
  for (const std::size_t k : {0, 1, 3, 4, 5}) CHECK(motions[k]);
  for (const std::size_t k : {2, 6}) CHECK_FALSE(motions[k]);
  CHECK(frame_motions<double>({}).empty());
}

TEST_CASE("A feature of a rolling shutter goes to where the middle row's moment sees it") {
  Simulation still(trembling_walk()), moving(trembling_walk());
  const Map<double> map = still.true_map(1);
  const std::vector<Frame<double>> frames = rolled_frames(moving);
  std::vector<TimedPose<double>> poses;
  for (const auto& keyframe : map.keyframes) poses.push_back({keyframe.frame.stamp, keyframe.cam_from_world});
  const auto motions = frame_motions<double>(poses);
  double before = 0, after = 0;
  for (const std::size_t k : {20, 40, 60}) {
    const Keyframe<double>& keyframe = map.keyframes[k];
    Frame<double> straight = frames[k];
    const auto depths = inverse_depths(map, keyframe, straight, keyframe.cam_from_world);
    RollingShutter<double>{kReadOut}.straighten(frames[k], *motions[k], depths, straight);
    for (std::size_t i = 0; i < straight.points.size(); ++i) {
      const Vec2<double>& global = keyframe.frame.points[i].pixel;
      before = std::max(before, (frames[k].points[i].pixel - global).norm());
      after = std::max(after, (straight.points[i].pixel - global).norm());
    }
  }
  CHECK(before > 1.5);
  CHECK(after < 0.1 * before);
}

TEST_CASE("The final pass straightens what a rolling shutter saw, and finds its read-out by itself") {
  Simulation simulation(trembling_walk());
  const std::vector<Frame<double>> frames = rolled_frames(simulation);
  presets::Structure<double> global, told, found;
  track(global, frames, 0);
  const double bent = position_error(global, simulation);
  track(told, frames, kReadOut);
  CHECK(told.final_pass.read_out() == kReadOut);
  CHECK(position_error(told, simulation) < 0.5 * bent);
  CHECK(position_error(told, simulation) < 0.015);  // 0.0091 with a global shutter
  track(found, frames);
  CHECK(found.final_pass.read_out() == Approx(kReadOut).epsilon(0.08));
  CHECK(position_error(found, simulation) < 0.5 * bent);
}

TEST_CASE("The read-out is found where the shutter bends many features too far to be matched") {
  constexpr double kTremor = 3;
  Simulation simulation(trembling_walk(kTremor));
  const std::vector<Frame<double>> frames = rolled_frames(simulation, kTremor);
  presets::Structure<double> global, found;
  track(global, frames, 0);
  track(found, frames);
  CHECK(found.final_pass.read_out() == Approx(kReadOut).epsilon(0.08));
  CHECK(position_error(found, simulation) < 0.4 * position_error(global, simulation));
}

TEST_CASE("A read-out that the observations do not tell from 0 counts as none") {
  Simulation simulation(trembling_walk());
  const std::vector<Frame<double>> frames = rolled_frames(simulation);
  presets::Structure<double> pipeline;
  pipeline.final_pass.shutter.search.options.min_sigmas = 1000;
  track(pipeline, frames);
  CHECK(pipeline.final_pass.read_out() == 0);
}

TEST_CASE("A global shutter is known as one, and its poses stay as they are to the bit") {
  Simulation simulation(trembling_walk());
  std::vector<Frame<double>> frames;
  for (const Keyframe<double>& keyframe : simulation.true_map(1).keyframes) {
    frames.push_back(keyframe.frame);
    frames.back().lines.clear();
  }
  presets::Structure<double> looked, told;
  track(looked, frames);
  track(told, frames, 0);
  CHECK(looked.final_pass.read_out() == 0);
  const auto &a = looked.trajectory().entries(), &b = told.trajectory().entries();
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto pose = TrajectoryLog<double>::pose(looked.map(), a[i]);
    const auto same = TrajectoryLog<double>::pose(told.map(), b[i]);
    CHECK(pose.translation == same.translation);
    CHECK(pose.rotation.matrix() == same.rotation.matrix());
  }
}
