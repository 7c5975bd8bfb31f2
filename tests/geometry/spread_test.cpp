// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/spread.hpp"

#include <cmath>
#include <limits>

#include "sslam/geometry/so3.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;

TEMPLATE_TEST_CASE("The largest sigma is that of the longest axis, however it lies", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S tolerance = 100 * std::numeric_limits<S>::epsilon();
  const Mat3<S> turned = SO3<S>::exp({S(0.4), S(-1.2), S(0.7)}).matrix();
  const Mat3<S> covariance = turned * Vec3<S>(S(0.04), S(0.25), S(0.01)).asDiagonal() * turned.transpose();
  const Vec3<S> eigenvalues = symmetric_eigenvalues<S>(covariance);
  CHECK((eigenvalues - Vec3<S>(S(0.01), S(0.04), S(0.25))).norm() < tolerance);
  CHECK(std::abs(largest_sigma<S>(covariance) - S(0.5)) < tolerance);
}

TEST_CASE("The largest sigma of nothing is 0, and of what is unknown is unknown") {
  CHECK(largest_sigma<double>(Mat3<double>::Zero()) == 0);
  const double unknown =
      largest_sigma<double>(Mat3<double>::Constant(std::numeric_limits<double>::quiet_NaN()));
  CHECK_FALSE(unknown < 1e6);
}
