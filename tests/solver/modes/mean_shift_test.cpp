// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/solver/modes/mean_shift.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

struct Cloud {
  std::vector<float> x, y, z, weight;

  void add(const Vec3<double>& direction, float w = 1) {
    const Vec3<float> n = direction.normalized().cast<float>();
    x.push_back(n.x());
    y.push_back(n.y());
    z.push_back(n.z());
    weight.push_back(w);
  }
  [[nodiscard]] DirectionView<float> view() const {
    return {x.data(), y.data(), z.data(), nullptr, x.size(), 1};
  }
  [[nodiscard]] DirectionView<float> weighted() const {
    return {x.data(), y.data(), z.data(), weight.data(), x.size(), 1};
  }
};

// `count` directions around z, at (du, dv) on its tangent plane with the given scatter, radians.
Cloud cluster(int count, double du, double dv, double scatter) {
  Random random(5);
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double u = du + scatter * gaussian(random);
    cloud.add((i % 3 == 0 ? -1.0 : 1.0) * Vec3<double>(u, dv + scatter * gaussian(random), 1));
  }
  return cloud;
}

}  // namespace

TEMPLATE_TEST_CASE("the boosted step all but reaches the mode", "[mean_shift]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S width = radians(S(5));
  for (const double scatter : {0.005, 0.03, 0.08}) {
    const Cloud cloud = cluster(20000, 0.03, -0.02, scatter);
    const auto moments = frame_moments<S>(cloud.view(), Mat3<S>(Mat3<S>::Identity()), width)[2];
    const S gain = kernel_gain(moments.variance, width);
    // Axis 2: tangent coordinates along axes 0 and 1. A scatter as wide as the kernel oversteps a little.
    const double tolerance = scatter < 0.05 ? 0.1 : 0.3;
    CHECK(gain * moments.mean.x() == Approx(0.03).epsilon(tolerance));
    CHECK(gain * moments.mean.y() == Approx(-0.02).epsilon(tolerance));
    CHECK(std::sqrt(gain * moments.variance) == Approx(scatter).epsilon(0.12));
    CHECK(gain * moments.mass == Approx(20000).epsilon(0.25));
  }
}

TEST_CASE("each axis has its own tangent coordinates", "[mean_shift]") {
  Cloud cloud;
  for (int i = 0; i < 10; ++i) {
    cloud.add({1, 0.02, 0.05});
    cloud.add({-0.03, -1, -0.04});
    cloud.add({0.01, -0.06, 1});
  }
  const auto moments =
      frame_moments<double>(cloud.view(), Mat3<double>(Mat3<double>::Identity()), radians(6.0));
  CHECK((moments[0].mean - Vec2<double>(0.02, 0.05)).norm() < 1e-5);
  CHECK((moments[1].mean - Vec2<double>(0.04, 0.03)).norm() < 1e-5);
  CHECK((moments[2].mean - Vec2<double>(0.01, -0.06)).norm() < 1e-5);
}

TEST_CASE("flat clutter has the variance of the kernel and no finite spread", "[mean_shift]") {
  Random random(9);
  Cloud cloud;
  for (int i = 0; i < 200000; ++i) cloud.add(gaussian_vector<3>(random));
  const double width = radians(4.0);
  for (const auto& axis :
       frame_moments<double>(cloud.view(), Mat3<double>(Mat3<double>::Identity()), width)) {
    CHECK(axis.variance == Approx(width * width).epsilon(0.06));
    CHECK(kernel_gain(axis.variance, width) > 10);
    CHECK(axis.mass == Approx(1.2 * width * width * 200000).epsilon(0.1));
  }
}

TEST_CASE("stride and partial blocks change nothing", "[mean_shift]") {
  const Cloud cloud = cluster(1000, 0.02, 0.01, 0.05);
  std::vector<double> packed;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    packed.push_back(cloud.x[i]);
    packed.push_back(cloud.y[i]);
    packed.push_back(cloud.z[i]);
  }
  const DirectionView<double> strided{packed.data(), packed.data() + 1, packed.data() + 2, nullptr, 1000, 3};
  const Mat3<double> frame = Mat3<double>::Identity();
  const auto a = frame_moments<double>(cloud.view(), frame, radians(6.0))[2];
  const auto b = frame_moments<double>(strided, frame, radians(6.0))[2];
  CHECK(a.mass == Approx(b.mass).epsilon(1e-5));
  CHECK((a.mean - b.mean).norm() < 1e-6);
  CHECK(a.variance == Approx(b.variance).epsilon(1e-4));
  CHECK(total_weight<double>(strided) == Approx(1000));
}

TEST_CASE("weights count as repeated votes", "[mean_shift]") {
  Cloud once, twice;
  once.add({0.05, 0, 1}, 2);
  once.add({-0.02, 0.03, 1}, 1);
  for (int i = 0; i < 2; ++i) twice.add({0.05, 0, 1});
  twice.add({-0.02, 0.03, 1});
  const Mat3<double> frame = Mat3<double>::Identity();
  const auto a = frame_moments<double>(once.weighted(), frame, 0.1)[2];
  const auto b = frame_moments<double>(twice.view(), frame, 0.1)[2];
  CHECK(a.mass == Approx(b.mass));
  CHECK((a.mean - b.mean).norm() < 1e-6);
  CHECK(total_weight<double>(once.weighted()) == Approx(3));
}

TEST_CASE("a coarse pass reads one block in so many", "[mean_shift]") {
  const Cloud cloud = cluster(128 * 40, 0.02, 0.01, 0.05);
  CHECK(total_weight<double>(cloud.view(), 8) == Approx(128 * 5));
  const Mat3<double> frame = Mat3<double>::Identity();
  const auto all = frame_moments<double>(cloud.view(), frame, 0.1)[2];
  const auto some = frame_moments<double>(cloud.view(), frame, 0.1, 8)[2];
  CHECK(some.mass == Approx(all.mass / 8).epsilon(0.1));
  CHECK((all.mean - some.mean).norm() < 0.01);
}

TEST_CASE("nothing and zero vectors weigh nothing and NaN shows", "[mean_shift]") {
  CHECK(total_weight<double>(DirectionView<float>{}) == 0);
  const Mat3<double> frame = Mat3<double>::Identity();
  CHECK(frame_moments<double>(DirectionView<float>{}, frame, 0.1)[0].mass == 0);
  const std::vector<float> zero(300, 0.0F);
  const DirectionView<float> zeros{zero.data(), zero.data(), zero.data(), nullptr, 300, 1};
  CHECK(frame_moments<double>(zeros, frame, 0.1)[1].mass == 0);
  CHECK(frame_moments<double>(zeros, frame, 0.1)[1].mean == Vec2<double>::Zero());
  Cloud cloud = cluster(500, 0, 0, 0.1);
  cloud.y[499] = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(std::isfinite(total_weight<double>(cloud.view())));
  cloud.y[499] = 0;
  cloud.weight[3] = std::numeric_limits<float>::infinity();
  CHECK_FALSE(std::isfinite(total_weight<double>(cloud.weighted())));
  cloud.x[200] = 1e15F;
  CHECK_FALSE(std::isfinite(total_weight<double>(cloud.view())));
}
