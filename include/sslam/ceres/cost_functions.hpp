// SPDX-License-Identifier: BSD-3-Clause
// The core's residuals as Ceres cost functions, in standard deviations. Derivatives: see
// TangentFirstManifold.
#pragma once

#include <ceres/sized_cost_function.h>

#include "sslam/ceres/manifolds.hpp"
#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/bundle/bundle_ties.hpp"

namespace sslam {

// Writes a derivative by the tangent into the first columns of Ceres' derivative by the block.
template <int Ambient, int Rows, int Tangent>
void put_jacobian(const Mat<double, Rows, Tangent>& derivative, double* out) {
  using RowMajor = Eigen::Matrix<double, Rows, Ambient, Ambient == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::Map<RowMajor> jacobian(out);
  jacobian.template leftCols<Tangent>() = derivative;
  jacobian.template rightCols<Ambient - Tangent>().setZero();
}

// Blocks: pose, point. Refuses a point behind the camera.
class PointCost final : public ceres::SizedCostFunction<2, 7, 3> {
 public:
  PointCost(const PointEdge<double>& edge, const Pinhole<double>& pinhole) : edge_(edge), pinhole_(pinhole) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const SE3<double> pose = load_pose(blocks[0]);
    PointReprojection<double> seen;
    if (!point_reprojection(pinhole_, pose, Vec3<double>(blocks[1]), edge_.pixel, seen)) return false;
    Eigen::Map<Vec2<double>> out(residuals);
    out = edge_.inverse_sigma * seen.error;
    if (!jacobians) return true;
    seen.wrt_camera_point *= edge_.inverse_sigma;
    if (jacobians[0]) put_jacobian<7>(seen.wrt_pose(), jacobians[0]);
    if (jacobians[1]) put_jacobian<3>(seen.wrt_point(pose.rotation.matrix()), jacobians[1]);
    return true;
  }

 private:
  PointEdge<double> edge_;
  Pinhole<double> pinhole_;
};

// Blocks: pose, line.
class LineCost final : public ceres::SizedCostFunction<2, 7, 6> {
 public:
  LineCost(const LineEdge<double>& edge, const Pinhole<double>& pinhole) : edge_(edge), pinhole_(pinhole) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const SE3<double> pose = load_pose(blocks[0]);
    const Line3<double> line = load_line(blocks[1]);
    LineReprojection<double> seen;
    if (!line_reprojection(pinhole_, pose, line, edge_.segment, seen)) return false;
    Eigen::Map<Vec2<double>> out(residuals);
    out = edge_.inverse_sigma * seen.error;
    if (!jacobians) return true;
    seen.wrt_moment *= edge_.inverse_sigma;
    if (jacobians[0]) put_jacobian<7>(seen.wrt_pose(), jacobians[0]);
    if (jacobians[1]) put_jacobian<6>(seen.wrt_line(pose, line), jacobians[1]);
    return true;
  }

 private:
  LineEdge<double> edge_;
  Pinhole<double> pinhole_;
};

// Block: pose.
class RotationTieCost final : public ceres::SizedCostFunction<3, 7> {
 public:
  explicit RotationTieCost(const RotationTie<double>& tie) : tie_(tie) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Mat3<double> derivative;
    const bool wanted = jacobians && jacobians[0];
    Eigen::Map<Vec3<double>> out(residuals);
    out = rotation_tie_residual(tie_, load_pose(blocks[0]).rotation, wanted ? &derivative : nullptr);
    if (wanted) put_jacobian<7>(derivative, jacobians[0]);
    return true;
  }

 private:
  RotationTie<double> tie_;
};

// Block: a line, or a plane, of so many numbers and degrees of freedom; `load` reads it.
template <int Size, int Dof, auto load>
class AxisCost final : public ceres::SizedCostFunction<2, Size> {
 public:
  AxisCost(const Vec3<double>& axis, double sigma) : axis_(axis), inverse_sigma_(1 / sigma) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Mat<double, 2, Dof> derivative;
    const bool wanted = jacobians && jacobians[0];
    Eigen::Map<Vec2<double>> out(residuals);
    out = inverse_sigma_ * axis_tie_residual(axis_, load(blocks[0]), wanted ? &derivative : nullptr);
    if (wanted) put_jacobian<Size>((inverse_sigma_ * derivative).eval(), jacobians[0]);
    return true;
  }

 private:
  Vec3<double> axis_;
  double inverse_sigma_;
};
using AxisTieCost = AxisCost<6, 4, load_line>;
using PlaneAxisCost = AxisCost<4, 3, load_plane>;

// Block: pose of the free view. The centre of the held one does not move.
class ScaleTieCost final : public ceres::SizedCostFunction<1, 7> {
 public:
  ScaleTieCost(const Vec3<double>& held_centre, double distance, double sigma)
      : centre_(held_centre), distance_(distance), inverse_sigma_(1 / sigma) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Mat<double, 1, 6> derivative;
    const bool wanted = jacobians && jacobians[0];
    residuals[0] = inverse_sigma_ * scale_tie_residual(centre_, distance_, load_pose(blocks[0]),
                                                       wanted ? &derivative : nullptr);
    if (wanted) put_jacobian<7>((inverse_sigma_ * derivative).eval(), jacobians[0]);
    return true;
  }

 private:
  Vec3<double> centre_;
  double distance_, inverse_sigma_;
};

}  // namespace sslam
