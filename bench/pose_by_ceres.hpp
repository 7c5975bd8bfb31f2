// SPDX-License-Identifier: BSD-3-Clause
// The pose of a camera from points and lines of the map as users of Ceres would solve it: by its full solver
// on the core's retraction, and by TinySolver on an angle axis and a translation.
#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/tiny_solver.h>

#include <span>

#include "sslam/ceres/cost_functions.hpp"
#include "sslam/solver/pose/pose_problem.hpp"

namespace sslam::bench {

struct PoseData {
  const Pinhole<double>& pinhole;
  std::span<const PointObservation<double>> points;
  std::span<const LineObservation<double>> lines;
};

// Error in standard deviations and its derivative by the left perturbation; false where there is no image.
[[nodiscard]] inline bool evaluate(const Pinhole<double>& pinhole, const SE3<double>& pose,
                                   const PointObservation<double>& o, Vec2<double>& error,
                                   Mat<double, 2, 6>& wrt_pose) {
  PointReprojection<double> seen;
  if (!point_reprojection(pinhole, pose, o.point_world, o.pixel, seen)) return false;
  error = seen.error / o.sigma;
  wrt_pose = seen.wrt_pose() / o.sigma;
  return true;
}
[[nodiscard]] inline bool evaluate(const Pinhole<double>& pinhole, const SE3<double>& pose,
                                   const LineObservation<double>& o, Vec2<double>& error,
                                   Mat<double, 2, 6>& wrt_pose) {
  LineReprojection<double> seen;
  if (!line_reprojection(pinhole, pose, o.line_world, o.segment, seen)) return false;
  error = seen.error / o.sigma;
  wrt_pose = seen.wrt_pose() / o.sigma;
  return true;
}

template <class Observation>
class PoseCost final : public ceres::SizedCostFunction<2, 7> {
 public:
  PoseCost(const Pinhole<double>& pinhole, const Observation& o) : pinhole_(pinhole), observation_(o) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Vec2<double> error;
    Mat<double, 2, 6> wrt_pose;
    if (!evaluate(pinhole_, load_pose(blocks[0]), observation_, error, wrt_pose)) return false;
    Eigen::Map<Vec2<double>> out(residuals);
    out = error;
    if (jacobians && jacobians[0]) put_jacobian<7>(wrt_pose, jacobians[0]);
    return true;
  }

 private:
  const Pinhole<double>& pinhole_;
  const Observation& observation_;
};

// Returns the number of steps; the pose is start and answer.
inline int solve_by_ceres(const PoseData& data, SE3<double>& pose) {
  PoseBlock block;
  store_pose(pose, block.data());
  ceres::Problem problem;
  problem.AddParameterBlock(block.data(), 7, new PoseManifold);
  for (const auto& o : data.points)
    problem.AddResidualBlock(new PoseCost<PointObservation<double>>(data.pinhole, o), nullptr, block.data());
  for (const auto& o : data.lines)
    problem.AddResidualBlock(new PoseCost<LineObservation<double>>(data.pinhole, o), nullptr, block.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  pose = load_pose(block.data());
  return static_cast<int>(summary.iterations.size()) - 1;
}

// What TinySolver asks of a problem. Parameters: angle axis of the rotation, translation.
class TinyPose {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = 6, NUM_RESIDUALS = Eigen::Dynamic };

  explicit TinyPose(const PoseData& data) : data_(data) {}

  [[nodiscard]] int NumResiduals() const {
    return 2 * static_cast<int>(data_.points.size() + data_.lines.size());
  }
  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Vec3<double> w(parameters[0], parameters[1], parameters[2]);
    const SE3<double> pose{SO3<double>::exp(w), {parameters[3], parameters[4], parameters[5]}};
    const Mat3<double> turn = left_jacobian(w), lever = hat(pose.translation);
    double* next_residual = residuals;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6>> j(jacobian, jacobian ? NumResiduals() : 0, 6);
    const auto put = [&](const auto& observation) {
      Vec2<double> error;
      Mat<double, 2, 6> wrt_pose;
      if (!evaluate(data_.pinhole, pose, observation, error, wrt_pose)) return false;
      // The angle axis alone moves the pose by xi = (J dw, t x J dw).
      const Mat<double, 2, 3> wrt_phi = wrt_pose.leftCols<3>() + wrt_pose.rightCols<3>() * lever;
      const auto row = next_residual - residuals;
      Eigen::Map<Vec2<double>> out(next_residual);
      out = error;
      if (jacobian) j.middleRows<2>(row) << wrt_phi * turn, wrt_pose.rightCols<3>();
      next_residual += 2;
      return true;
    };
    for (const auto& o : data_.points)
      if (!put(o)) return false;
    for (const auto& o : data_.lines)
      if (!put(o)) return false;
    return true;
  }

 private:
  const PoseData& data_;
};

inline int solve_by_tiny_solver(const PoseData& data, SE3<double>& pose) {
  Vec6<double> parameters;
  parameters << pose.rotation.log(), pose.translation;
  ceres::TinySolver<TinyPose> solver;
  solver.Solve(TinyPose(data), &parameters);
  pose = {SO3<double>::exp(Vec3<double>(parameters.head<3>())), parameters.tail<3>()};
  return solver.summary.iterations;
}

}  // namespace sslam::bench
