// SPDX-License-Identifier: BSD-3-Clause
// A camera's pose from points and lines: whatever they are, a usable answer is finite, and any other leaves
// the pose alone.
#include <cmath>
#include <vector>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/solver/pose/pose_refinement.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const std::size_t points = bytes.take<std::uint8_t>() % 24, lines = bytes.take<std::uint8_t>() % 8;
  const auto shape = bytes.take<std::uint8_t>();
  const Pinhole<double> pinhole{500, 500, 320, 240};
  constexpr std::size_t kRow = 11;
  std::vector<double> numbers;
  const auto place = [&] {
    return Vec3<double>(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(2.0, 6.0));
  };
  for (std::size_t i = 0; i <= points + lines; ++i) {
    const Vec3<double> a = place(), b = place();
    const Vec2<double> from = pinhole.project(a), to = pinhole.project(b);
    for (const double number :
         {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), from.x(), from.y(), to.x(), to.y(), 1.0})
      numbers.push_back(number);
  }
  fuzzing::spoil(numbers, kRow, bytes);

  std::vector<PointObservation<double>> seen_points;
  std::vector<LineObservation<double>> seen_lines;
  for (std::size_t i = 0; i < points + lines; ++i) {
    const double* r = numbers.data() + i * kRow;
    const Vec3<double> a(r[0], r[1], r[2]), b(r[3], r[4], r[5]);
    if (i < points)
      seen_points.push_back({a, {r[6], r[7]}, r[10]});
    else if ((shape & 4) != 0)
      seen_lines.push_back({{a, b}, {{r[6], r[7]}, {r[8], r[9]}}, r[10]});
    else
      seen_lines.push_back({Line3<double>::from_points(a, b), {{r[6], r[7]}, {r[8], r[9]}}, r[10]});
  }
  const double* last = numbers.data() + (points + lines) * kRow;
  SE3<double> start{SO3<double>::exp({0.01, -0.02, 0.01}), {0.02, 0.01, -0.03}};
  if ((shape & 1) != 0) start.translation += Vec3<double>(last[0], last[1], last[2]) / 100;
  RotationPrior<double> prior{SO3<double>(), Mat3<double>::Identity() * last[10]};
  if ((shape & 2) != 0)
    prior.cam_from_world = SO3<double>::from_quaternion(last[3], last[4], last[5], last[6]);
  std::vector<std::uint8_t> point_inliers(points), line_inliers(lines);

  const auto same = [](const SE3<double>& a, const SE3<double>& b) {  // NaN is the same as NaN
    return std::memcmp(a.translation.data(), b.translation.data(), 3 * sizeof(double)) == 0 &&
           std::memcmp(&a.rotation.quaternion(), &b.rotation.quaternion(), 4 * sizeof(double)) == 0;
  };
  const auto check = [&](const auto& summary, const SE3<double>& pose) {
    if (usable(summary.status)) {
      fuzzing::demand(pose.translation.allFinite() && pose.rotation.matrix().allFinite());
      fuzzing::demand(summary.information.allFinite() && std::isfinite(summary.cost));
    } else {
      fuzzing::demand(same(pose, start));
    }
  };
  SE3<double> pose = start;
  check(refine_pose<double>(pinhole, seen_points, seen_lines, pose, {}, point_inliers, line_inliers,
                            (shape & 8) != 0 ? &prior : nullptr),
        pose);
  pose = start;
  check(refine_translation<double>(pinhole, seen_points, seen_lines, pose, {}, point_inliers, line_inliers),
        pose);
  return 0;
}
