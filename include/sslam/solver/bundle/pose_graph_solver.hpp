// SPDX-License-Identifier: BSD-3-Clause
// Spreads what loops reveal over a graph of poses: least squares on Sim(3) with a sparse Cholesky
// factorisation by blocks of seven.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/residual/loss.hpp"
#include "sslam/residual/similarity_edge.hpp"
#include "sslam/solver/bundle/block_cholesky.hpp"
#include "sslam/solver/bundle/bundle_summary.hpp"
#include "sslam/solver/bundle/bundle_ties.hpp"
#include "sslam/solver/bundle/pose_graph.hpp"
#include "sslam/solver/least_squares/descent.hpp"

namespace sslam {

template <Scalar S>
struct PoseGraphOptions : DescentOptions<S> {
  S rotation_width = 2;  // standard deviations at which a rotation tie begins to let go (Cauchy)

  PoseGraphOptions() { this->max_iterations = 20; }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    DescentOptions<S>::parameters(self, visit);
    visit("rotation_width", self.rotation_width, Unit::kNumber, 0.01, 100,
          "standard deviations at which a rotation tie begins to let go");
  }
};
static_assert(Described<PoseGraphOptions<double>>);

// The same graph gives the same bits.
template <Scalar S>
class PoseGraphSolver {
 public:
  PoseGraphOptions<S> options;

  // On failure the graph is left as it was. A node without an edge stays where it is; without a held node all
  // of them float, and the damping keeps them near where they were.
  BundleSummary solve(PoseGraph<S>& graph);

 private:
  using Factor = BlockCholesky<S, 7>;
  using Block = typename Factor::Block;
  using VecX = typename Factor::VecX;
  static constexpr int kHeld = -1;

  // What an edge between two free nodes adds beside the diagonal, in the lower half.
  struct Coupling {
    int row, col;
    Block block;
  };

  struct Descent {
    PoseGraphSolver& solver;
    const PoseGraph<S>& graph;

    [[nodiscard]] bool solve(S damping) { return solver.compute_steps(damping); }
    [[nodiscard]] S try_step() {
      solver.step();
      return solver.visit(
          graph, solver.trial_, [](const auto&...) {}, [](const auto&...) {});
    }
    void take_step() { std::swap(solver.state_, solver.trial_); }
    [[nodiscard]] S linearise() { return solver.linearise(graph); }
  };

  void load(const PoseGraph<S>& graph) {
    state_.clear();
    slots_.clear();
    int next = 0;
    for (const PoseGraphNode<S>& node : graph.nodes) {
      state_.push_back(node.cam_from_world);
      slots_.push_back(node.held ? kHeld : next++);
    }
    right_.resize(7 * next);
    diagonal_.resize(static_cast<std::size_t>(next));
  }

  void analyse(const PoseGraph<S>& graph) {
    std::vector<std::vector<int>> columns(diagonal_.size());
    for (std::size_t r = 0; r < columns.size(); ++r) columns[r].push_back(static_cast<int>(r));
    for (const PoseGraphEdge<S>& edge : graph.edges) {
      const int f = slots_[index(edge.from)], t = slots_[index(edge.to)];
      if (f != kHeld && t != kHeld) columns[index(std::max(f, t))].push_back(std::min(f, t));
    }
    factor_.analyse(columns);
  }

  // Calls edge(edge, whitened derivatives) and tie(node, error, weight, derivative) for each term; returns
  // the cost.
  template <class Edge, class Tie>
  [[nodiscard]] S visit(const PoseGraph<S>& graph, const std::vector<Sim3<S>>& state, Edge on_edge,
                        Tie on_tie) const {
    S cost = 0;
    for (const PoseGraphEdge<S>& edge : graph.edges) {
      SimilarityEdge<S> seen = similarity_edge(edge.to_from, state[index(edge.from)], state[index(edge.to)]);
      seen.error = seen.error.cwiseProduct(edge.inverse_sigma).eval();
      cost += seen.error.squaredNorm();
      on_edge(edge, seen);
    }
    const CauchyLoss<S> loss{options.rotation_width};
    for (std::size_t n = 0; n < state.size(); ++n) {
      if (!graph.nodes[n].rotation || graph.nodes[n].held) continue;
      Mat3<S> derivative;
      const Vec3<S> error = rotation_tie_residual(*graph.nodes[n].rotation, state[n].rotation, &derivative);
      cost += loss.rho(error.squaredNorm());
      on_tie(n, error, loss.weight(error.squaredNorm()), derivative);
    }
    return cost;
  }

  [[nodiscard]] S linearise(const PoseGraph<S>& graph) {
    right_.setZero();
    std::fill(diagonal_.begin(), diagonal_.end(), Block::Zero());
    couplings_.clear();
    return visit(
        graph, state_,
        [&](const PoseGraphEdge<S>& edge, const SimilarityEdge<S>& seen) {
          const Block from = edge.inverse_sigma.asDiagonal() * seen.by_from;
          const Block to = edge.inverse_sigma.asDiagonal() * seen.by_to;
          const int f = slots_[index(edge.from)], t = slots_[index(edge.to)];
          add(f, from.transpose() * from, from.transpose() * seen.error);
          add(t, to.transpose() * to, to.transpose() * seen.error);
          if (f == kHeld || t == kHeld) return;
          couplings_.push_back({std::max(f, t), std::min(f, t),
                                f > t ? Block(from.transpose() * to) : Block(to.transpose() * from)});
        },
        [&](std::size_t node, const Vec3<S>& error, S weight, const Mat3<S>& derivative) {
          Block square = Block::Zero();
          Vec<S, 7> gradient = Vec<S, 7>::Zero();
          square.template topLeftCorner<3, 3>() = weight * derivative.transpose() * derivative;
          gradient.template head<3>() = weight * derivative.transpose() * error;
          add(slots_[node], square, gradient);
        });
  }

  void add(int slot, const Block& square, const Vec<S, 7>& gradient) {
    if (slot == kHeld) return;
    diagonal_[index(slot)] += square;
    right_.template segment<7>(7 * slot) += gradient;
  }

  [[nodiscard]] bool compute_steps(S damping) {
    factor_.clear();
    for (int r = 0; r < static_cast<int>(diagonal_.size()); ++r) {
      Block damped = diagonal_[index(r)];
      damped.diagonal() += damping * damped.diagonal().cwiseMax(S(1e-9));
      factor_.add(r, r, damped);
    }
    for (const Coupling& coupling : couplings_) factor_.add(coupling.row, coupling.col, coupling.block);
    if (!factor_.factor()) return false;
    steps_ = -right_;
    factor_.solve(steps_);
    return steps_.allFinite();
  }

  void step() {
    trial_ = state_;
    for (std::size_t n = 0; n < state_.size(); ++n)
      if (slots_[n] != kHeld)
        trial_[n] = state_[n].retract(Vec<S, 7>(steps_.template segment<7>(7 * slots_[n])));
  }

  [[nodiscard]] static std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

  std::vector<Sim3<S>> state_, trial_;
  std::vector<int> slots_;       // by node: its place among the free ones
  std::vector<Block> diagonal_;  // by slot
  std::vector<Coupling> couplings_;
  VecX right_, steps_;
  Factor factor_;
};

template <Scalar S>
BundleSummary PoseGraphSolver<S>::solve(PoseGraph<S>& graph) {
  BundleSummary summary;
  if (graph.edges.empty()) return summary;
  load(graph);
  Descent descent{*this, graph};
  S cost = linearise(graph);
  summary.initial_cost = summary.final_cost = static_cast<double>(cost) / 2;
  // Edges compare scales by their ratio, which hides a sign that both have.
  const bool mirrored =
      std::any_of(state_.begin(), state_.end(), [](const Sim3<S>& s) { return !(s.scale > 0); });
  if (mirrored || !std::isfinite(cost)) {
    summary.status = Status::kNotFinite;
    return summary;
  }
  analyse(graph);
  summary.status = descend<S>(descent, options, cost, summary.iterations);
  summary.final_cost = static_cast<double>(cost) / 2;
  if (improved(summary))
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) graph.nodes[n].cam_from_world = state_[n];
  return summary;
}

}  // namespace sslam
