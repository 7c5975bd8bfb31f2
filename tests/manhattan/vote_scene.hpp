// SPDX-License-Identifier: BSD-3-Clause
// Simulated votes of a Manhattan world: normals with scatter and clutter, segments seen by a 640 x 480
// camera.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/manhattan/votes.hpp"
#include "support/random_draws.hpp"
#include "support/spoiled_input.hpp"

namespace sslam::test {

using testing::gaussian;
using testing::gaussian_vector;

inline SO3<double> any_rotation(Random& random) {
  const Vec4<double> q = gaussian_vector<4>(random);
  return SO3<double>::from_quaternion(q[0], q[1], q[2], q[3]);
}

template <Scalar S>
struct VoteScene {
  Random random;
  SO3<double> truth;  // cam_from_manhattan
  std::vector<S> x, y, z;
  std::vector<LineVote<S>> votes;

  VoteScene(std::uint64_t seed, const SO3<double>& cam_from_manhattan)
      : random(seed), truth(cam_from_manhattan) {}

  void add_normal(const Vec3<double>& direction) {
    const Vec3<double> n = direction.normalized();
    x.push_back(static_cast<S>(n.x()));
    y.push_back(static_cast<S>(n.y()));
    z.push_back(static_cast<S>(n.z()));
  }

  // `scatter_deg` per component; every other normal has the other sign; `bias` (radians) is the plane's own.
  void add_plane(int axis, int count, double scatter_deg, const Vec3<double>& bias = Vec3<double>::Zero()) {
    const Vec3<double> a = (SO3<double>::exp(bias) * truth).matrix().col(axis);
    for (int i = 0; i < count; ++i)
      add_normal((i % 2 == 0 ? 1.0 : -1.0) * (a + radians(scatter_deg) * gaussian_vector<3>(random)));
  }

  void add_clutter_normals(int count) {
    for (int i = 0; i < count; ++i) add_normal(gaussian_vector<3>(random));
  }

  Vec3<double> any_ray() {
    const double u = random.uniform(-0.65, 0.65);
    return Vec3<double>(u, random.uniform(-0.5, 0.5), 1).normalized();
  }

  void add_line(const Vec3<double>& ray, const Vec3<double>& normal, double sigma) {
    const Vec3<double> n = normal.normalized();
    const Vec3<double> turned = n + sigma * gaussian(random) * ray.cross(n);
    votes.push_back({turned.normalized().cast<S>(), static_cast<S>(sigma), ray.cast<S>()});
  }

  void add_lines(int axis, int count, double sigma) {
    for (int i = 0; i < count; ++i) {
      const Vec3<double> ray = any_ray();
      add_line(ray, ray.cross(Vec3<double>(truth.matrix().col(axis))), sigma);
    }
  }

  void add_clutter_lines(int count, double sigma) {
    for (int i = 0; i < count; ++i) {
      const Vec3<double> ray = any_ray();
      const Vec3<double> side = ray.unitOrthogonal();
      const double turn = random.uniform(0.0, std::numbers::pi);
      add_line(ray, std::cos(turn) * side + std::sin(turn) * ray.cross(side), sigma);
    }
  }

  // A copy with some odd numbers in it.
  [[nodiscard]] VoteScene spoiled(Random& odd) const {
    VoteScene scene = *this;
    scene.votes = testing::spoiled<S>(votes, odd);
    for (auto* component : {&scene.x, &scene.y, &scene.z})
      testing::spoil<S>(std::span(*component), static_cast<int>(odd.below(2)), odd);
    return scene;
  }

  [[nodiscard]] NormalView<S> normals() const { return {x.data(), y.data(), z.data(), nullptr, x.size(), 1}; }
  [[nodiscard]] std::span<const LineVote<S>> lines() const { return votes; }
};

// A corner: `normals` on each of three planes, and 20 segments along each axis.
template <Scalar S>
VoteScene<S> corner(std::uint64_t seed, const SO3<double>& cam_from_manhattan, int normals) {
  VoteScene<S> scene(seed, cam_from_manhattan);
  for (int k = 0; k < 3; ++k) {
    scene.add_plane(k, normals, 4);
    scene.add_lines(k, 20, 0.006);
  }
  return scene;
}

// Degrees between an estimate and the truth of a scene, with the names of the axes as they are.
template <Scalar S>
double error_deg(const SO3<S>& estimate, const SO3<double>& truth) {
  return degrees(angle_between(estimate.template cast<double>(), truth));
}

}  // namespace sslam::test
