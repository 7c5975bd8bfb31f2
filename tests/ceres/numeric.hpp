// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of a cost function by central differences along a manifold's retraction.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <Eigen/Core>
#include <vector>

namespace sslam::testing {

// With respect to the tangent of block b; without a manifold, the block itself.
inline Eigen::MatrixXd numeric_jacobian(const ceres::CostFunction& cost,
                                        std::vector<std::vector<double>> blocks, std::size_t b,
                                        const ceres::Manifold* manifold) {
  const auto rows = cost.num_residuals();
  const auto size = static_cast<int>(blocks[b].size());
  const int cols = manifold ? manifold->TangentSize() : size;
  const std::vector<double> at = blocks[b];
  Eigen::MatrixXd out(rows, cols);
  constexpr double kStep = 1e-6;
  for (int c = 0; c < cols; ++c) {
    Eigen::VectorXd values[2];
    for (int side = 0; side < 2; ++side) {
      Eigen::VectorXd delta = Eigen::VectorXd::Zero(cols);
      delta[c] = side == 0 ? kStep : -kStep;
      if (manifold)
        manifold->Plus(at.data(), delta.data(), blocks[b].data());
      else
        for (int i = 0; i < size; ++i)
          blocks[b][static_cast<std::size_t>(i)] = at[static_cast<std::size_t>(i)] + delta[i];
      std::vector<const double*> pointers;
      for (const auto& block : blocks) pointers.push_back(block.data());
      values[side].resize(rows);
      cost.Evaluate(pointers.data(), values[side].data(), nullptr);
    }
    out.col(c) = (values[0] - values[1]) / (2 * kStep);
  }
  return out;
}

// What Ceres makes of the analytic derivative: the block's, times the manifold's plus Jacobian.
inline Eigen::MatrixXd analytic_jacobian(const ceres::CostFunction& cost,
                                         const std::vector<std::vector<double>>& blocks, std::size_t b,
                                         const ceres::Manifold* manifold) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = cost.num_residuals();
  const auto size = static_cast<int>(blocks[b].size());
  std::vector<double> storage(static_cast<std::size_t>(rows * size)),
      residuals(static_cast<std::size_t>(rows));
  std::vector<const double*> pointers;
  for (const auto& block : blocks) pointers.push_back(block.data());
  std::vector<double*> jacobians(blocks.size(), nullptr);
  jacobians[b] = storage.data();
  cost.Evaluate(pointers.data(), residuals.data(), jacobians.data());
  const RowMajor by_block = Eigen::Map<const RowMajor>(storage.data(), rows, size);
  if (!manifold) return by_block;
  RowMajor plus(size, manifold->TangentSize());
  manifold->PlusJacobian(blocks[b].data(), plus.data());
  return by_block * plus;
}

}  // namespace sslam::testing
