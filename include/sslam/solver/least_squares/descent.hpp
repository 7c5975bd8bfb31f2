// SPDX-License-Identifier: BSD-3-Clause
// The damping schedule of Levenberg-Marquardt for problems of any size, which keep their own equations.
#pragma once

#include <algorithm>
#include <concepts>
#include <limits>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/core/types.hpp"

namespace sslam {

template <class T, class S>
concept DescentProblem = requires(T problem, S damping) {
  { problem.solve(damping) } -> std::same_as<bool>;  // computes the steps; false: cannot be factored
  { problem.try_step() } -> std::same_as<S>;         // the cost after them
  problem.take_step();                               // the tried state becomes the state
  { problem.linearise() } -> std::same_as<S>;        // new equations; the cost at the state
};

template <Scalar S>
struct DescentOptions {
  int max_iterations = 8;
  S initial_damping = S(1e-4);  // relative to the diagonal of the normal equations
  S min_decrease = S(1e-4);     // relative decrease of the cost that ends the search

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_iterations", self.max_iterations, Unit::kCount, 1, 10000, "steps tried at most");
    visit("initial_damping", self.initial_damping, Unit::kNumber, 0, 1e6,
          "relative to the diagonal of the normal equations");
    visit("min_decrease", self.min_decrease, Unit::kShare, 0, 1,
          "of the cost: a step that wins less is the last");
  }
};
static_assert(Described<DescentOptions<double>>);

// From a linearised problem of the given cost down; a step that does not lower the cost is refused. kOk:
// stands still; kNotConverged: ran out of iterations; kDegenerate: no damping lets the equations be factored.
template <Scalar S, DescentProblem<S> Problem>
[[nodiscard]] Status descend(Problem& problem, const DescentOptions<S>& options, S& cost, int& iterations) {
  constexpr S kMinDamping = S(1e-9), kMaxDamping = S(1e6);
  S damping = options.initial_damping;
  bool factored = false;
  while (iterations < options.max_iterations) {
    ++iterations;
    const bool solved = problem.solve(damping);
    factored = factored || solved;
    const S tried = solved ? problem.try_step() : std::numeric_limits<S>::infinity();
    if (!(tried < cost)) {
      damping *= 10;
      if (damping > kMaxDamping) return factored ? Status::kOk : Status::kDegenerate;
      continue;
    }
    const bool done = cost - tried < options.min_decrease * cost;
    problem.take_step();
    cost = tried;
    damping = std::max(damping / 10, kMinDamping);
    if (done) return Status::kOk;
    if (iterations < options.max_iterations) cost = problem.linearise();
  }
  return factored ? Status::kNotConverged : Status::kDegenerate;
}

}  // namespace sslam
