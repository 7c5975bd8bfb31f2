// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt with D x D normal equations of fixed size, on any state with a retraction.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <concepts>

#include "sslam/core/status.hpp"
#include "sslam/core/types.hpp"

namespace sslam {

template <class X>
using ScalarOf = typename X::ScalarType;

// A state that is moved by tangent vectors of kDof entries.
template <class X>
concept Manifold = requires(const X x, const Vec<ScalarOf<X>, X::kDof>& delta) {
  { x.retract(delta) } -> std::convertible_to<X>;
};

// Sums of J^T w J, J^T w r and w r^2 over the rows of a least-squares problem. Only the lower half of H is kept
// while summing; complete() mirrors it.
template <Scalar S, int D>
struct NormalEquations {
  Mat<S, D, D> H = Mat<S, D, D>::Zero();
  Vec<S, D> g = Vec<S, D>::Zero();
  int count = 0;  // rows added

  // One row: residual r with derivative j and weight w >= 0.
  void add(const Mat<S, 1, D>& j, S r, S w) noexcept {
    for (int a = 0; a < D; ++a) {
      const S wj = w * j[a];
      for (int b = 0; b <= a; ++b) H(a, b) += wj * j[b];
      g[a] += wj * r;
    }
    ++count;
  }
  void complete() noexcept {
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < a; ++b) H(b, a) = H(a, b);
  }
};

// The answer of a problem in which the set of valid observations depends on the state.
template <Scalar S>
struct Evaluated {
  S cost = 0;     // sum of rho, halves left out
  int count = 0;  // observations that took part; a step that changes it compares unlike things and is refused
};

struct LmOptions {
  int max_iterations = 10;
  double initial_damping = 1e-4;  // relative to the diagonal of H
  double min_step = 1e-7;         // tangent norm below which the state stands still
  double min_decrease = 1e-6;     // relative decrease of the cost that ends the search
};

template <Scalar S, int D>
struct LmSummary {
  Status status = Status::kTooFew;
  int iterations = 0;
  S initial_cost = 0, final_cost = 0;
  int count = 0;
  Mat<S, D, D> information = Mat<S, D, D>::Zero();  // J^T W J at the answer
};

namespace detail {

// A problem that answers its cost alone has the same observations everywhere.
template <Scalar S>
[[nodiscard]] Evaluated<S> counted(S cost, int count) noexcept {
  return {cost, count};
}
template <Scalar S>
[[nodiscard]] Evaluated<S> counted(const Evaluated<S>& evaluated, int) noexcept {
  return evaluated;
}

}  // namespace detail

// problem(x, equations): evaluates at x, adding to *equations unless it is null, and returns the cost
// or Evaluated<S>. The state changes only when the cost goes down. kDegenerate: H cannot be factored at any damping; kNotFinite: at the start.
template <Manifold X, class Problem, class S = ScalarOf<X>>
[[nodiscard]] LmSummary<S, X::kDof> minimize(const Problem& problem, X& x, const LmOptions& options = {}) noexcept {
  constexpr int D = X::kDof;
  LmSummary<S, D> summary;
  NormalEquations<S, D> equations;
  Evaluated<S> current = detail::counted<S>(problem(x, &equations), equations.count);
  equations.complete();
  summary.initial_cost = summary.final_cost = current.cost;
  summary.count = current.count;
  summary.information = equations.H;
  if (current.count == 0) return summary;
  if (!std::isfinite(current.cost) || !equations.H.allFinite() || !equations.g.allFinite()) {
    summary.status = Status::kNotFinite;
    return summary;
  }
  summary.status = Status::kNotConverged;
  constexpr S kMaxDamping = S(1e6);
  S damping = static_cast<S>(options.initial_damping);
  bool factored = false;
  while (summary.iterations < options.max_iterations && damping < kMaxDamping) {
    ++summary.iterations;
    Mat<S, D, D> damped = equations.H;
    for (int a = 0; a < D; ++a) damped(a, a) += damping * std::max(damped(a, a), S(1e-9));
    const Eigen::LLT<Mat<S, D, D>> factor(damped);
    const bool solved = factor.info() == Eigen::Success;
    const Vec<S, D> step = solved ? Vec<S, D>(-factor.solve(equations.g)) : Vec<S, D>(Vec<S, D>::Zero());
    if (!solved || !step.allFinite()) {
      damping *= 10;
      continue;
    }
    factored = true;
    if (step.norm() < static_cast<S>(options.min_step)) {
      summary.status = Status::kOk;
      break;
    }
    const X trial = x.retract(step);
    const Evaluated<S> tried =
        detail::counted<S>(problem(trial, static_cast<NormalEquations<S, D>*>(nullptr)), current.count);
    if (!(tried.cost < current.cost) || tried.count != current.count) {
      damping *= 10;
      continue;
    }
    const S decrease = (current.cost - tried.cost) / std::max(current.cost, S(1e-30));
    x = trial;
    damping = std::max(damping / 10, S(1e-9));
    equations = {};
    current = detail::counted<S>(problem(x, &equations), equations.count);
    equations.complete();
    summary.information = equations.H;
    if (decrease < static_cast<S>(options.min_decrease)) {
      summary.status = Status::kOk;
      break;
    }
  }
  // Damped into standing still: no better state is near.
  if (factored && damping >= kMaxDamping) summary.status = Status::kOk;
  if (!factored) summary.status = Status::kDegenerate;
  summary.final_cost = current.cost;
  summary.count = current.count;
  return summary;
}

}  // namespace sslam
