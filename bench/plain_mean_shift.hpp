// SPDX-License-Identifier: BSD-3-Clause
// The published algorithm (Zhou et al., Divide and Conquer, ACCV 2016; Li et al., RA-L 2020, section III)
// word for word, on matrices of dynamic size: for each axis the normals of its cone, their logarithms in its
// tangent plane, a mean with Gaussian weights, and the nearest rotation, until it stands still.
#pragma once

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::bench {

struct PlainOptions {
  double cone = radians(15.0);  // half angle
  double kernel = 20;           // factor of the squared distance in the exponent, rad^-2
  int iterations = 20;
  double settled = 1e-4;  // rad
};

// The mean-shift step off `axis`, radians in its tangent plane (u, v).
inline Eigen::Vector2d plain_shift(const Eigen::MatrixXd& normals, const Eigen::Vector3d& axis,
                                   const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                                   const PlainOptions& options) {
  std::vector<Eigen::Vector2d> tangent;
  for (Eigen::Index i = 0; i < normals.cols(); ++i) {
    Eigen::Vector3d n = normals.col(i);
    if (n.dot(axis) < 0) n = -n;
    const double cosine = n.dot(axis);
    if (cosine < std::cos(options.cone)) continue;
    const Eigen::Vector2d side(n.dot(u), n.dot(v));
    const double sine = side.norm();
    tangent.push_back(sine > 0 ? Eigen::Vector2d(side * std::atan2(sine, cosine) / sine) : side);
  }
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weights = 0;
  for (const Eigen::Vector2d& m : tangent) {
    const double weight = std::exp(-options.kernel * m.squaredNorm());
    sum += weight * m;
    weights += weight;
  }
  return weights > 0 ? Eigen::Vector2d(sum / weights) : Eigen::Vector2d(Eigen::Vector2d::Zero());
}

// normals: 3 x N. Returns cam_from_manhattan near the start.
inline Eigen::MatrixXd plain_rotation(const Eigen::MatrixXd& normals, Eigen::MatrixXd rotation,
                                      const PlainOptions& options = {}) {
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    Eigen::MatrixXd shifted(3, 3);
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = rotation.col(k), u = rotation.col((k + 1) % 3),
                            v = rotation.col((k + 2) % 3);
      const Eigen::Vector2d step = plain_shift(normals, axis, u, v, options);
      const double angle = step.norm();
      const double sine = angle > 0 ? std::sin(angle) / angle : 1;
      shifted.col(k) = std::cos(angle) * axis + sine * (step.x() * u + step.y() * v);
      largest = std::max(largest, angle);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(shifted, Eigen::ComputeFullU | Eigen::ComputeFullV);
    rotation = svd.matrixU() * svd.matrixV().transpose();
    if (largest < options.settled) break;
  }
  return rotation;
}

}  // namespace sslam::bench
