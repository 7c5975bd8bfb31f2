// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/least_squares/levenberg_marquardt.hpp"

#include <array>
#include <limits>

#include "sslam/geometry/so3.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;

namespace {

template <class S>
using Flat2 = Euclidean<S, 2>;

// Rosenbrock's valley as two residuals, 10 (y - x^2) and 1 - x: the minimum is at (1, 1).
template <class S>
S rosenbrock(const Flat2<S>& at, NormalEquations<S, 2>& equations) {
  const S x = at.value.x(), y = at.value.y();
  const S r0 = 10 * (y - x * x), r1 = 1 - x;
  equations.add({-20 * x, 10}, r0, 1);
  equations.add({-1, 0}, r1, 1);
  return r0 * r0 + r1 * r1;
}

// (x - 3)^2 as one row; beyond x = limit it answers as `beyond` says.
template <class S, class Beyond>
auto parabola(S limit, Beyond beyond) {
  return [=](const Euclidean<S, 1>& at, NormalEquations<S, 1>& equations) {
    const S r = at.value[0] - 3;
    equations.add(Mat<S, 1, 1>(S(1)), r, 1);
    Evaluated<S> answer{r * r, 1};
    if (at.value[0] > limit) beyond(answer, equations);
    return answer;
  };
}

}  // namespace

TEMPLATE_TEST_CASE("a curved valley is followed to its end", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Flat2<S> x{{S(-1.2), 1}};
  LmOptions options;
  options.max_iterations = 100;
  const auto summary =
      minimize([](const auto& at, auto& equations) { return rosenbrock<S>(at, equations); }, x, options);
  CHECK(summary.status == Status::kOk);
  CHECK((x.value - Vec2<S>(1, 1)).norm() < S(1e-3));
  CHECK(summary.initial_cost > S(20));
  CHECK(summary.final_cost < S(1e-6));
  CHECK(summary.count == 2);
  CHECK(is_observable(summary.information));
}

TEMPLATE_TEST_CASE("a linear problem takes no more than three steps", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto line_fit = [](const Flat2<S>& at, NormalEquations<S, 2>& equations) {
    S cost = 0;
    for (int i = 0; i < 10; ++i) {
      const S t = static_cast<S>(i);
      const S r = at.value.x() + at.value.y() * t - (2 + S(0.5) * t + (i % 2 == 0 ? S(0.1) : S(-0.1)));
      equations.add({1, t}, r, 1);
      cost += r * r;
    }
    return cost;
  };
  Flat2<S> x;
  const auto summary = minimize(line_fit, x);
  CHECK(summary.status == Status::kOk);
  CHECK(summary.iterations <= 3);
  // The least-squares line through values that alternate by 0.1 about 2 + t / 2.
  CHECK(std::abs(x.value.x() - S(2.0272727)) < S(1e-4));
  CHECK(std::abs(x.value.y() - S(0.4939394)) < S(1e-4));
  // J^T J of ten rows (1, t).
  CHECK(summary.information(0, 0) == S(10));
  CHECK(summary.information(0, 1) == S(45));
  CHECK(summary.information(1, 0) == S(45));
  CHECK(summary.information(1, 1) == S(285));
}

TEMPLATE_TEST_CASE("a rotation is found on its manifold", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto truth = SO3<S>::exp({S(1.2), S(-0.7), S(0.4)});
  const auto align = [&](const SO3<S>& r, NormalEquations<S, 3>& equations) {
    S cost = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3<S> a = r * Vec3<S>(Vec3<S>::Unit(i)), e = a - truth * Vec3<S>(Vec3<S>::Unit(i));
      const Mat3<S> j = -hat(a);
      for (int k = 0; k < 3; ++k) equations.add(j.row(k), e[k], 1);
      cost += e.squaredNorm();
    }
    return cost;
  };
  SO3<S> r;
  CHECK(minimize(align, r).status == Status::kOk);
  CHECK(angle_between(r, truth) < S(1e-3));
}

TEMPLATE_TEST_CASE("a step that changes what counts is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Euclidean<S, 1> x{Vec<S, 1>(S(0))};
  const auto drops = parabola<S>(S(2), [](auto& answer, auto&) { answer = {S(0), 0}; });
  LmOptions options;
  options.max_iterations = 200;
  const auto summary = minimize(drops, x, options);
  CHECK(x.value[0] <= S(2));
  CHECK(x.value[0] > S(1));
  CHECK(summary.count == 1);
  CHECK(summary.status == Status::kNotConverged);
  CHECK(summary.final_cost < summary.initial_cost);
}

TEMPLATE_TEST_CASE("a step into what is not finite is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S nan = std::numeric_limits<S>::quiet_NaN();
  LmOptions options;
  options.max_iterations = 200;
  const auto bad_cost = parabola<S>(S(2), [=](auto& answer, auto&) { answer.cost = nan; });
  const auto bad_slope = parabola<S>(S(2), [=](auto&, auto& equations) { equations.g[0] = nan; });
  const auto bad_curve = parabola<S>(S(2), [=](auto&, auto& equations) { equations.H(0, 0) = nan; });
  for (int kind = 0; kind < 3; ++kind) {
    Euclidean<S, 1> x;
    const auto summary = kind == 0   ? minimize(bad_cost, x, options)
                         : kind == 1 ? minimize(bad_slope, x, options)
                                     : minimize(bad_curve, x, options);
    CAPTURE(kind);
    CHECK(x.value[0] > S(1));
    CHECK(x.value[0] <= S(2));
    CHECK(summary.status == Status::kNotConverged);
    CHECK(summary.information.allFinite());
  }
}

TEMPLATE_TEST_CASE("a start that is not finite is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto always =
      parabola<S>(S(-100), [](auto& answer, auto&) { answer.cost = std::numeric_limits<S>::infinity(); });
  Euclidean<S, 1> x{Vec<S, 1>(S(0.5))};
  CHECK(minimize(always, x).status == Status::kNotFinite);
  CHECK(x.value[0] == S(0.5));
}

TEMPLATE_TEST_CASE("a matrix that cannot be factored leaves the state", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto concave = [](const Euclidean<S, 1>& at, NormalEquations<S, 1>& equations) {
    equations.add(Mat<S, 1, 1>(S(1)), at.value[0], S(-1));
    return S(1);
  };
  Euclidean<S, 1> x{Vec<S, 1>(S(0.5))};
  LmOptions options;
  options.max_iterations = 50;
  const auto summary = minimize(concave, x, options);
  CHECK(summary.status == Status::kDegenerate);
  CHECK(x.value[0] == S(0.5));
}

TEMPLATE_TEST_CASE("nothing to minimise", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Euclidean<S, 1> x;
  const auto nothing = [](const Euclidean<S, 1>&, NormalEquations<S, 1>&) { return S(0); };
  CHECK(minimize(nothing, x).status == Status::kTooFew);
  LmOptions none;
  none.max_iterations = 0;
  const auto plain = parabola<S>(S(100), [](auto&, auto&) {});
  CHECK(minimize(plain, x, none).status == Status::kNotConverged);
  CHECK(x.value[0] == 0);
}

TEMPLATE_TEST_CASE("an ascent is never taken", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  // The derivative points the wrong way, so that every step climbs.
  const auto wrong_way = [](const Euclidean<S, 1>& at, NormalEquations<S, 1>& equations) {
    const S r = at.value[0] - 3;
    equations.add(Mat<S, 1, 1>(S(-1)), r, 1);
    return r * r;
  };
  Euclidean<S, 1> x{Vec<S, 1>(S(1))};
  LmOptions options;
  options.max_iterations = 50;
  const auto summary = minimize(wrong_way, x, options);
  CHECK(x.value[0] == S(1));
  CHECK(summary.final_cost == summary.initial_cost);
}

TEMPLATE_TEST_CASE("a direction without information is told", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto one_way = [](const Flat2<S>& at, NormalEquations<S, 2>& equations) {
    const S r = at.value.x() + 2 * at.value.y() - 1;
    equations.add({1, 2}, r, 1);
    return r * r;
  };
  Flat2<S> x;
  const auto summary = minimize(one_way, x);
  CHECK(summary.status == Status::kOk);
  CHECK(std::abs(x.value.x() + 2 * x.value.y() - 1) < S(1e-3));
  CHECK_FALSE(is_observable(summary.information));
  // Units of the rows do not matter, being determined or not does.
  Mat2<S> H;
  H << S(1e5), 0, 0, S(1e-4);
  CHECK(is_observable(H));
  H(1, 1) = S(1e-25);
  CHECK_FALSE(is_observable(H));
  H(1, 1) = 1;
  CHECK_FALSE(is_observable<S, 2>(Mat2<S>::Ones()));
  CHECK_FALSE(is_observable<S, 2>(Mat2<S>::Zero()));
  H(0, 1) = H(1, 0) = std::numeric_limits<S>::quiet_NaN();
  CHECK_FALSE(is_observable(H));
}

TEST_CASE("normal equations sum weighted rows") {
  NormalEquations<double, 2> equations;
  equations.add({1, 2}, 3, 0.5);
  equations.add({-1, 1}, 2, 2);
  equations.complete();
  CHECK(equations.count == 2);
  CHECK(equations.H(0, 0) == 2.5);
  CHECK(equations.H(0, 1) == -1);
  CHECK(equations.H(1, 0) == -1);
  CHECK(equations.H(1, 1) == 4);
  CHECK(equations.g[0] == -2.5);
  CHECK(equations.g[1] == 7);
}
