// SPDX-License-Identifier: BSD-3-Clause
// The core's ties to planes as Ceres cost functions, in standard deviations.
#pragma once

#include <Eigen/Eigenvalues>

#include "sslam/ceres/cost_functions.hpp"
#include "sslam/residual/line_on_plane.hpp"
#include "sslam/residual/point_on_plane.hpp"

namespace sslam {

// Blocks: plane, point.
class PointOnPlaneCost final : public ceres::SizedCostFunction<1, 4, 3> {
 public:
  explicit PointOnPlaneCost(double sigma) : inverse_sigma_(1 / sigma) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const PointOnPlane<double> tie = point_on_plane(load_plane(blocks[0]), Vec3<double>(blocks[1]));
    residuals[0] = inverse_sigma_ * tie.error[0];
    if (!jacobians) return true;
    if (jacobians[0]) put_jacobian<4>((inverse_sigma_ * tie.wrt_plane).eval(), jacobians[0]);
    if (jacobians[1]) put_jacobian<3>((inverse_sigma_ * tie.wrt_point).eval(), jacobians[1]);
    return true;
  }

 private:
  double inverse_sigma_;
};

// Blocks: plane, line.
class LineOnPlaneCost final : public ceres::SizedCostFunction<2, 4, 6> {
 public:
  LineOnPlaneCost(const Vec3<double>& start, const Vec3<double>& end, double sigma)
      : start_(start), end_(end), inverse_sigma_(1 / sigma) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const LineOnPlane<double> tie = line_on_plane(load_plane(blocks[0]), load_line(blocks[1]), start_, end_);
    Eigen::Map<Vec2<double>> out(residuals);
    out = inverse_sigma_ * tie.error;
    if (!jacobians) return true;
    if (jacobians[0]) put_jacobian<4>((inverse_sigma_ * tie.wrt_plane).eval(), jacobians[0]);
    if (jacobians[1]) put_jacobian<6>((inverse_sigma_ * tie.wrt_line).eval(), jacobians[1]);
    return true;
  }

 private:
  Vec3<double> start_, end_;
  double inverse_sigma_;
};

// Block: plane. The members that stay: see BundlePlane::held.
class PlaneHeldCost final : public ceres::SizedCostFunction<4, 4> {
 public:
  PlaneHeldCost(const Mat<double, 4, 4>& held, double sigma) {
    // A symmetric root: held may be singular, as that of two points is.
    const Eigen::SelfAdjointEigenSolver<Mat<double, 4, 4>> eigen(held);
    root_ = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
    root_ /= sigma;
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Eigen::Map<Vec4<double>> out(residuals);
    out = root_ * Eigen::Map<const Vec4<double>>(blocks[0]);
    if (jacobians && jacobians[0])
      put_jacobian<4>((root_ * load_plane(blocks[0]).retract_jacobian()).eval(), jacobians[0]);
    return true;
  }

 private:
  Mat<double, 4, 4> root_;
};

}  // namespace sslam
