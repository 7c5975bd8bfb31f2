// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/least_squares/positive_inverse.hpp"

#include <limits>

#include "support/catch.hpp"
#include "support/test_scalars.hpp"

namespace positive_inverse_test {

using namespace sslam;

template <Scalar S>
Mat3<S> skewed() {
  Mat3<S> H;
  H << 4, 1, -1, 1, 3, S(0.5), -1, S(0.5), 2;
  return H;
}

TEMPLATE_TEST_CASE("A positive definite matrix times its inverse is the identity", "", SSLAM_TEST_SCALARS) {
  const Mat3<TestType> H = skewed<TestType>();
  Mat3<TestType> inverse;
  REQUIRE(inverse_of<TestType, 3>(H, inverse));
  CHECK((H * inverse - Mat3<TestType>::Identity()).norm() < 10 * std::numeric_limits<TestType>::epsilon());
}

TEMPLATE_TEST_CASE("No inverse is given that is not positive, not a number or infinite", "",
                   SSLAM_TEST_SCALARS) {
  using Limits = std::numeric_limits<TestType>;
  const Mat3<TestType> untouched = 7 * Mat3<TestType>::Identity();
  for (const TestType spoilt :
       {TestType(0), TestType(-1), Limits::quiet_NaN(), Limits::infinity(), Limits::denorm_min()}) {
    Mat3<TestType> H = skewed<TestType>();
    H.row(1).setZero();
    H.col(1).setZero();
    H(1, 1) = spoilt;
    Mat3<TestType> inverse = untouched;
    INFO(spoilt);
    CHECK_FALSE(inverse_of<TestType, 3>(H, inverse));
    CHECK(inverse == untouched);
  }
}

}  // namespace positive_inverse_test
