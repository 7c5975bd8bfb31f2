// SPDX-License-Identifier: BSD-3-Clause
// Relative pose from matches: whatever they are, a usable answer is finite, and any other leaves the pose
// alone.
#include <cmath>
#include <vector>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const auto shape = bytes.take<std::uint8_t>();
  const std::size_t count = shape % 64;
  constexpr std::size_t kRow = 7;
  const Vec3<double> moved(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
  const Mat3<double> turned =
      SO3<double>::exp({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)})
          .matrix();
  std::vector<double> numbers;
  for (std::size_t i = 0; i <= count; ++i) {
    const double depth = shape < 128 ? random.uniform(1.0, 5.0) : 3.0;
    const Vec3<double> x = depth * Vec3<double>(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1);
    const Vec3<double> y = turned * x + moved;
    for (const double number : {x.x() / x.z(), x.y() / x.z(), 1.0, y.x() / y.z(), y.y() / y.z(), 1.0, 0.002})
      numbers.push_back(number);
  }
  fuzzing::spoil(numbers, kRow, bytes);
  std::vector<BearingMatch<double>> matches;
  for (std::size_t i = 0; i < count; ++i) {
    const double* r = numbers.data() + i * kRow;
    matches.push_back({{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, r[6]});
  }

  FindRelativePoseOptions<double> options;
  options.max_samples = 20;
  std::vector<std::uint8_t> inliers(count);
  SO3<double> R;
  Vec3<double> t(1, 2, 3);
  const auto check = [&](const RelativePoseSummary<double>& summary) {
    if (usable(summary.status)) {
      fuzzing::demand(R.matrix().allFinite() && std::abs(t.norm() - 1) < 1e-6);
      fuzzing::demand(summary.rotation_covariance.allFinite() && summary.translation_covariance.allFinite());
      fuzzing::demand(std::isfinite(summary.parallax) && std::isfinite(summary.mean_squared_error));
    } else {
      fuzzing::demand(t == Vec3<double>(1, 2, 3));
    }
  };
  check(find_relative_pose<double>(matches, options, 1, R, t, inliers));
  const double* start = numbers.data() + count * kRow;
  R = SO3<double>::from_quaternion(1, start[0], start[1], start[3]);
  t = {1, 2, 3};
  check(refine_relative_pose<double>(matches, R, t, options.refinement, inliers));
  return 0;
}
