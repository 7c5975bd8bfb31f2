// SPDX-License-Identifier: BSD-3-Clause
// One point and one line from two views and from a window of them.
#include <benchmark/benchmark.h>

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

BENCHMARK(point<float>)->ArgName("views")->Arg(2)->Arg(7);
BENCHMARK(point<double>)->ArgName("views")->Arg(2)->Arg(7);
BENCHMARK(line<float>)->ArgName("views")->Arg(3)->Arg(7);
BENCHMARK(line<double>)->ArgName("views")->Arg(3)->Arg(7);

}  // namespace
