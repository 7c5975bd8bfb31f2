// SPDX-License-Identifier: BSD-3-Clause
// Firmware without a heap, exceptions or type information: buffers of fixed size, two kernels, and an exit
// code. tests/embedded holds its object to the same rules as the kernels alone.
#include <array>
#include <cstdint>

#include "sslam/core/random.hpp"
#include "sslam/manhattan/rotation.hpp"
#include "sslam/solver/two_view/translation.hpp"

namespace {

using namespace sslam;

constexpr std::size_t kNormals = 300;
constexpr std::size_t kMatches = 64;

// Where an interrupt or a transfer would put what the sensor sees.
float normal_x[kNormals], normal_y[kNormals], normal_z[kNormals];
BearingMatch<float> matches[kMatches];
std::uint8_t inliers[kMatches];

// A floor and two walls, each normal off by a little.
void receive_normals(const SO3<float>& cam_from_room, Random& noise) noexcept {
  const Mat3<float> axes = cam_from_room.matrix();
  for (std::size_t i = 0; i < kNormals; ++i) {
    Vec3<float> n = axes.col(static_cast<int>(i % 3));
    for (int k = 0; k < 3; ++k) n[k] += noise.uniform(-0.05F, 0.05F);
    n.normalize();
    normal_x[i] = n.x();
    normal_y[i] = n.y();
    normal_z[i] = n.z();
  }
}

// Points two to five metres ahead, before and after a step; every eighth match is wrong.
void receive_matches(const SO3<float>& R_10, const Vec3<float>& t_10, Random& noise) noexcept {
  for (std::size_t i = 0; i < kMatches; ++i) {
    Vec3<float> x, wrong(0, 0, 1);
    for (int k = 0; k < 2; ++k) x[k] = noise.uniform(-1.0F, 1.0F);
    x[2] = noise.uniform(2.0F, 5.0F);
    for (int k = 0; k < 2; ++k) wrong[k] = noise.uniform(-0.5F, 0.5F);
    const Vec3<float> moved = R_10 * x + t_10;
    matches[i].ray0 = x / x.z();
    matches[i].ray1 = i % 8 == 0 ? wrong : Vec3<float>(moved / moved.z());
  }
}

}  // namespace

int main() {
  Random noise(1);
  const SO3<float> before, now = SO3<float>::exp({0.05F, -0.1F, 0.02F});
  const Vec3<float> step(0.2F, 0.05F, 0.1F);
  receive_normals(now, noise);
  receive_matches(now, step, noise);

  const NormalView<float> normals{normal_x, normal_y, normal_z, nullptr, kNormals};
  const auto turned = track_manhattan<float, float>(normals, {}, ManhattanPrior<float>{before});
  if (!usable(turned.status) || !(angle_between(turned.cam_from_manhattan, now) < radians(0.5F))) return 1;

  TranslationOptions<float> options;
  options.rotation_sigma = turned.deviation;
  const SO3<float> R_10 = turned.cam_from_manhattan * before.inverse();
  const auto moved = translation_from_rotation<float>(matches, R_10, options, 1, inliers);
  if (!usable(moved.status)) return 2;
  return moved.t_10.dot(step.normalized()) > 0.995F ? 0 : 3;
}
