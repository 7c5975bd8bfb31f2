// SPDX-License-Identifier: BSD-3-Clause
// The search for a first Manhattan frame: whatever votes there are, a usable answer is finite, and any answer
// a rotation.
#include <cmath>
#include <vector>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/manhattan/search.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const std::size_t normals = bytes.take<std::uint8_t>() % 60, lines = bytes.take<std::uint8_t>() % 20;
  const auto flags = bytes.take<std::uint8_t>();
  constexpr std::size_t kRow = 7;
  std::vector<double> votes;
  for (std::size_t i = 0; i <= normals + lines; ++i) {
    Vec3<double> near = Vec3<double>::Unit(static_cast<int>(random.below(3)));
    for (double& part : near) part += random.uniform(-0.02, 0.02);
    near.normalize();
    const Vec3<double> first =
        i < normals ? near : Vec3<double>(near.cross(Vec3<double>(0.3, 0.5, 0.8)).normalized());
    const Vec3<double> ray = first.cross(near).normalized();
    for (const double number : {first.x(), first.y(), first.z(), 0.01, ray.x(), ray.y(), ray.z()})
      votes.push_back(number);
  }
  fuzzing::spoil(votes, kRow, bytes);

  const double* const v = votes.data();
  std::vector<LineVote<double>> segments;
  for (std::size_t i = normals; i < normals + lines; ++i) {
    const double* const r = v + i * kRow;
    segments.push_back({{r[0], r[1], r[2]}, r[3], {r[4], r[5], r[6]}});
  }
  const NormalView<double> view{v, v + 1, v + 2, (flags & 1) != 0 ? v + 3 : nullptr, normals, kRow};
  SearchOptions<double> options;
  options.pairs = 40;
  std::vector<std::int8_t> axis_of(lines);
  const auto estimate = find_manhattan<double>(view, segments, options, flags, axis_of);
  fuzzing::demand(estimate.cam_from_manhattan.matrix().allFinite());
  if (usable(estimate.status))
    fuzzing::demand(estimate.covariance.allFinite() && std::isfinite(estimate.log_likelihood));
  for (const std::int8_t axis : axis_of) fuzzing::demand(axis >= -1 && axis <= 2);
  return 0;
}
