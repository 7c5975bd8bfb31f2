// SPDX-License-Identifier: BSD-3-Clause
// The embedded engineer: one header, nothing but Eigen.
#include <array>
#include <cstdio>

#include "sslam/manhattan/rotation.hpp"

int main() {
  // Normals of a floor and of two walls, seen by a camera that is turned by a little.
  const sslam::SO3<float> truth = sslam::SO3<float>::exp({0.05F, -0.1F, 0.02F});
  constexpr std::size_t kEach = 50;
  std::array<float, 3 * kEach> x{}, y{}, z{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const sslam::Vec3<float> normal = truth.matrix().col(static_cast<int>(i / kEach));
    x[i] = normal.x();
    y[i] = normal.y();
    z[i] = normal.z();
  }
  const sslam::NormalView<float> normals{x.data(), y.data(), z.data(), nullptr, x.size()};
  const auto answer = sslam::track_manhattan<float, float>(normals, {}, sslam::ManhattanPrior<float>{});
  const float error = sslam::angle_between(answer.cam_from_manhattan, truth);
  std::printf("%s, %d axes, error %.4f degrees\n", sslam::name(answer.status), answer.axes_seen,
              static_cast<double>(sslam::degrees(error)));
  return sslam::usable(answer.status) && error < 0.01F ? 0 : 1;
}
