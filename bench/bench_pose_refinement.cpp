// SPDX-License-Identifier: BSD-3-Clause
// Pose of a frame from 200 points and 60 lines of the map, a tenth of them wrong. Without wrong ones, the
// least squares alone: by the core's solver, by Ceres and by its TinySolver, from the same start to the same
// answer.
#include <benchmark/benchmark.h>

#ifdef SSLAM_BENCH_CERES
#include "pose_by_ceres.hpp"
#endif
#include "smallest.hpp"
#include "support/room_frame.hpp"

namespace {

using namespace sslam;

template <Scalar S>
struct Frame {
  testing::RoomFrame<S> room;
  std::vector<std::uint8_t> point_inliers, line_inliers;

  explicit Frame(const benchmark::State& state, double outliers = testing::RoomFrameOptions{}.outliers)
      : room(options(state, outliers)),
        point_inliers(room.points.size(), 1),
        line_inliers(room.lines.size(), 1) {}

  static testing::RoomFrameOptions options(const benchmark::State& state, double outliers) {
    testing::RoomFrameOptions o;
    o.outliers = outliers;
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

// solve(frame, pose) takes the pose from start to answer and returns the number of steps.
template <Scalar S, class Solve>
void least_squares(benchmark::State& state, Solve solve) {
  const Frame<S> frame(state, 0);
  SE3<S> pose;
  int steps = 0;
  for (auto _ : state) {
    pose = frame.start();
    steps = solve(frame, pose);
    benchmark::DoNotOptimize(pose);
  }
  const S error = (pose.inverse().translation - frame.room.current.inverse().translation).norm();
  if (!(error < S(0.02))) state.SkipWithError("not at the place");
  state.counters["iterations"] = steps;
  state.counters["error_mm"] = 1e3 * static_cast<double>(error);
}

template <Scalar S>
void least_squares_alone(benchmark::State& state) {
  least_squares<S>(state, [](const Frame<S>& frame, SE3<S>& pose) {
    constexpr S kWide = S(1e6);  // a loss that bends nowhere
    const detail::PoseProblem<S> problem{frame.room.pinhole,  frame.room.points,  frame.room.lines,
                                         frame.point_inliers, frame.line_inliers, nullptr,
                                         HuberLoss<S>{kWide}, HuberLoss<S>{kWide}};
    return minimize(problem, pose).iterations;
  });
}

#ifdef SSLAM_BENCH_CERES
void least_squares_by_ceres(benchmark::State& state) {
  least_squares<double>(state, [](const Frame<double>& frame, SE3<double>& pose) {
    return bench::solve_by_ceres({frame.room.pinhole, frame.room.points, frame.room.lines}, pose);
  });
}
void least_squares_by_tiny_solver(benchmark::State& state) {
  least_squares<double>(state, [](const Frame<double>& frame, SE3<double>& pose) {
    return bench::solve_by_tiny_solver({frame.room.pinhole, frame.room.points, frame.room.lines}, pose);
  });
}
#endif

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"points", "lines"})->Unit(benchmark::kMicrosecond);
  b->Args({200, 60})->Args({50, 15})->Args({1000, 300})->Args({200, 0})->Args({0, 60});
  bench::with_smallest(b);
}

BENCHMARK(full_pose<float>)->Apply(sizes);
BENCHMARK(full_pose<double>)->Apply(sizes);
BENCHMARK(translation_alone<float>)->Apply(sizes);
BENCHMARK(translation_alone<double>)->Apply(sizes);
BENCHMARK(least_squares_alone<float>)->Apply(sizes);
BENCHMARK(least_squares_alone<double>)->Apply(sizes);
#ifdef SSLAM_BENCH_CERES
BENCHMARK(least_squares_by_ceres)->Apply(sizes);
BENCHMARK(least_squares_by_tiny_solver)->Apply(sizes);
#endif

}  // namespace
