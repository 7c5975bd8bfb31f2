// SPDX-License-Identifier: BSD-3-Clause
// The covariance of one parameter block of a Ceres problem, all others being unknown as well.
#pragma once

#include <ceres/crs_matrix.h>
#include <ceres/problem.h>

#include <Eigen/Sparse>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam {

// The block's part of (J^T J)^-1, by one factorisation of the whole: ceres::Covariance would take a QR
// decomposition, a hundred times as long. False where the problem leaves the block open.
template <int Size>
[[nodiscard]] bool marginal_covariance(ceres::Problem& problem, double* block, Mat<double, Size, Size>& out) {
  ceres::Problem::EvaluateOptions options;
  std::vector<double*> blocks;
  problem.GetParameterBlocks(&blocks);
  options.parameter_blocks.push_back(block);
  for (double* other : blocks)
    if (other != block && !problem.IsParameterBlockConstant(other)) options.parameter_blocks.push_back(other);
  ceres::CRSMatrix j;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &j)) return false;
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const Eigen::SparseMatrix<double> jacobian =
      Eigen::Map<const Rows>(j.num_rows, j.num_cols, static_cast<int>(j.values.size()), j.rows.data(),
                             j.cols.data(), j.values.data());
  Eigen::SparseMatrix<double> information = jacobian.transpose() * jacobian;
  // What no observation holds, a line that is seen along its length, must not stop the factorisation.
  constexpr double kFloor = 1e-9;
  for (int i = 0; i < information.rows(); ++i) information.coeffRef(i, i) += kFloor;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(information);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(information.rows(), Size);
  out = factor.solve(unit).template topRows<Size>();
  return out.allFinite();
}

}  // namespace sslam
