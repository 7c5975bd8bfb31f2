// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "sslam/core/random.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/geometry/line3.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

template <class S>
Vec3<S> random_point(Random& random) {
  return {random.uniform(S(-2), S(2)), random.uniform(S(-2), S(2)), random.uniform(S(-2), S(2))};
}

template <class S>
bool same_line(const Line3<S>& a, const Line3<S>& b, S tolerance) {
  return (a.moment - b.moment).norm() < tolerance && (a.direction - b.direction).norm() < tolerance;
}

template <class S>
S tolerance() {
  return 100 * std::numeric_limits<S>::epsilon();
}

}  // namespace

TEMPLATE_TEST_CASE("an image line measures pixels", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Vec3<S> l = line_through<S>({0, 10}, {20, 10});
  CHECK(std::abs(l.dot(Vec3<S>(5, 13, 1))) == S(3));
  CHECK(l.template head<2>().norm() == S(1));
  CHECK(line_through<S>({3, 4}, {3, 4}).isZero());
  const Segment2<S> segment{{0, 0}, {3, 4}};
  CHECK(segment.length() == S(5));
  CHECK(segment.midpoint() == Vec2<S>(S(1.5), 2));
  CHECK((segment.direction() - Vec2<S>(S(0.6), S(0.8))).norm() < tolerance<S>());
  CHECK(Segment2<S>{{1, 1}, {1, 1}}.direction().isZero());
}

TEMPLATE_TEST_CASE("the interpretation plane holds the centre and the segment", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<S> k{500, 510, 320, 240};
  const Vec3<S> a(S(0.3), S(-0.2), 2), b(S(-0.4), S(0.5), 3);
  const Vec3<S> n = interpretation_plane<S>({k.project(a), k.project(b)}, k);
  CHECK(std::abs(n.norm() - 1) < tolerance<S>());
  CHECK(std::abs(n.dot(a)) < tolerance<S>());
  CHECK(std::abs(n.dot(b)) < tolerance<S>());
  CHECK(interpretation_plane<S>({k.project(a), k.project(a)}, k).norm() < tolerance<S>());
}

TEMPLATE_TEST_CASE("a line from two points and from two planes", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3<S> p = random_point<S>(random), q = random_point<S>(random), r = random_point<S>(random),
                  s = random_point<S>(random);
    const auto line = Line3<S>::from_points(p, q);
    CHECK((p.cross(line.direction) - line.moment).norm() < tolerance<S>());
    CHECK((q.cross(line.direction) - line.moment).norm() < tolerance<S>());
    CHECK(std::abs(line.moment.dot(line.direction)) < tolerance<S>());
    const Vec3<S> n0 = (q - p).cross(r - p), n1 = (q - p).cross(s - p);
    const auto met = Line3<S>::from_planes(n0, -n0.dot(p), n1, -n1.dot(p));
    const S sign = met.direction.dot(line.direction) < 0 ? S(-1) : S(1);
    const S sine = n0.normalized().cross(n1.normalized()).norm();
    if (sine < S(0.1) || (q - p).norm() < S(0.3)) continue;
    CHECK(same_line<S>({sign * met.moment, sign * met.direction}, line, 50 * tolerance<S>()));
  }
}

TEMPLATE_TEST_CASE("nearest points on a line", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(2);
  const auto line = Line3<S>::from_points({0, 1, 2}, {1, 1, 2});
  CHECK((line.closest_point_to_origin() - Vec3<S>(0, 1, 2)).norm() < tolerance<S>());
  CHECK((line.point_closest_to({7, -3, 5}) - Vec3<S>(7, 1, 2)).norm() < tolerance<S>());
  CHECK((line.closest_to_ray({3, 0, 0}, {0, 0, 1}) - Vec3<S>(3, 1, 2)).norm() < tolerance<S>());
  CHECK((line.closest_to_ray({3, 0, 0}, {1, 0, 0}) - Vec3<S>(3, 1, 2)).norm() < tolerance<S>());
  for (int i = 0; i < 50; ++i) {
    const auto other = Line3<S>::from_points(random_point<S>(random), random_point<S>(random));
    const Vec3<S> origin = random_point<S>(random), ray = random_point<S>(random).normalized();
    if (ray.cross(other.direction).norm() < S(0.2)) continue;
    // The shortest way between two lines stands across both.
    const Vec3<S> on_line = other.closest_to_ray(origin, ray);
    const Vec3<S> on_ray = origin + ray * ray.dot(on_line - origin);
    CHECK(std::abs((on_line - on_ray).dot(other.direction)) < 50 * tolerance<S>());
  }
}

TEMPLATE_TEST_CASE("a line moves with its points", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Vec3<S> p = random_point<S>(random), q = random_point<S>(random);
    if ((q - p).norm() < S(0.3)) continue;
    const SE3<S> T{SO3<S>::exp(random_point<S>(random)), random_point<S>(random)};
    const auto moved = transform(T, Line3<S>::from_points(p, q));
    CHECK(same_line(moved, Line3<S>::from_points(T * p, T * q), 10 * tolerance<S>()));
    CHECK(same_line(transform(T.inverse(), moved), Line3<S>::from_points(p, q), 10 * tolerance<S>()));
    const auto as_double = moved.template cast<double>();
    CHECK((as_double.direction.template cast<S>() - moved.direction).norm() < tolerance<S>());
  }
}

TEMPLATE_TEST_CASE("the image of a line passes through the images of its points", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<S> k{500, 510, 320, 240};
  const Vec3<S> a(S(0.3), S(-0.2), 2), b(S(-0.4), S(0.5), 3);
  const Vec3<S> l = project_line(k, Line3<S>::from_points(a, b));
  CHECK(std::abs(l.dot(k.project(a).homogeneous())) < S(1e3) * tolerance<S>());
  CHECK(std::abs(l.dot(k.project(b).homogeneous())) < S(1e3) * tolerance<S>());
  CHECK(std::abs(l.template head<2>().norm() - 1) < tolerance<S>());
  CHECK(project_line(k, Line3<S>::from_points({0, 0, 1}, {0, 0, 2})).isZero());
}

TEMPLATE_TEST_CASE("the update of a line keeps it a line", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const auto line = Line3<S>::from_points(random_point<S>(random), random_point<S>(random));
    const Vec4<S> delta = S(0.1) * Vec4<S>{random.uniform(S(-1), S(1)), random.uniform(S(-1), S(1)),
                                           random.uniform(S(-1), S(1)), random.uniform(S(-1), S(1))};
    const auto moved = line.retract(delta);
    CHECK(std::abs(moved.direction.norm() - 1) < tolerance<S>());
    CHECK(std::abs(moved.moment.dot(moved.direction)) < tolerance<S>() * (1 + moved.moment.norm()));
    CHECK(same_line(line.retract(Vec4<S>::Zero()), line, tolerance<S>() * (1 + line.moment.squaredNorm())));
  }
  // Through the origin, and out of it again to either side.
  const Line3<S> through{Vec3<S>::Zero(), Vec3<S>::UnitZ()};
  const auto left = through.retract({0, 0, 0, S(0.1)}), right = through.retract({0, 0, 0, S(-0.1)});
  CHECK((left.moment + right.moment).norm() < tolerance<S>());
  CHECK(left.moment.norm() > S(0.09));
}

TEST_CASE("derivative of the line update entry by entry") {
  Random random(5);
  const auto stacked = [](const Line3<double>& l) {
    Vec6<double> v;
    v << l.moment, l.direction;
    return v;
  };
  for (int i = 0; i < 50; ++i) {
    const auto line = Line3<double>::from_points(random_point<double>(random), random_point<double>(random));
    const auto numeric = numeric_jacobian(stacked, line, 1e-4);
    const auto analytic = line.retract_jacobian();
    CHECK(worst_entry(analytic, numeric).error < 1e-6);
    for_each_mutant<double, 6, 4>(analytic, [&](const char* name, const Mat<double, 6, 4>& mutant) {
      CAPTURE(name);
      CHECK(worst_entry(mutant, numeric).error > 1e-4);
    });
    // Turned from the right, and the distance itself taken for its angle.
    Mat<double, 6, 4> mutant = analytic;
    mutant.topLeftCorner<3, 3>() = hat(line.moment);
    CHECK(worst_entry(mutant, numeric).error > 1e-2);
    mutant = analytic;
    mutant.block<3, 1>(0, 3) = line.frame().col(0);
    CHECK(worst_entry(mutant, numeric).error > 1e-2);
  }
}

TEST_CASE("the principal axis of a segment's points is its direction") {
  for (const double angle : {-3.0, -1.2, 0.0, 0.4, 1.5, 2.8}) {
    const Vec2<double> d(std::cos(angle), std::sin(angle)), n(-d.y(), d.x());
    CHECK(cross(d, n) == Approx(1));
    const Mat2<double> scatter = 4 * d * d.transpose() + n * n.transpose();
    CHECK((principal_axis(scatter(0, 0), scatter(0, 1), scatter(1, 1), d) - d).norm() < 1e-12);
    const Vec2<double> back = -d;
    CHECK((principal_axis(scatter(0, 0), scatter(0, 1), scatter(1, 1), back) - back).norm() < 1e-12);
  }
}
