// SPDX-License-Identifier: BSD-3-Clause
#include <type_traits>

#include "mutant_kills.hpp"
#include "sslam/residual/line_on_plane.hpp"
#include "sslam/residual/point_on_plane.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "support/test_scalars.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

struct Tied {
  Plane3<double> plane;
  Vec3<double> start, end;

  explicit Tied(Random& random)
      : plane{uniform_vector<double, 3>(random, -1.0, 1.0).normalized(), random.uniform(-2.0, 2.0)},
        start(uniform_vector<double, 3>(random, -2.0, 2.0)),
        end(uniform_vector<double, 3>(random, -2.0, 2.0)) {}

  [[nodiscard]] Line3<double> line() const { return Line3<double>::from_points(start, end); }
};

struct Numeric {
  Mat<double, 1, 3> point_wrt_point, point_wrt_plane;
  Mat<double, 2, 4> line_wrt_line;
  Mat<double, 2, 3> line_wrt_plane;

  explicit Numeric(const Tied& t) {
    const Line3<double> line = t.line();
    point_wrt_point = numeric_jacobian(
        [&](const Euclidean<double, 3>& x) { return point_on_plane(t.plane, x.value).error; },
        Euclidean<double, 3>{t.start});
    point_wrt_plane =
        numeric_jacobian([&](const Plane3<double>& p) { return point_on_plane(p, t.start).error; }, t.plane);
    line_wrt_line = numeric_jacobian(
        [&](const Line3<double>& l) { return line_on_plane(t.plane, l, t.start, t.end).error; }, line);
    line_wrt_plane = numeric_jacobian(
        [&](const Plane3<double>& p) { return line_on_plane(p, line, t.start, t.end).error; }, t.plane);
  }
};

}  // namespace

TEST_CASE("What lies on a plane has no error, and what lies off it the distance") {
  const Plane3<double> floor{{0, 1, 0}, 1.5};
  CHECK(std::abs(point_on_plane(floor, {3, 1.5, 7}).error[0]) < 1e-15);
  CHECK(point_on_plane(floor, {3, 1.7, 7}).error[0] == Approx(0.2));
  const Vec3<double> a(0, 1.5, 1), b(2, 1.5, 4), c(2, 1.8, 4);
  CHECK(line_on_plane(floor, Line3<double>::from_points(a, b), a, b).error.norm() < 1e-12);
  const Vec2<double> tilted = line_on_plane(floor, Line3<double>::from_points(a, c), a, c).error;
  CHECK((tilted - Vec2<double>(0, 0.3)).norm() < 1e-12);
  CHECK((line_on_plane(floor, Line3<double>::from_points(c, a), a, c).error - tilted).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("Jacobians of the ties to a plane, entry by entry", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double agree = std::is_same_v<S, float> ? 2e-3 : 1e-6;
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Tied t(random);
    const Numeric numeric(t);
    const auto point = point_on_plane<S>(t.plane.cast<S>(), t.start.cast<S>());
    const auto line =
        line_on_plane<S>(t.plane.cast<S>(), t.line().cast<S>(), t.start.cast<S>(), t.end.cast<S>());
    CHECK(worst_entry(point.wrt_point, numeric.point_wrt_point, 1e-2).error < agree);
    CHECK(worst_entry(point.wrt_plane, numeric.point_wrt_plane, 1e-2).error < agree);
    CHECK(worst_entry(line.wrt_line, numeric.line_wrt_line, 1e-2).error < agree);
    CHECK(worst_entry(line.wrt_plane, numeric.line_wrt_plane, 1e-2).error < agree);
  }
}

TEST_CASE("The comparison kills wrong Jacobians of the ties to a plane") {
  Random random(2);
  MutantKills kill;
  for (int i = 0; i < 20; ++i) {
    const Tied t(random);
    const Numeric n(t);
    const auto point = point_on_plane(t.plane, t.start);
    const auto line = line_on_plane(t.plane, t.line(), t.start, t.end);
    for_each_mutant<double, 1, 3>(point.wrt_point,
                                  [&](const char* name, const auto& m) { kill(name, m, n.point_wrt_point); });
    for_each_mutant<double, 1, 3>(point.wrt_plane,
                                  [&](const char* name, const auto& m) { kill(name, m, n.point_wrt_plane); });
    for_each_mutant<double, 2, 4>(line.wrt_line,
                                  [&](const char* name, const auto& m) { kill(name, m, n.line_wrt_line); });
    for_each_mutant<double, 2, 3>(line.wrt_plane,
                                  [&](const char* name, const auto& m) { kill(name, m, n.line_wrt_plane); });
    // The line turned about the foot of the origin instead of the places that have been seen.
    const Vec3<double> foot = t.line().closest_point_to_origin();
    kill("places at the foot", line_on_plane(t.plane, t.line(), foot, foot).wrt_line, n.line_wrt_line);
  }
  CHECK(kill.count() > 500);
}
