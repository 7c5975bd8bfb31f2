// SPDX-License-Identifier: BSD-3-Clause
// One point and one line from two views and from a window of them; and the 500 matches of two views, beside
// OpenCV's linear solution for all of them at once, which neither refines nor judges what it finds.
#include <benchmark/benchmark.h>

#ifdef SSLAM_BENCH_OPENCV
#include <opencv2/calib3d.hpp>
#endif

#include "smallest.hpp"
#include "support/room_frame.hpp"

namespace {

using namespace sslam;

template <Scalar S>
testing::RoomFrame<S> room_of(const benchmark::State& state) {
  testing::RoomFrameOptions options;
  options.views = static_cast<int>(state.range(0));
  return testing::RoomFrame<S>(options);
}

template <Scalar S>
void point(benchmark::State& state) {
  const auto room = room_of<S>(state);
  PointTriangulation<S> found;
  for (auto _ : state) {
    found = triangulate_point<S>(std::span<const PointView<S>>(room.point_views));
    benchmark::DoNotOptimize(found);
  }
  if (!usable(found.status)) state.SkipWithError(name(found.status));
}

template <Scalar S>
void line(benchmark::State& state) {
  const auto room = room_of<S>(state);
  LineTriangulation<S> found;
  for (auto _ : state) {
    found = triangulate_line<S>(room.line_views);
    benchmark::DoNotOptimize(found);
  }
  if (!usable(found.status)) state.SkipWithError(name(found.status));
}

template <Scalar S>
struct Pair {
  testing::RoomFrame<S> room{{.mismatches = 0}};
  SE3<S> cam1_from_cam0 = room.current * room.previous.inverse();
};

template <Scalar S>
void points_of_a_pair(benchmark::State& state) {
  const Pair<S> pair;
  std::vector<Vec3<S>> points(pair.room.matches.size());
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto answer = triangulate_point<S>(pair.room.matches[i], pair.cam1_from_cam0);
      points[i] = answer.point;
      found += usable(answer.status);
    }
    benchmark::DoNotOptimize(points.data());
  }
  if (2 * found < points.size()) state.SkipWithError("most points were refused");
  state.counters["found"] = static_cast<double>(found);
}

#ifdef SSLAM_BENCH_OPENCV
template <Scalar S>
cv::Mat_<S> projection(const SE3<S>& pose) {
  const Mat3<S> R = pose.rotation.matrix();
  cv::Mat_<S> p(3, 4);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) p(row, column) = R(row, column);
    p(row, 3) = pose.translation[row];
  }
  return p;
}

template <Scalar S>
void points_of_a_pair_by_opencv(benchmark::State& state) {
  const Pair<S> pair;
  const auto count = static_cast<int>(pair.room.matches.size());
  cv::Mat_<S> seen0(2, count), seen1(2, count), points;
  for (int i = 0; i < count; ++i) {
    const BearingMatch<S>& match = pair.room.matches[static_cast<std::size_t>(i)];
    for (int row = 0; row < 2; ++row) {
      seen0(row, i) = match.ray0[row];
      seen1(row, i) = match.ray1[row];
    }
  }
  const cv::Mat_<S> first = projection(SE3<S>{}), second = projection(pair.cam1_from_cam0);
  for (auto _ : state) {
    cv::triangulatePoints(first, second, seen0, seen1, points);
    benchmark::DoNotOptimize(points.data);
  }
  if (points.rows != 4 || points.cols != count) state.SkipWithError("no points");
}
#endif

void views(benchmark::internal::Benchmark* b) {
  b->ArgName("views")->Arg(3)->Arg(7)->Arg(12);
  bench::with_smallest(b);
}
void views_and_two(benchmark::internal::Benchmark* b) {
  views(b);
  b->Arg(2);
}

BENCHMARK(point<float>)->Apply(views_and_two);
BENCHMARK(point<double>)->Apply(views_and_two);
BENCHMARK(line<float>)->Apply(views);
BENCHMARK(line<double>)->Apply(views);
BENCHMARK(points_of_a_pair<float>)->Apply(bench::with_smallest);
BENCHMARK(points_of_a_pair<double>)->Apply(bench::with_smallest);
#ifdef SSLAM_BENCH_OPENCV
BENCHMARK(points_of_a_pair_by_opencv<float>)->Apply(bench::with_smallest);
BENCHMARK(points_of_a_pair_by_opencv<double>)->Apply(bench::with_smallest);
#endif

}  // namespace
