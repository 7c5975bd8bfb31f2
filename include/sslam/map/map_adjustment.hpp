// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment as a step of mapping: around a new keyframe, or of the whole map. The solver is a policy.
#pragma once

#include <concepts>

#include "sslam/core/parameter.hpp"
#include "sslam/map/bundle_write_back.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"

namespace sslam {

// Improves a graph in place; on failure leaves it as it was.
template <class T, class S>
concept GraphSolver = requires(T solver, BundleGraph<S>& graph) {
  { solver.solve(graph) } -> std::same_as<BundleSummary>;
  { solver.options.losses } -> std::convertible_to<BundleLosses<S>>;
};
static_assert(GraphSolver<BundleSolver<float>, float> && GraphSolver<BundleSolver<double>, double>);

// Both leave the map as it was when the solver fails or too many observations disagree with its answer.
template <Scalar S, GraphSolver<S> Solver = BundleSolver<S>>
class MapAdjustment {
 public:
  BundleWindowOptions<S> window_options;
  Solver solver;
  BundleWriteBack<S> write_back;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("window.", self.window_options, visit);
    visit_stage("", self.solver, visit);
    visit_stage("", self.write_back, visit);
  }

  // The keyframe and its closest neighbours move, what surrounds them is held: a MapOptimiser.
  BundleSummary optimise(Map<S>& map, KeyframeId keyframe);

  // Every keyframe moves; the first keeps its place.
  BundleSummary optimise_all(Map<S>& map);

 private:
  BundleSummary adjust(Map<S>& map) {
    BundleSummary summary = solver.solve(window_.graph);
    if (improved(summary) && !write_back.write_back(window_, solver.options.losses, map))
      summary.status = Status::kNoConsensus;
    return summary;
  }

  BundleWindow<S> window_;
};

template <Scalar S, GraphSolver<S> Solver>
BundleSummary MapAdjustment<S, Solver>::optimise(Map<S>& map, KeyframeId keyframe) {
  window_.gather_local(map, keyframe, window_options);
  return adjust(map);
}

template <Scalar S, GraphSolver<S> Solver>
BundleSummary MapAdjustment<S, Solver>::optimise_all(Map<S>& map) {
  window_.gather_all(map, window_options);
  return adjust(map);
}

}  // namespace sslam
