// SPDX-License-Identifier: BSD-3-Clause
// The tracked Manhattan rotation: whatever votes there are, a usable answer is finite, and any answer a
// rotation.
#include <cmath>
#include <vector>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/manhattan/rotation.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const std::size_t normals = bytes.take<std::uint8_t>() % 70, lines = bytes.take<std::uint8_t>() % 20;
  constexpr std::size_t kRow = 7;
  std::vector<double> votes;
  for (std::size_t i = 0; i < normals + lines + 2; ++i) {
    Vec3<double> near = Vec3<double>::Unit(static_cast<int>(random.below(3)));
    for (double& part : near) part += random.uniform(-0.05, 0.05);
    const Vec3<double> across = near.cross(Vec3<double>(0.3, 0.5, 0.8)).normalized();
    if (i < normals) near.normalize();
    const Vec3<double> first = i < normals ? near : across;
    const Vec3<double> ray = first.cross(near).normalized();
    for (const double number : {first.x(), first.y(), first.z(), 0.01, ray.x(), ray.y(), ray.z()})
      votes.push_back(number);
  }
  fuzzing::spoil(votes, kRow, bytes);

  const double* v = votes.data();
  std::vector<LineVote<double>> segments;
  for (std::size_t i = normals; i < normals + lines; ++i) {
    const double* r = v + i * kRow;
    segments.push_back({{r[0], r[1], r[2]}, r[3], {r[4], r[5], r[6]}});
  }
  ManhattanPrior<double> prior;
  const double* p = v + (normals + lines) * kRow;
  if (p[kRow] < 0) {  // else the prior stays sound
    prior.cam_from_manhattan = SO3<double>::from_quaternion(p[0], p[1], p[2], p[4]);
    prior.covariance *= p[5] + 1;
  }
  const NormalView<double> view{v, v + 1, v + 2, p[kRow + 1] < 0 ? v + 3 : nullptr, normals, kRow};
  std::vector<std::int8_t> axis_of(lines);
  const auto estimate = track_manhattan<double>(view, segments, prior, {}, axis_of);
  fuzzing::demand(estimate.cam_from_manhattan.matrix().allFinite());
  if (usable(estimate.status))
    fuzzing::demand(estimate.covariance.allFinite() && std::isfinite(estimate.deviation));
  for (const std::int8_t axis : axis_of) fuzzing::demand(axis >= -1 && axis <= 2);
  return 0;
}
