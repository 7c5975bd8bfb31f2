// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/bundle/bundle_ties.hpp"

#include <cmath>
#include <limits>

#include "sslam/core/random.hpp"
#include "sslam/solver/least_squares/block_kernels.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

namespace {

using namespace sslam;

template <int N>
Vec<double, N> uniform(Random& random, double reach) {
  Vec<double, N> out;
  for (int i = 0; i < N; ++i) out[i] = random.uniform(-reach, reach);
  return out;
}

// Entry by entry, relative to the entry, or to a hundredth of the largest one where the entry is small.
template <class Derivative>
void require_same(const Derivative& analytic, const Derivative& numeric) {
  const double floor = 1e-2 * numeric.cwiseAbs().maxCoeff() + 1e-9;
  for (int r = 0; r < numeric.rows(); ++r)
    for (int c = 0; c < numeric.cols(); ++c) {
      INFO("row " << r << " column " << c << ": " << analytic(r, c) << " and " << numeric(r, c));
      REQUIRE(std::abs(analytic(r, c) - numeric(r, c)) <= 1e-5 * std::max(std::abs(numeric(r, c)), floor));
    }
}

// Central differences of f along the state's own retraction.
template <int Rows, class State, class F>
Mat<double, Rows, State::kDof> differences(const State& state, F f) {
  constexpr double kStep = 1e-6;
  Mat<double, Rows, State::kDof> out;
  for (int c = 0; c < State::kDof; ++c) {
    const Vec<double, State::kDof> step = kStep * Vec<double, State::kDof>::Unit(c);
    out.col(c) = (f(state.retract(step)) - f(state.retract(-step))) / (2 * kStep);
  }
  return out;
}

}  // namespace

TEST_CASE("Derivatives of the ties are those of their residuals") {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const SE3<double> pose = SE3<double>::exp(uniform<6>(random, 0.8));
    Mat3<double> root;
    root << 50, 0, 0, 5, 40, 0, -3, 8, 30;
    const RotationTie<double> tie{SO3<double>::exp(uniform<3>(random, 0.8)), root};
    Mat3<double> by_rotation;
    (void)rotation_tie_residual(tie, pose.rotation, &by_rotation);
    require_same(by_rotation, differences<3>(pose.rotation, [&](const SO3<double>& R) {
                   return rotation_tie_residual<double>(tie, R);
                 }));

    const auto line = Line3<double>::from_points(uniform<3>(random, 2), uniform<3>(random, 2));
    const Vec3<double> axis = uniform<3>(random, 1).normalized();
    Mat<double, 2, 4> by_line;
    (void)axis_tie_residual(axis, line, &by_line);
    require_same(by_line,
                 differences<2>(line, [&](const Line3<double>& l) { return axis_tie_residual(axis, l); }));

    const Plane3<double> plane{uniform<3>(random, 1).normalized(), 0.7};
    Mat<double, 2, 3> by_plane;
    (void)axis_tie_residual(axis, plane, &by_plane);
    require_same(by_plane,
                 differences<2>(plane, [&](const Plane3<double>& p) { return axis_tie_residual(axis, p); }));

    const Vec3<double> held = uniform<3>(random, 2);
    Mat<double, 1, 6> by_pose;
    (void)scale_tie_residual(held, 1.5, pose, &by_pose);
    require_same(by_pose, differences<1>(pose, [&](const SE3<double>& p) {
                   return Vec<double, 1>(scale_tie_residual(held, 1.5, p));
                 }));
  }
}

TEST_CASE("Ties are at rest where they should be") {
  const SO3<double> R = SO3<double>::exp({0.3, -0.2, 0.5});
  REQUIRE(rotation_tie_residual<double>({R, Mat3<double>::Identity()}, R).norm() < 1e-12);
  const auto line = Line3<double>::from_points({0, 1, 2}, {0, 1, 5});
  REQUIRE(axis_tie_residual<double>({0, 0, 1}, line).norm() < 1e-15);
  REQUIRE(axis_tie_residual<double>({0, 0, -1}, line).norm() <
          1e-15);  // which way a line points does not matter
  REQUIRE(std::abs(scale_tie_residual<double>({1, 0, 0}, 2, {SO3<double>(), {1, 0, 0}})) < 1e-15);
}

TEMPLATE_TEST_CASE("The block kernels do what the matrix products do", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(13);
  const auto fill = [&](auto& m) {
    for (int c = 0; c < m.cols(); ++c)
      for (int r = 0; r < m.rows(); ++r) m(r, c) = random.uniform<S>(-1, 1);
  };
  constexpr S kEps = 50 * std::numeric_limits<S>::epsilon();
  Mat<S, 2, 6> a;
  Mat<S, 2, 4> b;
  Vec2<S> e;
  fill(a);
  fill(b);
  fill(e);
  Mat<S, 6, 4> W = Mat<S, 6, 4>::Ones();
  add_product<S, 2, 6, 4>(a, b, S(2), W);
  const Mat<S, 6, 4> product = a.transpose() * b;
  REQUIRE((W - Mat<S, 6, 4>::Ones() - product * S(2)).norm() < kEps);
  Mat6<S> H = Mat6<S>::Zero();
  add_square<S, 2, 6>(a, S(3), H);
  const Mat6<S> expected = a.transpose() * a;
  for (int c = 0; c < 6; ++c)
    for (int r = c; r < 6; ++r) REQUIRE(std::abs(H(r, c) - 3 * expected(r, c)) < kEps);
  Vec6<S> g = Vec6<S>::Zero();
  add_product<S, 2, 6>(a, e, S(2), g);
  const Vec6<S> projected = a.transpose() * e;
  REQUIRE((g - projected * S(2)).norm() < kEps);

  Mat<S, 4, 4> square, root = Mat<S, 4, 4>::Constant(7);
  fill(square);
  const Mat<S, 4, 4> definite = square * square.transpose() + Mat<S, 4, 4>::Identity();
  REQUIRE(inverse_root<S, 4>(definite, root));
  REQUIRE((root * definite * root.transpose() - Mat<S, 4, 4>::Identity()).norm() < kEps);
  const Mat<S, 4, 4> before = root;
  REQUIRE_FALSE(inverse_root<S, 4>(-definite, root));
  REQUIRE(root == before);
  REQUIRE((times_transposed_lower<S, 6, 4>(W, root) - W * root.transpose()).norm() < kEps);

  Mat<S, 8, 8> big = Mat<S, 8, 8>::Zero();
  subtract_outer<S, 6, 6, 4>(W, W, &big(2, 1), 8);
  REQUIRE((big.template block<6, 6>(2, 1) + W * W.transpose()).norm() < 10 * kEps);
  REQUIRE(big.template topRows<2>().norm() + big.col(0).norm() + big.col(7).norm() == 0);
  const Mat<S, 3, 4> three = W.template topRows<3>();
  big.setZero();
  subtract_outer<S, 3, 6, 4>(three, W, &big(5, 2), 8);
  REQUIRE((big.template block<3, 6>(5, 2) + three * W.transpose()).norm() < 10 * kEps);
  REQUIRE(big.template topRows<5>().norm() + big.template leftCols<2>().norm() == 0);
}
