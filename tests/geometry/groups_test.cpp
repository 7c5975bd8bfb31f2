// SPDX-License-Identifier: BSD-3-Clause
// One set of properties for every group, at rotations of no, tiny, ordinary and nearly half a turn.
#include <limits>
#include <numbers>
#include <vector>

#include "sslam/geometry/sim3.hpp"
#include "sslam/testing/group_laws.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

template <class S>
std::vector<S> angles() {
  const double pi = std::numbers::pi;
  return {S(0), S(1e-9), S(1e-5), S(3e-4), S(0.01), S(0.05), S(1), S(2.5), S(pi - 1e-2), S(pi - 1e-4)};
}

template <class S>
S rounding(double factor) {
  return static_cast<S>(factor) * std::numeric_limits<S>::epsilon();
}

}  // namespace

TEMPLATE_TEST_CASE("transform groups keep their laws", "", SSLAM_TEST_TYPES(SO3, SE3, Sim3)) {
  using S = ScalarOf<TestType>;
  Random random(1);
  for (const S angle : angles<S>()) {
    for (int i = 0; i < 20; ++i) {
      const auto a = TestType::exp(tangent_of_angle<TestType>(angle, random));
      const auto b = TestType::exp(tangent_of_angle<TestType>(S(1.3), random));
      const auto c = TestType::exp(tangent_of_angle<TestType>(angle, random));
      const auto laws =
          group_laws(a, b, c, tangent_of_angle<TestType>(angle, random), Vec3<S>(S(0.3), -1, 2));
      CAPTURE(angle, i);
      CHECK(laws.identity <= rounding<S>(50));
      CHECK(laws.inverse <= rounding<S>(100));
      CHECK(laws.associativity <= rounding<S>(400));
      CHECK(laws.action <= rounding<S>(400));
      CHECK(laws.exp_of_log <= rounding<S>(100));
      CHECK(laws.left_retraction <= rounding<S>(50));
    }
  }
}

TEMPLATE_TEST_CASE("logarithm undoes exponential", "", SSLAM_TEST_TYPES(SO3, SE3, Sim3)) {
  using S = ScalarOf<TestType>;
  Random random(2);
  for (const S angle : angles<S>()) {
    for (int i = 0; i < 20; ++i) {
      const auto xi = tangent_of_angle<TestType>(angle, random);
      const auto back = TestType::exp(xi).log();
      CAPTURE(angle, xi.transpose(), back.transpose());
      CHECK((back - xi).cwiseAbs().maxCoeff() <= rounding<S>(60));
      CHECK((back - xi).template head<3>().norm() <= rounding<S>(8) * std::max(angle, S(1e-3)));
    }
  }
}

TEMPLATE_TEST_CASE("exponential is the flow of its own derivative", "", SO3<double>, SE3<double>,
                   Sim3<double>) {
  // Exp((s + t) xi) = Exp(s xi) Exp(t xi), and d/ds Exp(s xi) x at 0 is the generator: phi x x + rho + sigma
  // x.
  Random random(3);
  for (const double angle : angles<double>()) {
    const auto xi = tangent_of_angle<TestType>(angle, random);
    using Xi = typename TestType::Tangent;
    CHECK(group_distance(TestType::exp(xi), TestType::exp(Xi(0.3 * xi)) * TestType::exp(Xi(0.7 * xi))) <
          1e-14);
    const Vec3<double> x(0.4, -0.2, 1.5);
    const auto slope = numeric_jacobian(
        [&](const Euclidean<double, 1>& s) -> Vec3<double> { return TestType::exp(Xi(s.value[0] * xi)) * x; },
        Euclidean<double, 1>{});
    Vec3<double> generator = xi.template head<3>().cross(x);
    if constexpr (TestType::kDof >= 6) generator += xi.template segment<3>(3);
    if constexpr (TestType::kDof == 7) generator += xi[6] * x;
    CHECK((slope - generator).norm() < 1e-10);
  }
}

TEMPLATE_TEST_CASE("half a turn has a logarithm of length pi", "", SSLAM_TEST_SCALARS) {
  const auto half = SO3<TestType>::from_quaternion(0, 0, 1, 0);
  CHECK(std::abs(half.log().norm() - std::numbers::pi_v<TestType>) <= rounding<TestType>(8));
  CHECK(std::abs(angle_between(half, SO3<TestType>()) - std::numbers::pi_v<TestType>) <=
        rounding<TestType>(8));
  // A quaternion and its negative are one rotation, with one logarithm.
  const auto a = SO3<TestType>::exp({TestType(0.2), TestType(-0.4), TestType(1.1)});
  const auto& q = a.quaternion();
  const auto b = SO3<TestType>::from_quaternion(-q.w(), -q.x(), -q.y(), -q.z());
  CHECK((a.log() - b.log()).norm() < TestType(1e-6));
}

TEMPLATE_TEST_CASE("matrix of a rotation", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(4);
  for (const S angle : angles<S>()) {
    const auto a = SO3<S>::exp(tangent_of_angle<SO3<S>>(angle, random));
    const Mat3<S> m = a.matrix();
    CHECK((m.transpose() * m - Mat3<S>::Identity()).cwiseAbs().maxCoeff() <= rounding<S>(8));
    CHECK(std::abs(m.determinant() - 1) <= rounding<S>(8));
    CHECK(group_distance(SO3<S>::from_matrix(m), a) <= rounding<S>(8));
    CHECK((m * Vec3<S>(1, 2, 3) - a * Vec3<S>(1, 2, 3)).norm() <= rounding<S>(20));
  }
}

TEST_CASE("a quarter turn about z takes x to y") {
  const auto quarter = SO3<double>::exp({0, 0, std::numbers::pi / 2});
  CHECK((quarter * Vec3<double>::UnitX() - Vec3<double>::UnitY()).norm() < 1e-15);
  CHECK((hat(Vec3<double>(1, 2, 3)) * Vec3<double>(4, 5, 6) -
         Vec3<double>(1, 2, 3).cross(Vec3<double>(4, 5, 6)))
            .norm() == 0);
}

TEST_CASE("left Jacobian of a rotation") {
  Random random(5);
  for (const double angle : angles<double>()) {
    const auto phi = tangent_of_angle<SO3<double>>(angle, random);
    const auto at = SO3<double>::exp(phi).inverse();
    const auto numeric = numeric_jacobian(
        [&](const Euclidean<double, 3>& p) -> Vec3<double> { return (SO3<double>::exp(p.value) * at).log(); },
        Euclidean<double, 3>{phi});
    CAPTURE(angle);
    CHECK(worst_entry(left_jacobian(phi), numeric).error < 1e-8);
    CHECK((left_jacobian(phi) * left_jacobian_inverse(phi) - Mat3<double>::Identity()).norm() < 1e-13);
    // The transposed Jacobian is the right one.
    if (angle > 0.01) CHECK(worst_entry(left_jacobian(phi).transpose(), numeric).error > 1e-4);
  }
}

TEST_CASE("adjoint carries a tangent across") {
  Random random(6);
  for (const double angle : angles<double>()) {
    const auto T = SE3<double>::exp(tangent_of_angle<SE3<double>>(angle, random));
    const auto xi = tangent_of_angle<SE3<double>>(0.7, random);
    CHECK(group_distance(T * SE3<double>::exp(xi), SE3<double>::exp(T.adjoint() * xi) * T) < 1e-14);
    CHECK((SE3<double>::exp(T.adjoint() * xi).log() - T.adjoint() * xi).norm() < 1e-12);
  }
}

TEST_CASE("left perturbation moves a camera point by phi x X + rho") {
  Random random(7);
  const auto T = SE3<double>::exp(tangent_of_angle<SE3<double>>(1.0, random));
  const Vec3<double> x(0.3, 0.8, -0.5);
  const Vec3<double> in_camera = T * x;
  Mat<double, 3, 6> analytic;
  analytic << -hat(in_camera), Mat3<double>::Identity();
  const auto numeric = numeric_jacobian([&](const SE3<double>& pose) -> Vec3<double> { return pose * x; }, T);
  CHECK(worst_entry(analytic, numeric).error < 1e-9);
  // Perturbed on the right, or in the wrong frame, it is another matrix.
  Mat<double, 3, 6> right;
  right << -(T.rotation.matrix() * hat(x)), T.rotation.matrix();
  CHECK(worst_entry(right, numeric).error > 1e-2);
}

TEMPLATE_TEST_CASE("casts keep the transform", "", SSLAM_TEST_SCALARS) {
  Random random(8);
  const auto T = SE3<double>::exp(tangent_of_angle<SE3<double>>(2.0, random));
  const auto cast = T.cast<TestType>();
  CHECK((cast.template cast<double>() * Vec3<double>(1, 2, 3) - T * Vec3<double>(1, 2, 3)).norm() < 1e-5);
}

TEST_CASE("a similarity scales, then moves") {
  const Sim3<double> s{SO3<double>::exp({0, 0, std::numbers::pi / 2}), {1, 2, 3}, 2};
  CHECK((s * Vec3<double>(1, 0, 0) - Vec3<double>(1, 4, 3)).norm() < 1e-14);
  // Its exponential stays exact at scales far from 1.
  Vec<double, 7> xi;
  xi << 2.0, -1.0, 0.5, 0.3, -0.2, 0.9, std::log(100.0);
  for (const double sign : {1.0, -1.0}) {
    const Vec<double, 7> signed_xi = sign * xi;
    CHECK((Sim3<double>::exp(signed_xi).log() - signed_xi).norm() < 1e-12);
    CHECK(group_distance(Sim3<double>::exp(signed_xi), Sim3<double>::exp(-signed_xi).inverse()) <
          1e-12 * std::exp(xi[6]));
  }
}

TEMPLATE_TEST_CASE("a similarity's adjoint takes tangents from its right to its left", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const auto a = Sim3<S>::exp(tangent_of_angle<Sim3<S>>(S(1.3), random));
    const auto xi = tangent_of_angle<Sim3<S>>(S(0.4), random);
    CHECK(group_distance(a * Sim3<S>::exp(xi), Sim3<S>::exp(a.adjoint() * xi) * a) < rounding<S>(200));
  }
}

TEST_CASE("a similarity's logarithm follows small motions from the left") {
  Random random(5);
  for (const double angle : {0.0, 1e-3, 0.1, 1.0}) {
    const auto xi = tangent_of_angle<Sim3<double>>(angle, random);
    const auto numeric =
        numeric_jacobian([&](const Sim3<double>& x) { return x.log(); }, Sim3<double>::exp(xi));
    CAPTURE(angle);
    CHECK((Sim3<double>::left_jacobian_inverse(xi) - numeric).cwiseAbs().maxCoeff() < 2e-5);
  }
}
