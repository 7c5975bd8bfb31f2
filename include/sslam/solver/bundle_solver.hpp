// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment by Levenberg-Marquardt with blocks of fixed size: what a window of keyframes needs, and
// no more.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "sslam/solver/bundle_equations.hpp"
#include "sslam/solver/bundle_summary.hpp"
#include "sslam/solver/bundle_terms.hpp"

namespace sslam {

template <Scalar S>
struct BundleOptions {
  int max_iterations = 8;
  S initial_damping = S(1e-4);  // relative to the diagonal of the normal equations
  S min_decrease = S(1e-4);     // relative decrease of the cost that ends the search
  BundleLosses<S> losses;
};

// Keeps its buffers from solve to solve. The same graph gives the same bits.
template <Scalar S>
class BundleSolver {
 public:
  BundleOptions<S> options;

  // On failure the graph is left as it was.
  BundleSummary solve(BundleGraph<S>& graph) {
    BundleSummary summary;
    state_.load(graph);
    if (!state_.finite()) return fail(summary, Status::kNotFinite);
    if (choose_edges(graph) == 0) return summary;
    S cost = linearise(graph);
    summary.initial_cost = summary.final_cost = static_cast<double>(cost) / 2;
    if (!std::isfinite(cost)) return fail(summary, Status::kNotFinite);
    summary.status = descend(graph, cost, summary.iterations);
    summary.final_cost = static_cast<double>(cost) / 2;
    if (improved(summary)) state_.store(graph);
    return summary;
  }

 private:
  static constexpr S kMaxDamping = S(1e6);

  [[nodiscard]] static BundleSummary fail(BundleSummary summary, Status status) {
    summary.status = status;
    return summary;
  }

  [[nodiscard]] Status descend(const BundleGraph<S>& graph, S& cost, int& iterations) {
    S damping = options.initial_damping;
    bool factored = false;
    while (iterations < options.max_iterations) {
      ++iterations;
      const bool solved = equations_.solve(graph, damping);
      factored = factored || solved;
      if (solved) step();
      const S tried = solved ? cost_of(graph, trial_) : std::numeric_limits<S>::infinity();
      if (!(tried < cost)) {
        damping *= 10;
        if (damping > kMaxDamping) return factored ? Status::kOk : Status::kDegenerate;
        continue;
      }
      const bool done = cost - tried < options.min_decrease * cost;
      std::swap(state_, trial_);
      cost = tried;
      damping = std::max(damping / 10, S(1e-9));
      if (done) return Status::kOk;
      if (iterations < options.max_iterations) cost = linearise(graph);
    }
    return factored ? Status::kNotConverged : Status::kDegenerate;
  }

  // Marks the edges that can be evaluated at the start and returns how many they are.
  std::size_t choose_edges(const BundleGraph<S>& graph) {
    active_.points.assign(graph.point_edges.size(), 0);
    active_.lines.assign(graph.line_edges.size(), 0);
    std::size_t count = 0;
    for (const BundlePoint<S>& point : graph.points)
      for (auto e = index(point.first_edge); e < index(point.last_edge); ++e) {
        const PointEdge<S>& edge = graph.point_edges[e];
        const BundleView<S>& view = graph.views[index(edge.view)];
        PointReprojection<S> seen;
        active_.points[e] =
            point_reprojection(view.pinhole, view.cam_from_world, point.position, edge.pixel, seen);
        count += active_.points[e];
      }
    for (const BundleLine<S>& line : graph.lines)
      for (auto e = index(line.first_edge); e < index(line.last_edge); ++e) {
        const LineEdge<S>& edge = graph.line_edges[e];
        const BundleView<S>& view = graph.views[index(edge.view)];
        LineReprojection<S> seen;
        active_.lines[e] =
            line_reprojection(view.pinhole, view.cam_from_world, line.line, edge.segment, seen);
        count += active_.lines[e];
      }
    return count;
  }

  [[nodiscard]] S linearise(const BundleGraph<S>& graph) {
    equations_.reset(graph);
    return BundleTerms<S, BundleEquations<S>>(graph, state_, options.losses, equations_).visit(active_);
  }

  [[nodiscard]] S cost_of(const BundleGraph<S>& graph, const BundleState<S>& state) const {
    CostOnly sink;
    return BundleTerms<S, CostOnly>(graph, state, options.losses, sink).visit(active_);
  }

  // trial = state moved by the equations' steps.
  void step() {
    trial_ = state_;
    for (std::size_t v = 0; v < state_.views.size(); ++v) {
      trial_.views[v] = state_.views[v].retract(equations_.view_step(v));
      trial_.rotations[v] = trial_.views[v].rotation.matrix();
    }
    for (std::size_t i = 0; i < state_.points.size(); ++i) trial_.points[i] += equations_.points.steps[i];
    for (std::size_t i = 0; i < state_.lines.size(); ++i)
      trial_.lines[i] = state_.lines[i].retract(equations_.lines.steps[i]);
  }

  [[nodiscard]] static std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

  BundleState<S> state_, trial_;
  BundleEquations<S> equations_;
  ActiveEdges active_;
};

}  // namespace sslam
