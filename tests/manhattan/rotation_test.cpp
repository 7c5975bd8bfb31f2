// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sslam/manhattan/rotation.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"
#include "vote_scene.hpp"

using namespace sslam;
using test::error_deg;
using test::VoteScene;

namespace {

template <Scalar S>
ManhattanPrior<S> prior_off_by(const SO3<double>& truth, Random& random, double off_deg) {
  const Vec3<double> off = radians(off_deg) * test::gaussian_vector<3>(random).normalized();
  return {(SO3<double>::exp(off) * truth).cast<S>()};
}

template <Scalar S>
ManhattanEstimate<S> track(const VoteScene<S>& scene, const ManhattanPrior<S>& prior,
                           const ManhattanOptions<S>& options = {}) {
  return track_manhattan<S>(scene.normals(), scene.lines(), prior, options);
}

// phi^T C^-1 phi: chi-squared with 3 degrees of freedom when the covariance is right.
template <Scalar S>
double normalised_error(const ManhattanEstimate<S>& estimate, const SO3<double>& truth) {
  const Vec3<double> phi = (estimate.cam_from_manhattan.template cast<double>() * truth.inverse()).log();
  return phi.dot(estimate.covariance.template cast<double>().ldlt().solve(phi));
}

}  // namespace

TEMPLATE_TEST_CASE("normals and segments alone and together give the rotation", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  struct Case {
    int normals, lines;
    double limit_deg;
  };
  const auto c = GENERATE(Case{6000, 0, 0.8}, Case{0, 25, 0.6}, Case{6000, 25, 0.6});
  Random random(1);
  std::vector<double> errors;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    VoteScene<S> scene(seed, test::any_rotation(random));
    for (int axis = 0; axis < 3; ++axis) {
      if (c.normals > 0) scene.add_plane(axis, c.normals / 3 - 500 * axis, 5);
      scene.add_lines(axis, c.lines, 0.006);
    }
    scene.add_clutter_normals(c.normals / 3);
    scene.add_clutter_lines(c.lines, 0.006);
    const auto prior = prior_off_by<S>(scene.truth, random, 6);
    const auto estimate = track(scene, prior);
    REQUIRE(estimate.status == Status::kOk);
    CHECK(estimate.axes_seen == 3);
    errors.push_back(error_deg(estimate.cam_from_manhattan, scene.truth));
  }
  std::sort(errors.begin(), errors.end());
  CHECK(errors[20] < 0.5 * c.limit_deg);
  CHECK(errors.back() < 2 * c.limit_deg);
}

TEMPLATE_TEST_CASE("thousands of biased normals give way to segments", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(2);
  VoteScene<S> scene(2, test::any_rotation(random));
  for (int axis = 0; axis < 3; ++axis) {
    scene.add_plane(axis, 10000, 4, radians(3.0) * test::gaussian_vector<3>(random).normalized());
    scene.add_lines(axis, 15, 0.005);
  }
  const auto prior = prior_off_by<S>(scene.truth, random, 4);
  CHECK(error_deg(track(scene, prior).cam_from_manhattan, scene.truth) < 0.4);
  scene.votes.clear();
  const auto by_normals = track(scene, prior);
  CHECK(error_deg(by_normals.cam_from_manhattan, scene.truth) > 0.4);
  CHECK(by_normals.deviation > radians(S(0.8)));
}

TEMPLATE_TEST_CASE("the covariance holds for segments and for planes with a bias of their own", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto kind = GENERATE(0, 1, 2);  // segments, planes, both
  constexpr int kTrials = 300;
  constexpr double kScatterDeg = 3;
  ManhattanOptions<S> options;
  options.line_floor = radians(S(0.01));  // the simulated edges are exact
  options.normal_floor = 0;
  const double shared = std::sqrt(static_cast<double>(options.normal_correlation)) * radians(kScatterDeg);
  Random random(3);
  std::vector<double> errors;
  for (int trial = 0; trial < kTrials; ++trial) {
    VoteScene<S> scene(static_cast<std::uint64_t>(trial), test::any_rotation(random));
    for (int axis = 0; axis < 3; ++axis) {
      if (kind != 1) scene.add_lines(axis, 12, 0.01);
      if (kind != 0) scene.add_plane(axis, 1500, kScatterDeg, shared * test::gaussian_vector<3>(random));
    }
    if (kind != 1) scene.add_clutter_lines(20, 0.01);
    // A prior that errs as much as it says.
    ManhattanPrior<S> prior;
    prior.covariance = Mat3<S>::Identity() * (radians(S(3)) * radians(S(3)));
    prior.cam_from_manhattan =
        (SO3<double>::exp(radians(3.0) * test::gaussian_vector<3>(random)) * scene.truth).template cast<S>();
    const auto estimate = track(scene, prior, options);
    REQUIRE(estimate.status == Status::kOk);
    errors.push_back(normalised_error(estimate, scene.truth));
  }
  INFO("kind " << kind);
  std::sort(errors.begin(), errors.end());
  const double median = errors[kTrials / 2];
  CHECK(median > 1.6);
  CHECK(median < 3.4);  // of chi-squared: 2.37
  // Beyond the 99.9 % quantile are the few trials in which clutter took an edge's place.
  const auto beyond = errors.end() - std::upper_bound(errors.begin(), errors.end(), 16.27);
  CHECK(beyond <= kTrials / 15);
}

TEMPLATE_TEST_CASE("one axis leaves the turn about it to the prior", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const bool by_lines = GENERATE(false, true);
  Random random(4);
  VoteScene<S> scene(4, test::any_rotation(random));
  if (by_lines)
    scene.add_lines(1, 30, 0.005);
  else
    scene.add_plane(1, 4000, 3);
  auto prior = prior_off_by<S>(scene.truth, random, 5);
  prior.covariance = Mat3<S>::Identity() * (radians(S(4)) * radians(S(4)));
  const auto estimate = track(scene, prior);
  CHECK(estimate.status == Status::kDegenerate);
  CHECK(estimate.axes_seen == 1);
  CHECK(estimate.axes[1].seen);
  const Vec3<S> axis = estimate.cam_from_manhattan.matrix().col(1);
  CHECK(axis.template cast<double>().dot(scene.truth.matrix().col(1)) > std::cos(radians(1.2)));
  // The rotation from prior to answer has no part about the axis, and there the covariance is the prior's.
  const Vec3<S> turn = (estimate.cam_from_manhattan * prior.cam_from_manhattan.inverse()).log();
  CHECK(std::abs(turn.dot(axis)) < radians(S(0.3)));
  CHECK(axis.dot(estimate.covariance * axis) == Approx(radians(4.0) * radians(4.0)).epsilon(0.02));
  const Vec3<S> across = axis.unitOrthogonal();
  CHECK(across.dot(estimate.covariance * across) < 0.5 * radians(4.0) * radians(4.0));
}

TEMPLATE_TEST_CASE("two axes are enough in any mixture", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto kind = GENERATE(0, 1, 2);
  Random random(5);
  VoteScene<S> scene(5, test::any_rotation(random));
  if (kind != 1) scene.add_plane(2, 4000, 2);
  if (kind == 0) scene.add_plane(0, 3000, 2);
  if (kind == 1) scene.add_lines(2, 20, 0.005);
  if (kind != 0) scene.add_lines(0, 20, 0.005);
  const auto estimate = track(scene, prior_off_by<S>(scene.truth, random, 5));
  CHECK(estimate.status == Status::kOk);
  CHECK(estimate.axes_seen == 2);
  CHECK_FALSE(estimate.axes[1].seen);
  CHECK(error_deg(estimate.cam_from_manhattan, scene.truth) < 0.5);
}

TEMPLATE_TEST_CASE("pieces of one image line are not an axis", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(6);
  VoteScene<S> scene(6, test::any_rotation(random));
  scene.add_lines(1, 20, 0.003);
  // Ten pieces of one line, 4 degrees off every axis: with the turn about axis 1 free, one plane proves
  // nothing.
  const Vec3<double> d = scene.truth.matrix() * SO3<double>::exp({0, 0.07, 0}).matrix().col(0);
  const Vec3<double> middle = scene.any_ray();
  const Vec3<double> plane = middle.cross(d).normalized();
  for (int i = 0; i < 10; ++i)
    scene.add_line((middle + 0.05 * (i - 5) * plane.cross(middle)).normalized(), plane, 0.003);
  const auto estimate = track(scene, ManhattanPrior<S>{scene.truth.template cast<S>()});
  CHECK(estimate.status == Status::kDegenerate);
  CHECK_FALSE(estimate.axes[0].seen);
  CHECK_FALSE(estimate.axes[2].seen);
}

TEMPLATE_TEST_CASE("a camera that turns right round keeps the names of its axes", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(7);
  const SO3<double> start = test::any_rotation(random);
  ManhattanPrior<S> prior{start.cast<S>()};
  const Vec3<double> axis = test::gaussian_vector<3>(random).normalized();
  for (int step = 1; step <= 90; ++step) {
    VoteScene<S> scene(static_cast<std::uint64_t>(step),
                       SO3<double>::exp(radians(4.0 * step) * axis) * start);
    for (int k = 0; k < 3; ++k) {
      scene.add_plane(k, 600, 5);
      scene.add_lines(k, 6, 0.008);
    }
    scene.add_clutter_normals(600);
    scene.add_clutter_lines(10, 0.008);
    const auto estimate = track(scene, prior);
    REQUIRE(estimate.status == Status::kOk);
    REQUIRE(error_deg(estimate.cam_from_manhattan, scene.truth) < 2);
    prior.cam_from_manhattan = estimate.cam_from_manhattan;
  }
}

TEMPLATE_TEST_CASE("whatever the prior the answer is near it or is the prior itself", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(8);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    VoteScene<S> scene(seed, test::any_rotation(random));
    for (int k = 0; k < 3; ++k) {
      scene.add_plane(k, 800, 3);
      scene.add_lines(k, 8, 0.006);
    }
    ManhattanPrior<S> prior{test::any_rotation(random).cast<S>()};
    prior.covariance *= S(100);
    const auto estimate = track(scene, prior);
    const S turn = angle_between(estimate.cam_from_manhattan, prior.cam_from_manhattan);
    CHECK(turn <= radians(S(45)));
    if (estimate.status == Status::kNoConsensus) CHECK(turn == Approx(0).margin(2e-3));
    if (usable(estimate.status))
      CHECK(degrees(angle_between_frames(estimate.cam_from_manhattan, scene.truth.template cast<S>())) < 1);
  }
}

TEMPLATE_TEST_CASE("a limit on the jump is kept", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(9);
  VoteScene<S> scene(9, test::any_rotation(random));
  for (int k = 0; k < 3; ++k) scene.add_plane(k, 800, 2);
  const auto prior = prior_off_by<S>(scene.truth, random, 6);
  ManhattanOptions<S> options;
  CHECK(track(scene, prior, options).status == Status::kOk);
  options.max_jump = radians(S(4));
  const auto refused = track(scene, prior, options);
  CHECK(refused.status == Status::kNoConsensus);
  CHECK(angle_between(refused.cam_from_manhattan, prior.cam_from_manhattan) < S(1e-3));
  CHECK(refused.covariance == prior.covariance);
}

TEMPLATE_TEST_CASE("after an unseen turn about the one axis in view the next wall is met again", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double turn_deg = GENERATE(-38.0, -22.0, 17.0, 30.0);
  Random random(10);
  VoteScene<S> scene(10, test::any_rotation(random));
  scene.add_plane(1, 3000, 4);
  scene.add_plane(0, 3000, 4);
  scene.add_clutter_normals(1000);
  ManhattanPrior<S> prior;
  prior.cam_from_manhattan = (scene.truth * SO3<double>::exp({0, radians(turn_deg), 0})).template cast<S>();
  prior.covariance = Mat3<S>::Identity() * (radians(S(20)) * radians(S(20)));
  const auto estimate = track(scene, prior);
  CHECK(estimate.status == Status::kOk);
  CHECK(error_deg(estimate.cam_from_manhattan, scene.truth) < 1);
}

TEMPLATE_TEST_CASE("votes without structure near the prior are refused", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(11);
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    VoteScene<S> scene(seed, test::any_rotation(random));
    scene.add_clutter_normals(3000);
    scene.add_clutter_lines(60, 0.006);
    accepted += usable(track(scene, ManhattanPrior<S>{scene.truth.template cast<S>()}).status);
  }
  CHECK(accepted == 0);
}

TEMPLATE_TEST_CASE("odd inputs get a status and the prior", "[rotation]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  constexpr S kNan = std::numeric_limits<S>::quiet_NaN();
  Random random(12);
  VoteScene<S> scene(12, test::any_rotation(random));
  const auto prior = prior_off_by<S>(scene.truth, random, 3);
  const auto is_prior = [&prior](const ManhattanEstimate<S>& e) {
    return e.covariance == prior.covariance &&
           angle_between(e.cam_from_manhattan, prior.cam_from_manhattan) < S(1e-3);
  };

  SECTION("nothing") {
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kTooFew);
    CHECK(is_prior(estimate));
  }
  SECTION("one segment") {
    scene.add_lines(0, 1, 0.002);
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kNoConsensus);
    CHECK(estimate.axes_seen == 0);
    CHECK(is_prior(estimate));
  }
  SECTION("one normal") {
    scene.add_plane(0, 1, 0);
    const auto estimate = track(scene, prior);
    CHECK_FALSE(usable(estimate.status));
    CHECK(estimate.cam_from_manhattan.matrix().allFinite());
  }
  SECTION("all normals equal or two antipodal clusters") {
    const bool antipodal = GENERATE(false, true);
    for (int i = 0; i < 3000 && !antipodal; ++i) scene.add_normal(scene.truth.matrix().col(2));
    if (antipodal) scene.add_plane(2, 3000, 0);
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kDegenerate);
    CHECK(estimate.axes_seen == 1);
    const Vec3<double> axis = estimate.cam_from_manhattan.matrix().col(2).template cast<double>();
    CHECK(axis.dot(scene.truth.matrix().col(2)) > std::cos(radians(0.2)));
  }
  SECTION("zero vectors") {
    scene.x.assign(500, 0);
    scene.y = scene.z = scene.x;
    CHECK(track(scene, prior).status == Status::kTooFew);
  }
  SECTION("all normals NaN") {
    scene.x.assign(500, kNan);
    scene.y = scene.z = scene.x;
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kNotFinite);
    CHECK(is_prior(estimate));
  }
  SECTION("NaN normal") {
    scene.add_plane(0, 900, 2);
    scene.y[700] = kNan;
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kNotFinite);
    CHECK(is_prior(estimate));
  }
  SECTION("NaN segment") {
    scene.add_lines(0, 9, 0.01);
    scene.votes[4].sigma = kNan;
    CHECK(track(scene, prior).status == Status::kNotFinite);
    scene.votes[4].sigma = S(0.01);
    scene.votes[4].ray.x() = std::numeric_limits<S>::infinity();
    CHECK(is_prior(track(scene, prior)));
  }
  SECTION("vectors that are no directions") {
    scene.add_plane(0, 900, 2);
    scene.add_lines(0, 9, 0.01);
    const auto long_segment = GENERATE(false, true);
    (long_segment ? scene.votes[4].plane_normal.x() : scene.x[700]) = S(1e30);
    const auto estimate = track(scene, prior);
    CHECK(estimate.status == Status::kNotFinite);
    CHECK(is_prior(estimate));
  }
  SECTION("NaN or singular prior") {
    scene.add_plane(0, 900, 2);
    auto bad = prior;
    bad.covariance(1, 1) = kNan;
    CHECK(track(scene, bad).status == Status::kNotFinite);
    CHECK(track(scene, bad).cam_from_manhattan.matrix().allFinite());
    bad.covariance.setZero();
    CHECK(track(scene, bad).status == Status::kNotFinite);
    CHECK(track(scene, bad).cam_from_manhattan.matrix().allFinite());
  }
}

TEMPLATE_TEST_CASE("whatever the votes and the prior the answer is finite", "[rotation]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random draws(15);
  const auto good = test::corner<S>(15, test::any_rotation(draws), 300);
  const auto prior = prior_off_by<S>(good.truth, draws, 3);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const auto scene = good.spoiled(random);
    auto spoiled_prior = prior;
    if (seed % 3 == 0) testing::spoil<S>(std::span(&spoiled_prior, 1), 1, random);
    const auto estimate = track(scene, spoiled_prior);
    INFO("seed " << seed << ", " << name(estimate.status));
    CHECK(estimate.cam_from_manhattan.matrix().allFinite());
    if (usable(estimate.status)) CHECK(estimate.covariance.allFinite());
    if (estimate.status == Status::kNoConsensus)
      CHECK(estimate.cam_from_manhattan.matrix() == spoiled_prior.cam_from_manhattan.matrix());
  }
}

TEST_CASE("float normals serve a double kernel and equal input gives equal bits", "[rotation]") {
  Random random(13);
  VoteScene<float> scene(13, test::any_rotation(random));
  VoteScene<double> segments(13, scene.truth);
  for (int k = 0; k < 3; ++k) {
    scene.add_plane(k, 5000, 4);
    segments.add_lines(k, 10, 0.006);
  }
  segments.add_clutter_lines(10, 0.006);
  const auto prior = prior_off_by<double>(scene.truth, random, 5);
  std::array<std::int8_t, 40> axis_of;
  const auto a = track_manhattan<double>(scene.normals(), segments.lines(), prior, {}, axis_of);
  const auto b = track_manhattan<double>(scene.normals(), segments.lines(), prior);
  CHECK(a.status == Status::kOk);
  CHECK(error_deg(a.cam_from_manhattan, scene.truth) < 0.3);
  CHECK(a.cam_from_manhattan.matrix() == b.cam_from_manhattan.matrix());
  CHECK(a.covariance == b.covariance);
  CHECK(std::count(axis_of.begin(), axis_of.begin() + 30, std::int8_t(-1)) <= 3);
  for (int i = 0; i < 30; ++i) {
    const int axis = axis_of[static_cast<std::size_t>(i)];
    CHECK((axis == -1 || axis == i / 10));
  }
}
