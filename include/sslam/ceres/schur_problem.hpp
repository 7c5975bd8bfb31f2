// SPDX-License-Identifier: BSD-3-Clause
// What problems of cameras and landmarks have in common: who owns their parts, how they are solved, and how
// an observation joins them.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cmath>
#include <memory>

namespace sslam {

// Costs, losses and manifolds belong to whoever adds them, and outlive the problem.
[[nodiscard]] inline ceres::Problem::Options borrowing_problem() {
  ceres::Problem::Options o;
  o.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  o.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  o.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return o;
}

// Landmarks, which are group 0, are eliminated first. `sparse`: what remains, group 1, is solved as a sparse
// system. One thread, nothing is printed.
[[nodiscard]] inline ceres::Solver::Options schur_options(
    bool sparse, const std::shared_ptr<ceres::ParameterBlockOrdering>& ordering) {
  ceres::Solver::Options o;
  o.linear_solver_type = sparse ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
  o.linear_solver_ordering = ordering;
  o.num_threads = 1;
  o.logging_type = ceres::SILENT;
  return o;
}

// An observation that cannot be evaluated at the start would fail the whole problem: it is left out, and the
// answer is false. `cost` has two residuals, of these blocks.
template <class Cost, class... Blocks>
bool add_observation(Cost& cost, ceres::LossFunction& loss, ceres::Problem& problem, Blocks*... blocks) {
  const double* const at[] = {blocks...};
  double residual[2];
  if (!cost.Evaluate(at, residual, nullptr) || !std::isfinite(residual[0]) || !std::isfinite(residual[1]))
    return false;
  problem.AddResidualBlock(&cost, &loss, blocks...);
  return true;
}

}  // namespace sslam
