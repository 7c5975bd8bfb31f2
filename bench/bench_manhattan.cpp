// SPDX-License-Identifier: BSD-3-Clause
// Manhattan rotation from all normals of a 256 x 192 map and 200 segments, beside the published algorithm.
#include <benchmark/benchmark.h>

#include "plain_mean_shift.hpp"
#include "smallest.hpp"
#include "sslam/manhattan/search.hpp"
#include "support/room_frame.hpp"

namespace {

using namespace sslam;

template <Scalar S>
testing::RoomFrame<S> room_of(const benchmark::State& state) {
  testing::RoomFrameOptions options;
  options.normal_rows = static_cast<int>(state.range(0));
  options.segments = static_cast<int>(state.range(1));
  return testing::RoomFrame<S>(options);
}

// The prediction is a few degrees off, as at a brisk turn of the camera.
template <Scalar S>
void track(benchmark::State& state) {
  const auto room = room_of<S>(state);
  const Vec3<S> off(radians(S(3)), radians(S(-2)), radians(S(2)));
  const ManhattanPrior<S> prior{room.current.rotation.retract(off)};
  std::vector<std::int8_t> axis_of(room.votes.size());
  ManhattanEstimate<S> estimate;
  for (auto _ : state) {
    estimate = track_manhattan<S>(room.normals(), room.votes, prior, {}, axis_of);
    benchmark::DoNotOptimize(estimate);
  }
  if (!usable(estimate.status)) state.SkipWithError(name(estimate.status));
  state.counters["error_deg"] =
      static_cast<double>(degrees(angle_between(estimate.cam_from_manhattan, room.current.rotation)));
}

template <Scalar S>
void find(benchmark::State& state) {
  const auto room = room_of<S>(state);
  ManhattanEstimate<S> estimate;
  for (auto _ : state) {
    estimate = find_manhattan<S>(room.normals(), room.votes, {}, 1);
    benchmark::DoNotOptimize(estimate);
  }
  if (!usable(estimate.status)) state.SkipWithError(name(estimate.status));
}

template <Scalar S>
void moments(benchmark::State& state) {
  const auto room = room_of<S>(state);
  const Mat3<S> axes = room.current.rotation.matrix();
  for (auto _ : state) {
    auto found = frame_moments<S>(room.normals(), axes, radians(S(5)));
    benchmark::DoNotOptimize(found);
  }
}

// The published algorithm, for normals alone.
void plain(benchmark::State& state) {
  const auto room = room_of<double>(state);
  const NormalView<double> view = room.normals();
  Eigen::MatrixXd normals(3, static_cast<Eigen::Index>(view.size));
  for (std::size_t i = 0; i < view.size; ++i)
    normals.col(static_cast<Eigen::Index>(i)) << view.x[i], view.y[i], view.z[i];
  const Vec3<double> off(radians(3.0), radians(-2.0), radians(2.0));
  const Mat3<double> start = room.current.rotation.retract(off).matrix();
  Mat3<double> found;
  for (auto _ : state) {
    found = bench::plain_rotation(normals, start);
    benchmark::DoNotOptimize(found);
  }
  state.counters["error_deg"] =
      degrees(angle_between(SO3<double>::from_matrix(found), room.current.rotation));
}

void normals_alone(benchmark::internal::Benchmark* b) {
  b->ArgNames({"rows", "segments"})->Unit(benchmark::kMicrosecond)->Args({192, 0});
  bench::with_smallest(b);
}

void whole_frame(benchmark::internal::Benchmark* b) {
  b->ArgNames({"rows", "segments"})->Unit(benchmark::kMicrosecond)->Args({192, 200});
  bench::with_smallest(b);
}

void sizes(benchmark::internal::Benchmark* b) {
  whole_frame(b);
  b->Args({96, 200})->Args({48, 200})->Args({12, 200})->Args({192, 0})->Args({0, 50})->Args({0, 200});
}

BENCHMARK(track<float>)->Apply(sizes);
BENCHMARK(track<double>)->Apply(sizes);
BENCHMARK(plain)->Apply(normals_alone);
BENCHMARK(find<float>)->Apply(whole_frame);
BENCHMARK(find<double>)->Apply(whole_frame);
BENCHMARK(moments<float>)->Apply(normals_alone);
BENCHMARK(moments<double>)->Apply(normals_alone);

}  // namespace
