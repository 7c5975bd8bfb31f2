// SPDX-License-Identifier: BSD-3-Clause
// The tools that judge Jacobians, judged themselves.
#include <limits>
#include <string>

#include "sslam/geometry/se3.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("numeric Jacobian of known functions") {
  const auto f = [](const Euclidean<double, 2>& x) -> Vec2<double> {
    return {std::sin(x.value[0]) * x.value[1], std::exp(x.value[1])};
  };
  const auto j = numeric_jacobian(f, Euclidean<double, 2>{{0.3, 0.8}});
  Mat2<double> truth;
  truth << std::cos(0.3) * 0.8, std::sin(0.3), 0, std::exp(0.8);
  CHECK(worst_entry(j, truth).error < 1e-9);
}

TEST_CASE("numeric Jacobian follows the retraction from the left") {
  const SO3<double> r = SO3<double>::exp({0.4, -0.2, 1.0});
  const Vec3<double> x(1, 2, 3);
  const auto j = numeric_jacobian([&](const SO3<double>& s) -> Vec3<double> { return s * x; }, r);
  const Mat3<double> left = -hat(Vec3<double>(r * x));
  CHECK(worst_entry(j, left).error < 1e-9);
}

TEST_CASE("worst entry names the place and sees what a norm would not") {
  Mat<double, 2, 3> truth;
  truth << 1000, 1, -2, 3, 0, 500;
  CHECK(worst_entry(truth, truth).error == 0);
  Mat<double, 2, 3> wrong = truth;
  wrong(0, 2) *= 1.01;
  const WorstEntry worst = worst_entry(wrong, truth);
  CHECK(worst.row == 0);
  CHECK(worst.col == 2);
  CHECK(std::abs(worst.error - 0.01) < 1e-9);
  CHECK((wrong - truth).norm() / truth.norm() < 2e-5);
  wrong(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(worst_entry(wrong, truth).error == std::numeric_limits<double>::infinity());
}

TEST_CASE("every mutant differs from the original and none is forgotten") {
  Mat<double, 2, 3> j;
  j << 1, 2, 3, 4, 0, 6;
  int signs = 0, scales = 0, columns = 0, rows = 0;
  for_each_mutant<double, 2, 3>(j, [&](const std::string& name, const Mat<double, 2, 3>& mutant) {
    CHECK(mutant != j);
    signs += name == "sign of an entry";
    scales += name == "1 % on an entry";
    columns += name == "swapped columns";
    rows += name == "swapped rows";
  });
  CHECK(signs == 5);
  CHECK(scales == 5);
  CHECK(columns == 3);
  CHECK(rows == 1);
  // Two equal rows swapped are no mutant.
  rows = 0;
  for_each_mutant<double, 2, 2>(Mat2<double>::Ones(), [&](const std::string& name, const Mat2<double>&) {
    rows += name == "swapped rows" || name == "swapped columns";
  });
  CHECK(rows == 0);
}
