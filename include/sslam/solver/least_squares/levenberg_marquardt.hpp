// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt with D x D normal equations of fixed size, on any state with a retraction.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/geometry/manifold.hpp"

namespace sslam {

// Sums of J^T w J and J^T w r over the rows of a least-squares problem. Only the lower half of H is kept
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
  double min_decrease =
      1e-6;  // share of the cost: a step that wins less, or promises a tenth of it, is the last

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_iterations", self.max_iterations, Unit::kCount, 1, 10000, "steps tried at most");
    visit("initial_damping", self.initial_damping, Unit::kNumber, 0, 1e6,
          "relative to the diagonal of the normal equations");
    visit("min_step", self.min_step, Unit::kNumber, 0, 1,
          "length of a step below which the state stands still");
    visit("min_decrease", self.min_decrease, Unit::kShare, 0, 1,
          "of the cost: a step that wins less is the last");
  }
};
static_assert(Described<LmOptions>);

template <Scalar S, int D>
struct LmSummary {
  Status status = Status::kTooFew;
  int iterations = 0;  // steps tried
  S initial_cost = 0, final_cost = 0;
  int count = 0;
  Mat<S, D, D> information = Mat<S, D, D>::Zero();  // J^T W J at the answer
};

// Whether the information matrix tells every direction of the tangent, up to rounding: a Cholesky
// factorisation of the matrix scaled to a unit diagonal, so that the units of its rows do not matter. A
// diagonal entry that is the square of a rounding error is no information in any unit.
template <Scalar S, int D>
[[nodiscard]] bool is_observable(const Mat<S, D, D>& information) noexcept {
  constexpr S kEpsilon = std::numeric_limits<S>::epsilon();
  constexpr S kMinPivot = 64 * kEpsilon;
  const S least = kEpsilon * std::sqrt(kEpsilon) * information.diagonal().maxCoeff();
  Vec<S, D> scale;
  for (int a = 0; a < D; ++a) {
    if (!(information(a, a) > least)) return false;
    scale[a] = 1 / std::sqrt(information(a, a));
  }
  Mat<S, D, D> l = scale.asDiagonal() * information * scale.asDiagonal();
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b <= a; ++b) {
      S sum = l(a, b);
      for (int c = 0; c < b; ++c) sum -= l(a, c) * l(b, c);
      if (a == b && !(sum > kMinPivot)) return false;
      l(a, b) = a == b ? std::sqrt(sum) : sum / l(b, b);
    }
  }
  return true;
}

namespace detail {

// A problem and its value, gradient and curvature at one state.
template <Scalar S, int D>
struct Linearized {
  NormalEquations<S, D> equations;
  Evaluated<S> value;

  template <class Problem, class X>
  Linearized(const Problem& problem, const X& x) noexcept {
    value = counted(problem(x, equations));
    equations.complete();
  }
  [[nodiscard]] bool finite() const noexcept {
    return std::isfinite(value.cost) && equations.H.allFinite() && equations.g.allFinite();
  }
  // Solves (H + damping diag H) step = -g.
  [[nodiscard]] bool solve(S damping, Vec<S, D>& step) const noexcept {
    Mat<S, D, D> damped = equations.H;
    for (int a = 0; a < D; ++a) damped(a, a) += damping * std::max(damped(a, a), S(1e-9));
    const Eigen::LLT<Mat<S, D, D>> factor(damped);
    if (factor.info() != Eigen::Success) return false;
    step = -factor.solve(equations.g);
    return step.allFinite();
  }

 private:
  // A problem that answers its cost alone is counted by its rows.
  [[nodiscard]] Evaluated<S> counted(S cost) const noexcept { return {cost, equations.count}; }
  [[nodiscard]] Evaluated<S> counted(const Evaluated<S>& evaluated) const noexcept { return evaluated; }
};

}  // namespace detail

// problem(x, equations) adds its rows at x to equations and returns the cost, or Evaluated<S> where not
// every observation is valid at every state. A step is refused, and the damping raised, when H cannot be
// factored, when anything is not finite, when the cost does not fall or when the number of valid observations
// changes; the state only ever changes to a better one.
//   kOk: stands still; kNotConverged: ran out of iterations, or nothing but refused observations lies around;
//   kTooFew: nothing valid at the start; kNotFinite: at the start; kDegenerate: H cannot be factored at any
//   damping.
template <Manifold X, class Problem, class S = ScalarOf<X>>
[[nodiscard]] LmSummary<S, X::kDof> minimize(const Problem& problem, X& x,
                                             const LmOptions& options = {}) noexcept {
  constexpr int D = X::kDof;
  constexpr S kMinDamping = S(1e-9), kMaxDamping = S(1e6);
  constexpr S kRounding = 32 * std::numeric_limits<S>::epsilon();
  LmSummary<S, D> summary;
  detail::Linearized<S, D> current(problem, x);
  summary.initial_cost = current.value.cost;
  const auto finish = [&](Status status) {
    summary.status = status;
    summary.final_cost = current.value.cost;
    summary.count = current.value.count;
    summary.information = current.equations.H;
    return summary;
  };
  if (current.value.count == 0) return finish(Status::kTooFew);
  if (!current.finite()) return finish(Status::kNotFinite);

  const auto min_decrease = static_cast<S>(options.min_decrease);
  S damping = static_cast<S>(options.initial_damping);
  bool factored = false, comparable = true;
  while (summary.iterations < options.max_iterations && damping < kMaxDamping) {
    ++summary.iterations;
    Vec<S, D> step;
    if (!current.solve(damping, step)) {
      damping *= 10;
      continue;
    }
    factored = true;
    // The linear model promises at least -g . step.
    const S promised = -current.equations.g.dot(step);
    if (step.norm() < static_cast<S>(options.min_step) ||
        promised <= min_decrease * S(0.1) * current.value.cost)
      return finish(Status::kOk);
    const X trial = x.retract(step);
    const detail::Linearized<S, D> tried(problem, trial);
    comparable = tried.value.count == current.value.count && tried.finite();
    if (!comparable || !(tried.value.cost < current.value.cost)) {
      // A win that drowns in the rounding of the cost: no damping would show it.
      if (comparable && promised <= kRounding * current.value.cost) return finish(Status::kOk);
      damping *= 10;
      continue;
    }
    const bool settled = current.value.cost - tried.value.cost < min_decrease * current.value.cost;
    x = trial;
    current = tried;
    damping = std::max(damping / 10, kMinDamping);
    if (settled) return finish(Status::kOk);
  }
  if (!factored && summary.iterations > 0) return finish(Status::kDegenerate);
  // Damped into standing still: no better state is near.
  return finish(damping >= kMaxDamping && comparable ? Status::kOk : Status::kNotConverged);
}

}  // namespace sslam
