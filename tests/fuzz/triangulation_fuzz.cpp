// SPDX-License-Identifier: BSD-3-Clause
// Points and lines from views with known poses: whatever they are, a usable answer is finite.
#include <cmath>
#include <vector>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/solver/triangulation/triangulate_line.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sslam;
  fuzzing::Bytes bytes(data, size);
  Random random(bytes.take<std::uint8_t>());
  const std::size_t count = bytes.take<std::uint8_t>() % 6;
  constexpr std::size_t kRow = 12;
  std::vector<double> numbers;
  const Vec3<double> a(0.5, random.uniform(-1.0, 1.0), 4), b(-0.5, random.uniform(-1.0, 1.0), 5);
  for (std::size_t i = 0; i <= count; ++i) {
    const Vec3<double> phi(0.05 * random.uniform(-1.0, 1.0), 0.05 * random.uniform(-1.0, 1.0), 0);
    const Vec3<double> t(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-0.3, 0.3));
    const SO3<double> R = SO3<double>::exp(phi);
    const auto q = R.quaternion();
    const Vec2<double> from = (R * a + t).hnormalized(), to = (R * b + t).hnormalized();
    for (const double number :
         {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z(), from.x(), from.y(), to.x(), to.y(), 0.002})
      numbers.push_back(number);
  }
  fuzzing::spoil(numbers, kRow, bytes);

  std::vector<PointView<double>> point_views;
  std::vector<LineView<double>> line_views;
  for (std::size_t i = 0; i < count; ++i) {
    const double* r = numbers.data() + i * kRow;
    const SE3<double> pose{SO3<double>::from_quaternion(r[0], r[1], r[2], r[3]), {r[4], r[5], r[6]}};
    point_views.push_back({pose, {r[7], r[8]}, r[11]});
    line_views.push_back({pose, {{r[7], r[8]}, {r[9], r[10]}}, r[11]});
  }
  const auto point = triangulate_point<double>(point_views);
  if (usable(point.status))
    fuzzing::demand(point.point.allFinite() && point.covariance.allFinite() &&
                    std::isfinite(point.parallax) && std::isfinite(point.max_error));
  const auto check = [](const LineTriangulation<double>& line) {
    if (!usable(line.status)) return;
    fuzzing::demand(line.line.moment.allFinite() && line.line.direction.allFinite() &&
                    line.start.allFinite() && line.end.allFinite() && line.covariance.allFinite());
    fuzzing::demand(std::isfinite(line.parallax) && std::isfinite(line.max_error) &&
                    std::isfinite(line.overlap));
  };
  check(triangulate_line<double>(line_views));
  const double* last = numbers.data() + count * kRow;
  check(triangulate_line_along<double>(line_views, {last[4], last[5], last[6]}));
  check(triangulate_line_along<double>(line_views, (b - a).normalized()));
  return 0;
}
