// SPDX-License-Identifier: BSD-3-Clause
// The rotation nearest to a matrix in the Frobenius norm (orthogonal Procrustes; Umeyama, PAMI 1991).
#pragma once

#include <Eigen/SVD>

#include "sslam/core/status.hpp"
#include "sslam/geometry/so3.hpp"

namespace sslam {

// Writes `rotation` only on success. kDegenerate if the rank of the matrix is below 2: then many rotations
// are equally near.
template <Scalar S>
[[nodiscard]] Status nearest_rotation(const Mat3<S>& m, SO3<S>& rotation) noexcept {
  if (!m.allFinite()) return Status::kNotFinite;
  const Eigen::JacobiSVD<Mat3<S>> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3<S> sigma = svd.singularValues();
  if (!(sigma.y() > sigma.x() * S(1e-4))) return Status::kDegenerate;
  Mat3<S> u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= S(-1);
  rotation = SO3<S>::from_matrix(u * svd.matrixV().transpose());
  return Status::kOk;
}

}  // namespace sslam
