// SPDX-License-Identifier: BSD-3-Clause
// Relative pose: Jacobian of the epipolar error, refinement with and without a prior, rotation alone, search
// from nothing, flat scenes.
#include <algorithm>
#include <limits>

#include "solver/two_view/two_views.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"
#include "support/trials.hpp"

namespace sslam {
namespace {

constexpr int kRelativePoseTrials = testing::trials(40, 10);
using Pose = RelativePose<double>;
static_assert(Manifold<RelativePose<float>> && Manifold<RelativePose<double>>);

template <Scalar S>
double rotation_error_deg(const SO3<S>& found, const SO3<double>& truth) {
  return degrees(angle_between(found.template cast<double>(), truth));
}

struct RelativePoseScore {
  int ok = 0, low_parallax = 0, degenerate = 0, wrong = 0;
  double chi2_t = 0, chi2_R = 0;
};

// wrong: usable, but more than 6 degrees off in the translation.
template <Scalar S>
RelativePoseScore find(const TwoViewOptions& o) {
  RelativePoseScore score;
  for (int trial = 0; trial < kRelativePoseTrials; ++trial) {
    const TwoViews views = make_two_views(o, static_cast<std::uint64_t>(trial));
    const auto matches = views.as<S>();
    SO3<S> R;
    Vec3<S> t = Vec3<S>::Zero();
    const auto answer = find_relative_pose<S>(matches, {}, 1, R, t);
    score.low_parallax += answer.status == Status::kLowParallax;
    score.degenerate += answer.status == Status::kDegenerate;
    if (!usable(answer.status)) continue;
    ++score.ok;
    score.wrong += angle_deg(t.template cast<double>(), views.t_10) > 6;
    score.chi2_t += direction_chi2(t, answer.translation_covariance, views.t_10);
    const Vec3<double> phi = (views.R_10 * R.template cast<double>().inverse()).log();
    score.chi2_R += phi.dot(answer.rotation_covariance.template cast<double>().inverse() * phi);
  }
  score.chi2_t /= std::max(score.ok, 1);
  score.chi2_R /= std::max(score.ok, 1);
  return score;
}

}  // namespace

TEST_CASE("epipolar error: analytic derivatives agree with differences entry by entry") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const TwoViews views = make_two_views({.matches = 5, .noise = 3, .turn = 20}, seed);
    const Pose pose{views.R_10.retract(0.02 * Vec3<double>(1, -2, 1)),
                    (views.t_10 + Vec3<double>(.1, .2, -.1)).normalized()};
    for (const auto& match : views.matches) {
      const auto error = [&](const Pose& p) {
        return Vec<double, 1>(epipolar_residual(p.R_10.matrix(), p.t_10, match));
      };
      const auto row = epipolar_row(pose.R_10.matrix(), pose.t_10, match);
      Mat<double, 1, 5> analytic;
      analytic << row.wrt_rotation.transpose(), row.wrt_translation.transpose() * tangent_basis(pose.t_10);
      CHECK(std::abs(row.residual - epipolar_residual(pose.R_10.matrix(), pose.t_10, match)) < 1e-9);
      const auto worst = testing::worst_entry(analytic, testing::numeric_jacobian(error, pose, 1e-4));
      CAPTURE(worst.col);
      CHECK(worst.error < 1e-5);
    }
  }
}

TEST_CASE("epipolar error: of true matches it has unit variance") {
  const TwoViews views = make_two_views({.matches = 20000, .turn = 15}, 1);
  double sum = 0;
  for (const auto& match : views.matches)
    sum += std::pow(epipolar_residual(views.R_10.matrix(), views.t_10, match), 2);
  CHECK(std::abs(sum / 20000 - 1) < 0.03);  // three standard deviations
}

TEMPLATE_TEST_CASE("rotation from bearings: pure rotation with mismatches", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (const double mismatches : {0.0, 0.3, 0.5}) {
    double chi2 = 0;
    for (std::uint64_t seed = 0; seed < kRelativePoseTrials; ++seed) {
      const TwoViews views =
          make_two_views({.mismatches = mismatches, .turn = 12, .scene = TwoViewOptions::kInfinite}, seed);
      const auto matches = views.as<S>();
      std::vector<std::uint8_t> inliers(matches.size());
      const auto answer = rotation_from_bearings<S>(matches, {}, seed, inliers);
      REQUIRE(usable(answer.status));
      CHECK(answer.inliers == std::count(inliers.begin(), inliers.end(), 1));
      CHECK(answer.inliers > 0.95 * std::count(views.correct.begin(), views.correct.end(), true));
      const Vec3<double> phi = (views.R_10 * answer.R_10.template cast<double>().inverse()).log();
      chi2 += phi.dot(answer.covariance.template cast<double>().inverse() * phi) / kRelativePoseTrials;
    }
    CAPTURE(mismatches);
    CHECK(chi2 > 1.5);  // 3 when the covariance is exact
    CHECK(chi2 < 5);
  }
}

TEMPLATE_TEST_CASE("rotation from bearings: refusals", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  CHECK(rotation_from_bearings<S>({}, {}, 1).status == Status::kTooFew);
  auto matches = make_two_views({.baseline = 2}, 1).as<S>();
  CHECK(rotation_from_bearings<S>(matches, {}, 1).status == Status::kNoConsensus);
  matches[3].ray0.y() = std::numeric_limits<S>::quiet_NaN();
  CHECK(rotation_from_bearings<S>(matches, {}, 1).status == Status::kNotFinite);
  const std::vector<BearingMatch<S>> same(50, {Vec3<S>(S(.1), S(.2), 1), Vec3<S>(S(.1), S(.2), 1)});
  CHECK(rotation_from_bearings<S>(same, {}, 1).status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("relative pose: refinement reaches the predicted accuracy", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (const double mismatches : {0.0, 0.3}) {
    double chi2_t = 0, chi2_R = 0;
    int ok = 0;
    for (std::uint64_t seed = 0; seed < kRelativePoseTrials; ++seed) {
      const TwoViews views = make_two_views({.mismatches = mismatches, .baseline = 0.6}, seed);
      const auto matches = views.as<S>();
      SO3<S> R = views.R_10.retract(Vec3<double>(0.003, -0.004, 0.003)).template cast<S>();
      Vec3<S> t = (views.t_10 + Vec3<double>(0.05, -0.05, 0.05)).template cast<S>();
      const auto answer = refine_relative_pose<S>(matches, R, t, {});
      if (!usable(answer.status)) continue;
      ++ok;
      chi2_t += direction_chi2(t, answer.translation_covariance, views.t_10);
      const Vec3<double> phi = (views.R_10 * R.template cast<double>().inverse()).log();
      chi2_R += phi.dot(answer.rotation_covariance.template cast<double>().inverse() * phi);
      CHECK(std::abs(answer.mean_squared_error - 1) < 0.25);
    }
    CAPTURE(mismatches, ok);
    CHECK(ok >= kRelativePoseTrials - 2);
    CHECK(chi2_t / ok < 4);  // 2 when the covariance is exact
    CHECK(chi2_R / ok < 6);  // 3
    CHECK(chi2_t / ok > 1);
    CHECK(chi2_R / ok > 1.5);
  }
}

TEMPLATE_TEST_CASE("relative pose: a prior on the rotation sharpens the translation", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  const TwoViews views = make_two_views({.matches = 100, .baseline = 0.3}, 4);
  const auto matches = views.as<S>();
  SO3<S> R_free = views.R_10.template cast<S>(), R_held = R_free;
  Vec3<S> t_free = views.t_10.template cast<S>(), t_held = t_free;
  RelativePoseOptions<S> options;
  options.max_direction_sigma = 1;
  const auto free = refine_relative_pose<S>(matches, R_free, t_free, options);
  options.prior_R_10 = views.R_10.template cast<S>();
  options.prior_information = Mat3<S>::Identity() * S(1e8);  // 0.006 degrees
  const auto held = refine_relative_pose<S>(matches, R_held, t_held, options);
  REQUIRE(usable(free.status));
  REQUIRE(usable(held.status));
  CHECK(rotation_error_deg(R_held, views.R_10) < 0.02);
  CHECK(held.translation_covariance.trace() < free.translation_covariance.trace() / 2);
  CHECK(held.rotation_covariance.trace() < S(3.1e-8));
  CHECK(direction_chi2(t_held, held.translation_covariance, views.t_10) < 14);
}

TEMPLATE_TEST_CASE("relative pose: found from nothing for turns up to 10 degrees", "", SSLAM_TEST_SCALARS) {
  for (const double turn : {0.0, 5.0, 10.0}) {
    const RelativePoseScore s = find<TestType>({.mismatches = 0.3, .baseline = 0.5, .turn = turn});
    CAPTURE(turn, s.ok, s.chi2_t, s.chi2_R);
    CHECK(s.ok >= kRelativePoseTrials - 3);
    CHECK(s.wrong == 0);
    CHECK(s.chi2_t < 5);  // 2 when the covariance is exact
    CHECK(s.chi2_R < 6);  // 3
  }
}

TEMPLATE_TEST_CASE("relative pose: half of the matches may be wrong", "", SSLAM_TEST_SCALARS) {
  const RelativePoseScore s = find<TestType>({.mismatches = 0.5, .baseline = 0.5});
  CHECK(s.ok >= kRelativePoseTrials - 4);
  CHECK(s.wrong == 0);
}

TEMPLATE_TEST_CASE("relative pose: pure rotation is low parallax", "", SSLAM_TEST_SCALARS) {
  const RelativePoseScore s =
      find<TestType>({.mismatches = 0.3, .turn = 8, .scene = TwoViewOptions::kInfinite});
  CHECK(s.low_parallax >= kRelativePoseTrials - 2);
  CHECK(s.ok == 0);
}

TEMPLATE_TEST_CASE("relative pose: a camera that stands still is low parallax", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  auto matches = make_two_views({.noise = 0}, 3).as<S>();
  for (auto& match : matches) match.ray1 = match.ray0;
  SO3<S> R;
  Vec3<S> t(0, 0, 1);
  CHECK(find_relative_pose<S>(matches, {}, 1, R, t).status == Status::kLowParallax);
  CHECK(refine_relative_pose<S>(matches, R, t, {}).status == Status::kLowParallax);
  CHECK(t == Vec3<S>(0, 0, 1));
}

TEMPLATE_TEST_CASE("relative pose: a flat scene is solved where it has one answer and refused elsewhere", "",
                   SSLAM_TEST_SCALARS) {
  const RelativePoseScore s =
      find<TestType>({.mismatches = 0.3, .noise = 0.5, .baseline = 0.5, .scene = TwoViewOptions::kFlat});
  CAPTURE(s.ok, s.degenerate, s.wrong);
  CHECK(s.ok >= kRelativePoseTrials / 8);
  CHECK(s.ok + s.degenerate >= kRelativePoseTrials - 2);
  CHECK(s.wrong <= 1);
}

TEMPLATE_TEST_CASE("relative pose: a rotation prior decides between the answers of a flat scene", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  int ok = 0, wrong = 0;
  for (std::uint64_t seed = 0; seed < kRelativePoseTrials; ++seed) {
    const TwoViews views =
        make_two_views({.noise = 0.5, .baseline = 0.5, .scene = TwoViewOptions::kFlat}, seed);
    const auto matches = views.as<S>();
    FindRelativePoseOptions<S> options;
    options.refinement.prior_R_10 = views.R_10.template cast<S>();
    options.refinement.prior_information = Mat3<S>::Identity() * S(1 / (0.005 * 0.005));
    SO3<S> R;
    Vec3<S> t = Vec3<S>::Zero();
    if (!usable(find_relative_pose<S>(matches, options, 1, R, t).status)) continue;
    ++ok;
    wrong += angle_deg(t.template cast<double>(), views.t_10) > 6;
  }
  CHECK(ok >= kRelativePoseTrials / 2);
  CHECK(wrong <= 1);
}

TEMPLATE_TEST_CASE("relative pose: failure leaves the caller's state alone", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Vec3<S> before(0, 0, 1);
  SO3<S> R;
  Vec3<S> t = before;
  std::vector<std::uint8_t> inliers(500, 7);
  const auto untouched = [&] {
    return t == before && R.matrix() == Mat3<S>::Identity() &&
           std::count(inliers.begin(), inliers.end(), 7) == 500;
  };
  CHECK(refine_relative_pose<S>({}, R, t, {}).status == Status::kTooFew);
  CHECK(find_relative_pose<S>({}, {}, 1, R, t).status == Status::kTooFew);
  auto matches = make_two_views({.mismatches = 1}, 1).as<S>();
  CHECK(!usable(refine_relative_pose<S>(matches, R, t, {}, inliers).status));
  CHECK(!usable(find_relative_pose<S>(matches, {}, 1, R, t, inliers).status));
  CHECK(untouched());
  matches[7].ray1.x() = std::numeric_limits<S>::infinity();
  CHECK(refine_relative_pose<S>(matches, R, t, {}, inliers).status == Status::kNotFinite);
  CHECK(find_relative_pose<S>(matches, {}, 1, R, t, inliers).status == Status::kNotFinite);
  CHECK(untouched());
  Vec3<S> zero = Vec3<S>::Zero();
  const auto good = make_two_views({}, 1).as<S>();
  CHECK(refine_relative_pose<S>(good, R, zero, {}).status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("relative pose: equal seeds give equal bits", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto matches = make_two_views({.mismatches = 0.3, .baseline = 0.5}, 3).as<S>();
  SO3<S> Ra, Rb;
  Vec3<S> ta, tb;
  REQUIRE(usable(find_relative_pose<S>(matches, {}, 5, Ra, ta).status));
  REQUIRE(usable(find_relative_pose<S>(matches, {}, 5, Rb, tb).status));
  CHECK(ta == tb);
  CHECK(Ra.matrix() == Rb.matrix());
}

TEMPLATE_TEST_CASE("relative pose: whatever the input the answer is finite or the state is left", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  const TwoViews views = make_two_views({.mismatches = 0.3, .baseline = 0.5}, 4);
  const SO3<S> R_before = views.R_10.template cast<S>();
  const Vec3<S> t_before(S(0.6), 0, S(0.8));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const auto matches = testing::spoiled<S>(views.as<S>(), random);
    std::vector<std::uint8_t> inliers(matches.size(), 7);
    SO3<S> R = R_before;
    Vec3<S> t = t_before;
    const auto holds = [&](Status status) {
      INFO("seed " << seed << ", " << name(status));
      if (usable(status)) {
        CHECK((R.matrix().allFinite() && t.allFinite()));
      } else {
        CHECK((R.matrix() == R_before.matrix() && t == t_before));
        CHECK(std::count(inliers.begin(), inliers.end(), 7) == static_cast<int>(inliers.size()));
      }
      R = R_before;
      t = t_before;
      std::fill(inliers.begin(), inliers.end(), std::uint8_t{7});
    };
    holds(refine_relative_pose<S>(matches, R, t, {}, inliers).status);
    const auto turn = rotation_from_bearings<S>(matches, {}, seed, inliers);
    holds(turn.status);
    if (usable(turn.status)) CHECK((turn.R_10.matrix().allFinite() && turn.covariance.allFinite()));
    if (seed % 4 == 0) holds(find_relative_pose<S>(matches, {}, seed, R, t, inliers).status);
  }
}

}  // namespace sslam
