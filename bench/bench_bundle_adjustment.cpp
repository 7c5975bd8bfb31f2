// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment of a window of seven keyframes: the core's solver, and Ceres on the same graph.
#include <benchmark/benchmark.h>

#include "sslam/map/map_adjustment.hpp"
#ifdef SSLAM_BENCH_CERES
#include "sslam/ceres/bundle_solver.hpp"
#endif
#include "support/map_errors.hpp"

namespace {

using namespace sslam;

// The last keyframe is new: it and what it sees are off their places.
BundleGraph<double> window() {
  testing::MapSceneOptions options;
  options.points = 2400;
  options.lines = 400;
  testing::MapScene scene(options, testing::sweep(12, 0.25));
  Map<double> map = scene.make_map();
  testing::perturb(scene, map, 10, radians(0.3), 0.02);
  BundleWindowOptions<double> window_options;
  window_options.max_free = 7;
  BundleWindow<double> window;
  window.gather_local(map, static_cast<KeyframeId>(map.keyframes.size() - 1), window_options);
  return window.graph;
}

template <class Solver>
void solve(benchmark::State& state) {
  const BundleGraph<double> start = window();
  Solver solver;
  BundleGraph<double> graph;
  BundleSummary summary;
  for (auto _ : state) {
    state.PauseTiming();
    graph = start;
    state.ResumeTiming();
    summary = solver.solve(graph);
    benchmark::DoNotOptimize(graph.views.data());
  }
  if (!improved(summary)) state.SkipWithError(name(summary.status));
  state.counters["points"] = static_cast<double>(start.points.size());
  state.counters["lines"] = static_cast<double>(start.lines.size());
  state.counters["observations"] = static_cast<double>(start.point_edges.size() + start.line_edges.size());
  state.counters["iterations"] = summary.iterations;
  state.counters["cost"] = summary.final_cost;
}

BENCHMARK(solve<BundleSolver<double>>)->Unit(benchmark::kMillisecond);
#ifdef SSLAM_BENCH_CERES
BENCHMARK(solve<CeresBundleSolver>)->Unit(benchmark::kMillisecond);
#endif

}  // namespace
