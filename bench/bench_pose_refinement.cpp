// SPDX-License-Identifier: BSD-3-Clause
// Pose of a frame from 200 points and 60 lines of the map, a tenth of them wrong.
#include <benchmark/benchmark.h>

#include "support/room_frame.hpp"

namespace {

using namespace sslam;

template <Scalar S>
struct Frame {
  testing::RoomFrame<S> room;
  std::vector<std::uint8_t> point_inliers, line_inliers;

  explicit Frame(const benchmark::State& state)
      : room(options(state)), point_inliers(room.points.size()), line_inliers(room.lines.size()) {}

  static testing::RoomFrameOptions options(const benchmark::State& state) {
    testing::RoomFrameOptions o;
    o.points = static_cast<int>(state.range(0));
    o.lines = static_cast<int>(state.range(1));
    return o;
  }
  // As far off as a prediction.
  [[nodiscard]] SE3<S> start() const {
    Vec6<S> off;
    off << S(0.01), S(-0.01), S(0.005), S(0.03), S(-0.02), S(0.04);
    return room.current.retract(off);
  }
};

template <Scalar S>
void full_pose(benchmark::State& state) {
  Frame<S> frame(state);
  PoseSummary<S, 6> summary;
  for (auto _ : state) {
    SE3<S> pose = frame.start();
    summary = refine_pose<S>(frame.room.pinhole, frame.room.points, frame.room.lines, pose, {},
                             frame.point_inliers, frame.line_inliers);
    benchmark::DoNotOptimize(pose);
  }
  if (!usable(summary.status)) state.SkipWithError(name(summary.status));
  state.counters["iterations"] = summary.iterations;
}

template <Scalar S>
void translation_alone(benchmark::State& state) {
  Frame<S> frame(state);
  PoseSummary<S, 3> summary;
  for (auto _ : state) {
    SE3<S> pose = frame.start();
    pose.rotation = frame.room.current.rotation;
    summary = refine_translation<S>(frame.room.pinhole, frame.room.points, frame.room.lines, pose, {},
                                    frame.point_inliers, frame.line_inliers);
    benchmark::DoNotOptimize(pose);
  }
  if (!usable(summary.status)) state.SkipWithError(name(summary.status));
  state.counters["iterations"] = summary.iterations;
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"points", "lines"})->Unit(benchmark::kMicrosecond);
  bench->Args({200, 60})->Args({50, 15})->Args({200, 0})->Args({0, 60});
}

BENCHMARK(full_pose<float>)->Apply(sizes);
BENCHMARK(full_pose<double>)->Apply(sizes);
BENCHMARK(translation_alone<float>)->Apply(sizes);
BENCHMARK(translation_alone<double>)->Apply(sizes);

}  // namespace
