// SPDX-License-Identifier: BSD-3-Clause
// Reprojection errors with the camera among the unknowns, as Ceres cost functions, in standard deviations.
#pragma once

#include <array>

#include "sslam/ceres/cost_functions.hpp"
#include "sslam/residual/lens_reprojection.hpp"

namespace sslam {

using LensBlock = std::array<double, kLensDof>;  // a LensChange

// Blocks: camera, pose, landmark. `Residual` names the landmark and its reprojection error.
template <class Residual>
class LensCost final : public ceres::SizedCostFunction<2, kLensDof, 7, Residual::kBlock> {
 public:
  LensCost(const Camera<double>& camera, const typename Residual::Observed& raw, double inverse_sigma)
      : camera_(camera), raw_(raw), inverse_sigma_(inverse_sigma) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Camera<double> camera = changed(camera_, LensChange<double>(blocks[0]));
    const SE3<double> pose = load_pose(blocks[1]);
    const auto landmark = Residual::load(blocks[2]);
    typename Residual::Seen seen;
    Mat<double, 2, kLensDof> by_camera;
    if (!Residual::reproject(camera, pose, landmark, raw_, seen, &by_camera)) return false;
    Eigen::Map<Vec2<double>> out(residuals);
    out = inverse_sigma_ * seen.error;
    if (!jacobians) return true;
    if (jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 2, kLensDof, Eigen::RowMajor>> jacobian(jacobians[0]);
      jacobian = inverse_sigma_ * by_camera;
    }
    if (jacobians[1]) put_jacobian<7>((inverse_sigma_ * seen.wrt_pose()).eval(), jacobians[1]);
    if (jacobians[2])
      put_jacobian<Residual::kBlock>((inverse_sigma_ * Residual::wrt_landmark(seen, pose, landmark)).eval(),
                                     jacobians[2]);
    return true;
  }

 private:
  Camera<double> camera_;
  typename Residual::Observed raw_;
  double inverse_sigma_;
};

struct LensPoint {
  static constexpr int kBlock = 3;
  using Observed = Vec2<double>;
  using Seen = PointReprojection<double>;
  static Vec3<double> load(const double* p) { return Vec3<double>(p); }
  static bool reproject(const Camera<double>& camera, const SE3<double>& pose, const Vec3<double>& point,
                        const Observed& raw, Seen& seen, Mat<double, 2, kLensDof>* by_camera) {
    return lens_point_reprojection(camera, pose, point, raw, seen, by_camera);
  }
  static Mat<double, 2, 3> wrt_landmark(const Seen& seen, const SE3<double>& pose, const Vec3<double>&) {
    return seen.wrt_point(pose.rotation.matrix());
  }
};

struct LensLine {
  static constexpr int kBlock = 6;
  using Observed = Segment2<double>;
  using Seen = LineReprojection<double>;
  static Line3<double> load(const double* p) { return load_line(p); }
  static bool reproject(const Camera<double>& camera, const SE3<double>& pose, const Line3<double>& line,
                        const Observed& raw, Seen& seen, Mat<double, 2, kLensDof>* by_camera) {
    return lens_line_reprojection(camera, pose, line, raw, seen, by_camera);
  }
  static Mat<double, 2, 4> wrt_landmark(const Seen& seen, const SE3<double>& pose,
                                        const Line3<double>& line) {
    return seen.wrt_line(pose, line);
  }
};

using LensPointCost = LensCost<LensPoint>;
using LensLineCost = LensCost<LensLine>;

// Block: camera. How far it is from what was given.
class LensPriorCost final : public ceres::SizedCostFunction<kLensDof, kLensDof> {
 public:
  explicit LensPriorCost(const LensChange<double>& sigma) : inverse_sigma_(sigma.cwiseInverse()) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Eigen::Map<LensChange<double>> out(residuals);
    out = inverse_sigma_.cwiseProduct(LensChange<double>(blocks[0]));
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, kLensDof, kLensDof, Eigen::RowMajor>> jacobian(jacobians[0]);
      jacobian = inverse_sigma_.asDiagonal();
    }
    return true;
  }

 private:
  LensChange<double> inverse_sigma_;
};

}  // namespace sslam
