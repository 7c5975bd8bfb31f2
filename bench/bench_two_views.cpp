// SPDX-License-Identifier: BSD-3-Clause
// Two views from their matches: translation with a known rotation, beside the singular value decomposition of
// the whole N x 3 system that it takes the place of, and the relative pose.
#include <benchmark/benchmark.h>

#include <Eigen/SVD>

#include "smallest.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"
#include "sslam/solver/two_view/translation.hpp"
#include "support/room_frame.hpp"

namespace {

using namespace sslam;

// range(0): matches, range(1): per cent of them wrong.
template <Scalar S>
struct Pair {
  testing::RoomFrame<S> room;
  SO3<S> R_10 = room.current.rotation * room.previous.rotation.inverse();
  Vec3<S> t_10 = (room.current.translation - R_10 * room.previous.translation).normalized();
  std::vector<std::uint8_t> inliers = std::vector<std::uint8_t>(room.matches.size());

  explicit Pair(const benchmark::State& state) : room(options(state)) {}

  static testing::RoomFrameOptions options(const benchmark::State& state) {
    testing::RoomFrameOptions o;
    o.matches = static_cast<int>(state.range(0));
    o.mismatches = static_cast<double>(state.range(1)) / 100;
    return o;
  }
  void report(benchmark::State& state, const Vec3<S>& found, Status status) const {
    if (!usable(status)) state.SkipWithError(name(status));
    state.counters["error_deg"] =
        static_cast<double>(degrees(std::atan2(found.cross(t_10).norm(), found.dot(t_10))));
  }
};

template <Scalar S>
void translation(benchmark::State& state) {
  Pair<S> pair(state);
  TranslationEstimate<S> estimate;
  for (auto _ : state) {
    estimate = translation_from_rotation<S>(pair.room.matches, pair.R_10, {}, 1, pair.inliers);
    benchmark::DoNotOptimize(estimate);
  }
  pair.report(state, estimate.t_10, estimate.status);
}

// No mismatches are sorted out, and no sign is chosen.
template <Scalar S>
void translation_by_svd(benchmark::State& state) {
  const Pair<S> pair(state);
  Vec3<S> t;
  for (auto _ : state) {
    Eigen::Matrix<S, Eigen::Dynamic, 3> rows(static_cast<Eigen::Index>(pair.room.matches.size()), 3);
    for (std::size_t i = 0; i < pair.room.matches.size(); ++i) {
      const BearingMatch<S>& m = pair.room.matches[i];
      rows.row(static_cast<Eigen::Index>(i)) = (pair.R_10 * m.ray0).cross(m.ray1);
    }
    const Eigen::JacobiSVD<Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>> svd(rows, Eigen::ComputeThinV);
    t = svd.matrixV().col(2);
    benchmark::DoNotOptimize(t);
  }
  if (t.dot(pair.t_10) < 0) t = -t;
  pair.report(state, t, Status::kOk);
}

template <Scalar S>
void refine_relative(benchmark::State& state) {
  Pair<S> pair(state);
  RelativePoseSummary<S> summary;
  Vec3<S> t;
  for (auto _ : state) {
    SO3<S> R = pair.R_10;
    t = (pair.t_10 + Vec3<S>(S(0.05), S(-0.05), S(0.05))).normalized();
    summary = refine_relative_pose<S>(pair.room.matches, R, t, {}, pair.inliers);
    benchmark::DoNotOptimize(R);
  }
  pair.report(state, t, summary.status);
}

template <Scalar S>
void find_relative(benchmark::State& state) {
  Pair<S> pair(state);
  RelativePoseSummary<S> summary;
  Vec3<S> t = Vec3<S>::Zero();
  for (auto _ : state) {
    SO3<S> R;
    summary = find_relative_pose<S>(pair.room.matches, {}, 1, R, t, pair.inliers);
    benchmark::DoNotOptimize(R);
  }
  pair.report(state, t, summary.status);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"matches", "wrong"})->Unit(benchmark::kMicrosecond);
  b->Args({500, 30})
      ->Args({500, 0})
      ->Args({50, 30})
      ->Args({100, 30})
      ->Args({200, 30})
      ->Args({1000, 30})
      ->Args({2000, 30});
  bench::with_smallest(b);
}

BENCHMARK(translation<float>)->Apply(sizes);
BENCHMARK(translation<double>)->Apply(sizes);
BENCHMARK(translation_by_svd<float>)->Apply(sizes);
BENCHMARK(translation_by_svd<double>)->Apply(sizes);
BENCHMARK(refine_relative<float>)->Apply(sizes);
BENCHMARK(find_relative<float>)->Apply(sizes);

}  // namespace
