// SPDX-License-Identifier: BSD-3-Clause
// Poses, lines and planes as Ceres parameter blocks: how they lie in memory, and the core's retractions as
// manifolds.
#pragma once

#include <ceres/manifold.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "sslam/geometry/line3.hpp"
#include "sslam/geometry/plane3.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam {

using PoseBlock = std::array<double, 7>;   // quaternion w x y z, translation
using PointBlock = std::array<double, 3>;  // world
using LineBlock = std::array<double, 6>;   // Pluecker moment, direction
using PlaneBlock = std::array<double, 4>;  // unit normal, distance

[[nodiscard]] inline SE3<double> load_pose(const double* p) {
  return {SO3<double>::from_quaternion(p[0], p[1], p[2], p[3]), Vec3<double>(p[4], p[5], p[6])};
}

inline void store_pose(const SE3<double>& pose, double* p) {
  const auto& q = pose.rotation.quaternion();
  const Vec3<double>& t = pose.translation;
  std::copy_n(std::array{q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}.begin(), 7, p);
}

[[nodiscard]] inline Line3<double> load_line(const double* p) {
  return {Vec3<double>(p[0], p[1], p[2]), Vec3<double>(p[3], p[4], p[5])};
}

inline void store_line(const Line3<double>& line, double* p) {
  Eigen::Map<Vec6<double>> out(p);
  out << line.moment, line.direction;
}

[[nodiscard]] inline Plane3<double> load_plane(const double* p) {
  return {Vec3<double>(p[0], p[1], p[2]), p[3]};
}

inline void store_plane(const Plane3<double>& plane, double* p) {
  Eigen::Map<Vec4<double>> out(p);
  out << plane.normal, plane.distance;
}

// The cost functions here put the derivative by the tangent in the first columns of the derivative by the
// block, and zeros in the rest. Those columns are all that this Jacobian keeps, so the product is right and
// costs nothing.
template <int Ambient, int Tangent>
class TangentFirstManifold : public ceres::Manifold {
 public:
  int AmbientSize() const final { return Ambient; }
  int TangentSize() const final { return Tangent; }

  bool PlusJacobian(const double*, double* jacobian) const final {
    Eigen::Map<Eigen::Matrix<double, Ambient, Tangent, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }

  // Ceres' solvers never ask for the difference of two blocks.
  bool Minus(const double*, const double*, double*) const final { return false; }
  bool MinusJacobian(const double*, double*) const final { return false; }
};

// T <- Exp(xi) T with xi = (phi, rho).
class PoseManifold final : public TangentFirstManifold<7, 6> {
 public:
  bool Plus(const double* x, const double* xi, double* out) const override {
    store_pose(load_pose(x).retract(Eigen::Map<const Vec6<double>>(xi)), out);
    return true;
  }
};

// T <- Exp(phi, 0) T: the camera turns and its centre stays.
class TurningPoseManifold final : public TangentFirstManifold<7, 3> {
 public:
  bool Plus(const double* x, const double* phi, double* out) const override {
    Vec6<double> xi = Vec6<double>::Zero();
    xi.head<3>() = Eigen::Map<const Vec3<double>>(phi);
    store_pose(load_pose(x).retract(xi), out);
    return true;
  }
};

class LineManifold final : public TangentFirstManifold<6, 4> {
 public:
  bool Plus(const double* x, const double* delta, double* out) const override {
    store_line(load_line(x).retract(Eigen::Map<const Vec4<double>>(delta)), out);
    return true;
  }
};

class PlaneManifold final : public TangentFirstManifold<4, 3> {
 public:
  bool Plus(const double* x, const double* delta, double* out) const override {
    store_plane(load_plane(x).retract(Eigen::Map<const Vec3<double>>(delta)), out);
    return true;
  }
};

}  // namespace sslam
