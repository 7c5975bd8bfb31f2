// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment by Levenberg-Marquardt with blocks of fixed size: what a window of keyframes needs, and
// no more.
#pragma once

#include <cmath>
#include <utility>

#include "sslam/core/parameter.hpp"
#include "sslam/solver/bundle/bundle_equations.hpp"
#include "sslam/solver/bundle/bundle_summary.hpp"
#include "sslam/solver/bundle/bundle_terms.hpp"
#include "sslam/solver/least_squares/descent.hpp"

namespace sslam {

template <Scalar S>
struct BundleOptions : DescentOptions<S> {
  BundleLosses<S> losses;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    DescentOptions<S>::parameters(self, visit);
    visit_within("losses.", self.losses, visit);
  }
};
static_assert(Described<BundleOptions<double>>);

// Keeps its buffers from solve to solve. The same graph gives the same bits.
template <Scalar S>
class BundleSolver {
 public:
  BundleOptions<S> options;

  // On failure the graph is left as it was.
  BundleSummary solve(BundleGraph<S>& graph);

  // Half the sum of the robust squared residuals, in sigmas, of all that can be evaluated.
  [[nodiscard]] double cost(const BundleGraph<S>& graph) {
    state_.load(graph);
    choose_edges(graph);
    return static_cast<double>(cost_of(graph, state_)) / 2;
  }

 private:
  struct Descent {
    BundleSolver& solver;
    const BundleGraph<S>& graph;

    [[nodiscard]] bool solve(S damping) { return solver.equations_.solve(graph, damping); }
    [[nodiscard]] S try_step() {
      solver.step();
      return solver.cost_of(graph, solver.trial_);
    }
    void take_step() { std::swap(solver.state_, solver.trial_); }
    [[nodiscard]] S linearise() { return solver.linearise(graph); }
  };

  [[nodiscard]] static BundleSummary fail(BundleSummary summary, Status status) {
    summary.status = status;
    return summary;
  }

  // Marks the edges that can be evaluated at the start and returns how many they are.
  std::size_t choose_edges(const BundleGraph<S>& graph) {
    const auto sees_point = [](const BundleView<S>& view, const BundlePoint<S>& point,
                               const PointEdge<S>& edge) {
      PointReprojection<S> seen;
      return point_reprojection(view.pinhole, view.cam_from_world, point.position, edge.pixel, seen);
    };
    const auto sees_line = [](const BundleView<S>& view, const BundleLine<S>& line, const LineEdge<S>& edge) {
      LineReprojection<S> seen;
      return line_reprojection(view.pinhole, view.cam_from_world, line.line, edge.segment, seen);
    };
    return choose(graph.views, graph.points, graph.point_edges, sees_point, active_.points) +
           choose(graph.views, graph.lines, graph.line_edges, sees_line, active_.lines);
  }

  template <class Landmarks, class Edges, class Sees>
  static std::size_t choose(const std::vector<BundleView<S>>& views, const Landmarks& landmarks,
                            const Edges& edges, Sees sees, std::vector<std::uint8_t>& active) {
    active.assign(edges.size(), 0);
    std::size_t count = 0;
    for (const auto& landmark : landmarks)
      for (auto e = index(landmark.first_edge); e < index(landmark.last_edge); ++e) {
        active[e] = sees(views[index(edges[e].view)], landmark, edges[e]);
        count += active[e];
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
    for (std::size_t p = 0; p < state_.planes.size(); ++p)
      trial_.planes[p] = state_.planes[p].retract(equations_.plane_step(p));
  }

  [[nodiscard]] static std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

  BundleState<S> state_, trial_;
  BundleEquations<S> equations_;
  ActiveEdges active_;
};

template <Scalar S>
BundleSummary BundleSolver<S>::solve(BundleGraph<S>& graph) {
  BundleSummary summary;
  state_.load(graph);
  if (!state_.finite()) return fail(summary, Status::kNotFinite);
  if (choose_edges(graph) == 0) return summary;
  equations_.forget();
  S cost = linearise(graph);
  summary.initial_cost = summary.final_cost = static_cast<double>(cost) / 2;
  if (!std::isfinite(cost)) return fail(summary, Status::kNotFinite);
  Descent descent{*this, graph};
  summary.status = descend<S>(descent, options, cost, summary.iterations);
  summary.final_cost = static_cast<double>(cost) / 2;
  if (improved(summary)) state_.store(graph);
  return summary;
}

}  // namespace sslam
