// SPDX-License-Identifier: BSD-3-Clause
// Translation from a known rotation: accuracy against the predicted one, mismatches, sign, and every refusal.
#include <algorithm>
#include <limits>

#include "solver/two_view/two_views.hpp"
#include "sslam/solver/two_view/translation.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"

namespace sslam {
namespace {

constexpr int kTranslationTrials = 60;

template <Scalar S>
TranslationEstimate<S> estimate(const TwoViews& views, std::span<std::uint8_t> inliers = {},
                                std::uint64_t seed = 1) {
  const auto matches = views.as<S>();
  return translation_from_rotation<S>(matches, views.R_10.template cast<S>(), {}, seed, inliers);
}

struct TranslationScore {
  int usable = 0;
  double mean_chi2 = 0, worst_deg = 0;
};

template <Scalar S>
TranslationScore score(const TwoViewOptions& options) {
  TranslationScore score;
  for (int trial = 0; trial < kTranslationTrials; ++trial) {
    const TwoViews views = make_two_views(options, static_cast<std::uint64_t>(trial));
    const auto answer = estimate<S>(views);
    if (!usable(answer.status)) continue;
    ++score.usable;
    score.mean_chi2 += direction_chi2(answer.t_10, answer.covariance, views.t_10);
    score.worst_deg = std::max(score.worst_deg, angle_deg(answer.t_10.template cast<double>(), views.t_10));
  }
  score.mean_chi2 /= std::max(score.usable, 1);
  return score;
}

template <Scalar S>
int count_status(const TwoViewOptions& options, Status status) {
  int count = 0;
  for (int trial = 0; trial < kTranslationTrials; ++trial)
    count += estimate<S>(make_two_views(options, static_cast<std::uint64_t>(trial))).status == status;
  return count;
}

}  // namespace

TEMPLATE_TEST_CASE("translation: the predicted accuracy is reached without mismatches", "",
                   SSLAM_TEST_SCALARS) {
  for (const double baseline : {0.1, 0.3, 1.0}) {
    const TranslationScore s = score<TestType>({.baseline = baseline});
    CAPTURE(baseline, s.mean_chi2, s.worst_deg);
    CHECK(s.usable >= kTranslationTrials - 2);
    CHECK(s.mean_chi2 > 1);  // 2 when the covariance is exact
    CHECK(s.mean_chi2 < 3.5);
  }
}

TEMPLATE_TEST_CASE("translation: half of the matches may be wrong", "", SSLAM_TEST_SCALARS) {
  for (const double mismatches : {0.3, 0.5}) {
    const TranslationScore s = score<TestType>({.mismatches = mismatches, .baseline = 0.3});
    CAPTURE(mismatches, s.mean_chi2, s.worst_deg);
    CHECK(s.usable >= kTranslationTrials - 2);
    CHECK(s.mean_chi2 < 5);
    CHECK(s.worst_deg < 2.5);
  }
}

TEMPLATE_TEST_CASE("translation: exact matches give the exact direction", "", SSLAM_TEST_SCALARS) {
  const TwoViews views = make_two_views({.noise = 0, .baseline = 0.5}, 3);
  const auto answer = estimate<TestType>(views);
  REQUIRE(usable(answer.status));
  CHECK(angle_deg(answer.t_10.template cast<double>(), views.t_10) <
        (std::is_same_v<TestType, float> ? 1e-2 : 1e-6));
  CHECK(answer.inliers == 500);
  CHECK(answer.front_share == 1);
}

TEMPLATE_TEST_CASE("translation: flags tell matches from mismatches", "", SSLAM_TEST_SCALARS) {
  const TwoViews views = make_two_views({.mismatches = 0.4}, 5);
  std::vector<std::uint8_t> inliers(views.matches.size());
  const auto answer = estimate<TestType>(views, inliers);
  REQUIRE(usable(answer.status));
  int missed = 0, wrong = 0, right = 0;
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    right += views.correct[i];
    missed += views.correct[i] && !inliers[i];
    wrong += !views.correct[i] && inliers[i];
  }
  CHECK(missed <= right / 50);
  CHECK(wrong <= 20);
  CHECK(answer.inliers == std::count(inliers.begin(), inliers.end(), 1));
}

TEMPLATE_TEST_CASE("translation: far points alone are low parallax", "", SSLAM_TEST_SCALARS) {
  for (const double mismatches : {0.0, 0.3, 0.5})
    for (const double noise : {0.0, 1.0}) {
      const TwoViewOptions o{.mismatches = mismatches, .noise = noise, .scene = TwoViewOptions::kInfinite};
      CAPTURE(mismatches, noise);
      CHECK(count_status<TestType>(o, Status::kLowParallax) == kTranslationTrials);
    }
}

TEMPLATE_TEST_CASE("translation: a camera that stands still is low parallax", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  auto matches = make_two_views({.noise = 0}, 3).as<S>();
  for (auto& match : matches) match.ray1 = match.ray0;
  CHECK(translation_from_rotation<S>(matches, SO3<S>(), {}, 1).status == Status::kLowParallax);
}

TEMPLATE_TEST_CASE("translation: points on one epipolar plane are degenerate", "", SSLAM_TEST_SCALARS) {
  CHECK(count_status<TestType>({.noise = 0, .scene = TwoViewOptions::kCollinear}, Status::kDegenerate) ==
        kTranslationTrials);
  CHECK(count_status<TestType>({.scene = TwoViewOptions::kCollinear}, Status::kDegenerate) >=
        kTranslationTrials - 1);
  const TwoViewOptions o{.mismatches = 0.3, .scene = TwoViewOptions::kCollinear};
  CHECK(count_status<TestType>(o, Status::kOk) <= 1);
}

TEMPLATE_TEST_CASE("translation: unrelated matches have no consensus", "", SSLAM_TEST_SCALARS) {
  CHECK(count_status<TestType>({.mismatches = 1}, Status::kOk) == 0);
  CHECK(count_status<TestType>({.mismatches = 1}, Status::kNoConsensus) >= kTranslationTrials - 6);
}

TEMPLATE_TEST_CASE("translation: few distant points among near ones do not count alike", "",
                   SSLAM_TEST_SCALARS) {
  // Four in five points far away: their flow is noise, and must not drown the near ones.
  const TwoViews near = make_two_views({.matches = 100, .baseline = 0.5}, 8);
  TwoViews views = make_two_views({.matches = 400, .scene = TwoViewOptions::kInfinite}, 8);
  views.R_10 = near.R_10;
  Random random(4);
  for (auto& match : views.matches) {
    match.ray1 = near.R_10 * match.ray0;
    match.ray1 /= match.ray1.z();
    for (int i = 0; i < 2; ++i) match.ray1[i] += gaussian(random) * match.sigma;
  }
  views.t_10 = near.t_10;
  views.matches.insert(views.matches.end(), near.matches.begin(), near.matches.end());
  TranslationOptions<TestType> options;
  options.min_moved_share = TestType(0.1);
  const auto matches = views.as<TestType>();
  const auto answer =
      translation_from_rotation<TestType>(matches, views.R_10.template cast<TestType>(), options, 1);
  REQUIRE(usable(answer.status));
  CHECK(direction_chi2(answer.t_10, answer.covariance, views.t_10) < 12);
  CHECK(angle_deg(answer.t_10.template cast<double>(), views.t_10) < 2);
}

TEMPLATE_TEST_CASE("translation: an uncertain rotation widens the gate", "", SSLAM_TEST_SCALARS) {
  TwoViews views = make_two_views({.baseline = 1}, 11);
  views.R_10 = views.R_10.retract(Vec3<double>(0.004, -0.003, 0.005));
  const auto matches = views.as<TestType>();
  const auto R = views.R_10.template cast<TestType>();
  const auto strict = translation_from_rotation<TestType>(matches, R, {}, 1);
  TranslationOptions<TestType> options;
  options.rotation_sigma = TestType(0.004);
  const auto open = translation_from_rotation<TestType>(matches, R, options, 1);
  REQUIRE(usable(open.status));
  CHECK(open.inliers > strict.inliers);
  CHECK(open.inliers > 480);
  CHECK(angle_deg(open.t_10.template cast<double>(), views.t_10) < 3);
}

TEMPLATE_TEST_CASE("translation: bad input is refused and leaves the flags alone", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  TwoViews views = make_two_views({}, 2);
  std::vector<std::uint8_t> inliers(views.matches.size(), 7);
  const auto untouched = [&] { return std::count(inliers.begin(), inliers.end(), 7) == 500; };
  CHECK(translation_from_rotation<S>({}, SO3<S>(), {}, 1).status == Status::kTooFew);
  auto matches = views.as<S>();
  CHECK(translation_from_rotation<S>(std::span(matches).first(9), SO3<S>(), {}, 1).status == Status::kTooFew);
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    matches = views.as<S>();
    matches[250].ray1.x() = bad;
    const auto answer = translation_from_rotation<S>(matches, SO3<S>(), {}, 1, inliers);
    CHECK(answer.status == Status::kNotFinite);
    CHECK(answer.t_10.allFinite());
    CHECK(untouched());
  }
  matches = views.as<S>();
  const auto nan = std::numeric_limits<S>::quiet_NaN();
  const auto no_rotation = SO3<S>::from_quaternion(nan, 0, 0, 0);
  CHECK(translation_from_rotation<S>(matches, no_rotation, {}, 1, inliers).status == Status::kNotFinite);
  CHECK(untouched());
}

TEMPLATE_TEST_CASE("translation: equal seeds give equal bits", "", SSLAM_TEST_SCALARS) {
  const TwoViews views = make_two_views({.mismatches = 0.4}, 9);
  const auto a = estimate<TestType>(views, {}, 42), b = estimate<TestType>(views, {}, 42);
  REQUIRE(usable(a.status));
  CHECK(a.t_10 == b.t_10);
  CHECK(a.covariance == b.covariance);
  const auto c = estimate<TestType>(views, {}, 43);
  CHECK(angle_deg(a.t_10.template cast<double>(), c.t_10.template cast<double>()) < 0.5);
}

TEMPLATE_TEST_CASE("translation: whatever the input the answer is finite or the flags are left", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  const TwoViews views = make_two_views({.mismatches = 0.3}, 4);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    INFO("seed " << seed);
    const auto matches = testing::spoiled<S>(views.as<S>(), random);
    std::vector<std::uint8_t> inliers(matches.size(), 7);
    const auto answer =
        translation_from_rotation<S>(matches, views.R_10.template cast<S>(), {}, seed, inliers);
    if (usable(answer.status))
      CHECK((answer.t_10.allFinite() && answer.covariance.allFinite()));
    else
      CHECK(std::count(inliers.begin(), inliers.end(), 7) == static_cast<int>(inliers.size()));
  }
}

}  // namespace sslam
