// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/residual/loss.hpp"

#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;

namespace {

template <class L>
void check_loss(const L& loss) {
  CHECK(loss.rho(0.0) == 0);
  CHECK(loss.weight(0.0) == 1);
  double last = 0;
  for (double s = 0.05; s < 60; s *= 1.3) {
    CAPTURE(s);
    const double h = 1e-5 * s;
    CHECK(std::abs((loss.rho(s + h) - loss.rho(s - h)) / (2 * h) - loss.weight(s)) < 1e-6);
    CHECK(loss.rho(s) >= last);
    CHECK(loss.rho(s) <= s * (1 + 1e-12));
    CHECK(loss.weight(s) >= 0);
    CHECK(loss.weight(s) <= 1);
    last = loss.rho(s);
  }
}

}  // namespace

TEST_CASE("weight is the slope of rho and rho never falls") {
  check_loss(TrivialLoss<double>{});
  check_loss(HuberLoss<double>{1.7});
  check_loss(CauchyLoss<double>{1.7});
  check_loss(TukeyLoss<double>{4.1});
}

TEMPLATE_TEST_CASE("what a far error may do", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S far = S(1e6);
  CHECK(TrivialLoss<S>{}.weight(far) == 1);
  CHECK(HuberLoss<S>{2}.weight(far) == S(2) / S(1000));
  CHECK(CauchyLoss<S>{2}.weight(far) < S(1e-5));
  CHECK(TukeyLoss<S>{3}.weight(far) == 0);
  CHECK(TukeyLoss<S>{3}.rho(far) == S(3));
  CHECK(HuberLoss<S>{2}.rho(S(4)) == S(4));
}
