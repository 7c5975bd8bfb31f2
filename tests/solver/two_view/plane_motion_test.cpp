// SPDX-License-Identifier: BSD-3-Clause
// Motion from a plane: accuracy against the predicted one, mismatches, few matches, and every refusal.
#include "sslam/solver/two_view/plane_motion.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "support/test_scalars.hpp"

namespace sslam {
namespace {

using testing::gaussian;
using testing::gaussian_vector;

constexpr int kPlaneTrials = 60;
constexpr double kFocal = 500;

struct PlaneScene {
  int matches = 60;
  double wrong = 0;  // share that does not lie on the plane, or is no match at all
  double noise = 1;  // pixels
  double motion = 0.1;
  bool one_ray = false;
};

struct Views {
  SO3<double> R_10;
  Vec3<double> n_0, tau;
  std::vector<BearingMatch<double>> matches;
  std::vector<bool> right;

  Views(const PlaneScene& scene, std::uint64_t seed) {
    Random random(seed);
    R_10 = SO3<double>::exp(radians(8.0) * gaussian_vector<3>(random).normalized());
    n_0 = Vec3<double>(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 1).normalized();
    tau = scene.motion * gaussian_vector<3>(random).normalized();
    while (static_cast<int>(matches.size()) < scene.matches) {
      Vec3<double> ray(random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.45), 1);
      if (scene.one_ray) ray = {0.1, 0.05, 1};
      if (n_0.dot(ray) < 0.1) continue;
      const bool on_plane = random.uniform(0.0, 1.0) >= scene.wrong;
      const double depth = on_plane ? 1 / n_0.dot(ray) : random.uniform(0.2, 0.6) / n_0.dot(ray);
      const Vec3<double> x1 = R_10 * (depth * ray) + tau;
      if (x1.z() < 0.1) continue;
      const auto noisy = [&](Vec3<double> x) {
        x /= x.z();
        for (int i = 0; i < 2; ++i) x[i] += scene.noise / kFocal * gaussian(random);
        return x;
      };
      matches.push_back({noisy(ray), noisy(x1), std::max(scene.noise, 0.1) / kFocal});
      right.push_back(on_plane);
    }
  }

  template <Scalar S>
  [[nodiscard]] PlaneMotion<S> solve(std::span<std::uint8_t> inliers = {}) const {
    std::vector<BearingMatch<S>> cast;
    for (const auto& m : matches)
      cast.push_back({m.ray0.template cast<S>(), m.ray1.template cast<S>(), static_cast<S>(m.sigma)});
    return plane_motion<S>(cast, R_10.template cast<S>(), n_0.template cast<S>(), {}, 1, inliers);
  }
};

}  // namespace

TEMPLATE_TEST_CASE("plane motion: the predicted accuracy is reached, with few matches too", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (const int matches : {8, 20, 200}) {
    double chi2 = 0;
    int found = 0;
    for (int trial = 0; trial < kPlaneTrials; ++trial) {
      const Views views({.matches = matches}, static_cast<std::uint64_t>(trial));
      const auto motion = views.solve<S>();
      if (!usable(motion.status)) continue;
      ++found;
      const Vec3<double> error = motion.t_10_over_d.template cast<double>() - views.tau;
      chi2 += error.dot(motion.covariance.template cast<double>().inverse() * error);
    }
    CAPTURE(matches, chi2 / found);
    CHECK(found >= kPlaneTrials * 9 / 10);
    CHECK(chi2 / found > 1.5);  // 3 when the covariance is exact
    CHECK(chi2 / found < 4.5);
  }
}

TEMPLATE_TEST_CASE("plane motion: a third of the matches may lie off the plane", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  int found = 0;
  double worst = 0;
  for (int trial = 0; trial < kPlaneTrials; ++trial) {
    const Views views({.matches = 90, .wrong = 0.33, .motion = 0.2}, static_cast<std::uint64_t>(trial));
    std::vector<std::uint8_t> inliers(views.matches.size(), 7);
    const auto motion = views.solve<S>(inliers);
    if (!usable(motion.status)) continue;
    ++found;
    worst = std::max(worst, (motion.t_10_over_d.template cast<double>() - views.tau).norm());
    int kept = 0, right = 0;
    for (std::size_t i = 0; i < inliers.size(); ++i) {
      right += views.right[i];
      kept += views.right[i] && inliers[i] == 1;
    }
    CHECK(kept > 0.9 * right);
  }
  CAPTURE(found, worst);
  CHECK(found >= kPlaneTrials * 9 / 10);
  CHECK(worst < 0.03);
}

TEST_CASE("plane motion: without noise it is exact, and standing still is an answer") {
  for (const double motion : {0.0, 0.05, 0.4}) {
    const Views views({.noise = 0, .motion = motion}, 3);
    const auto answer = views.solve<double>();
    REQUIRE(usable(answer.status));
    CHECK((answer.t_10_over_d - views.tau).norm() < 1e-9);
    CHECK(answer.inliers == 60);
  }
}

TEST_CASE("plane motion: what it cannot know it refuses") {
  const Views views({}, 5);
  std::vector<std::uint8_t> inliers(views.matches.size(), 7);
  const auto status = [&](std::span<const BearingMatch<double>> matches, const Vec3<double>& n_0) {
    return plane_motion<double>(matches, views.R_10, n_0, {}, 1, inliers).status;
  };
  const std::span<const BearingMatch<double>> all(views.matches);
  CHECK(status(all.first(5), views.n_0) == Status::kTooFew);
  CHECK(status(all, -views.n_0) == Status::kTooFew);  // no ray meets a plane behind the camera
  auto spoiled = views.matches;
  spoiled[7].ray1.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK(status(spoiled, views.n_0) == Status::kNotFinite);
  const Views one_ray({.one_ray = true}, 5);
  CHECK(one_ray.solve<double>().status == Status::kDegenerate);
  const Views other({.wrong = 0.9, .motion = 0.3}, 6);
  CHECK(other.solve<double>().status != Status::kOk);
  CHECK(std::count(inliers.begin(), inliers.end(), 7) == static_cast<long>(inliers.size()));
}
}  // namespace sslam
