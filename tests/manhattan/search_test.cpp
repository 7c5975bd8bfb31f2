// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sslam/manhattan/search.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"
#include "support/trials.hpp"
#include "vote_scene.hpp"

using namespace sslam;
using test::VoteScene;

namespace {

constexpr int kViews = testing::trials(200, 30);
constexpr int kFewViews = testing::trials(50, 10);  // where every view is searched in vain

struct Score {
  int accepted = 0, right = 0, wrong = 0;
};

// Scenes from `fill(scene)` in random orientations; right means within 5 degrees, up to the names of the
// axes.
template <Scalar S, class Fill>
Score search_everywhere(int views, Fill fill) {
  Random random(21);
  Score score;
  for (int view = 0; view < views; ++view) {
    const auto seed = static_cast<std::uint64_t>(view);
    VoteScene<S> scene(seed, test::any_rotation(random));
    fill(scene);
    const auto estimate = find_manhattan<S>(scene.normals(), scene.lines(), SearchOptions<S>{}, seed);
    if (!usable(estimate.status)) continue;
    ++score.accepted;
    const S off = angle_between_frames(estimate.cam_from_manhattan, scene.truth.template cast<S>());
    off < radians(S(5)) ? ++score.right : ++score.wrong;
  }
  return score;
}

}  // namespace

TEMPLATE_TEST_CASE("a frame is found from any orientation by normals of 15 degrees and cluttered segments",
                   "[search]", SSLAM_TEST_SCALARS) {
  const Score score = search_everywhere<TestType>(kViews, [](auto& scene) {
    for (int k = 0; k < 3; ++k) {
      scene.add_plane(k, 1000, 15);
      scene.add_lines(k, 15, 0.01);
    }
    scene.add_clutter_normals(700);
    scene.add_clutter_lines(45, 0.01);
  });
  CHECK(score.right == kViews);
}

TEST_CASE("a frame is found from any orientation by segments of which half are clutter", "[search]") {
  const Score score = search_everywhere<double>(kViews, [](auto& scene) {
    for (int k = 0; k < 3; ++k) scene.add_lines(k, 16, 0.01);
    scene.add_clutter_lines(48, 0.01);
  });
  CHECK(score.right >= kViews - 1);
  CHECK(score.wrong == 0);
}

TEST_CASE("a frame is found from any orientation by normals alone", "[search]") {
  const Score score = search_everywhere<float>(kViews, [](auto& scene) {
    scene.add_plane(0, 1500, 6);
    scene.add_plane(1, 1000, 6);
    scene.add_plane(2, 500, 6);
    scene.add_clutter_normals(1000);
  });
  CHECK(score.right == kViews);
}

TEST_CASE("a wall and segments along one other axis are enough", "[search]") {
  const Score score = search_everywhere<float>(kViews, [](auto& scene) {
    scene.add_plane(2, 2500, 4);
    scene.add_clutter_normals(500);
    scene.add_lines(1, 15, 0.008);
    scene.add_clutter_lines(15, 0.008);
  });
  CHECK(score.right >= kViews - 4);
  CHECK(score.wrong == 0);
}

TEMPLATE_TEST_CASE("no frame is found where there is none", "[search]", SSLAM_TEST_SCALARS) {
  const auto kind = GENERATE(0, 1, 2, 3);
  const Score score = search_everywhere<TestType>(kFewViews, [kind](auto& scene) {
    if (kind == 0) scene.add_clutter_lines(8, 0.004);
    if (kind == 1) scene.add_clutter_lines(80, 0.01);
    if (kind == 2) scene.add_clutter_normals(3000);
    if (kind == 3) {
      scene.add_clutter_normals(3000);
      scene.add_clutter_lines(40, 0.003);
    }
  });
  INFO("kind " << kind);
  CHECK(score.accepted == 0);
}

TEST_CASE("a column is no frame since all its turns are as good", "[search]") {
  // Normals all round an axis, and segments along it.
  const Score score = search_everywhere<double>(kFewViews, [](auto& scene) {
    const Mat3<double> axes = scene.truth.matrix();
    for (int i = 0; i < 3000; ++i) {
      const double turn = 2 * std::numbers::pi * i / 3000;
      scene.add_normal(std::cos(turn) * axes.col(0) + std::sin(turn) * axes.col(1) +
                       0.02 * test::gaussian_vector<3>(scene.random));
    }
    scene.add_lines(2, 20, 0.005);
  });
  CHECK(score.accepted == 0);
}

TEST_CASE("planes at 60 degrees and no two square are no frame", "[search]") {
  const Score score = search_everywhere<double>(kFewViews, [](auto& scene) {
    const Mat3<double> axes = scene.truth.matrix();
    const Vec3<double> second = 0.5 * axes.col(0) + std::sqrt(0.75) * axes.col(1);
    for (int i = 0; i < 1500; ++i) {
      scene.add_normal(axes.col(0) + 0.03 * test::gaussian_vector<3>(scene.random));
      scene.add_normal(second + 0.03 * test::gaussian_vector<3>(scene.random));
    }
  });
  CHECK(score.accepted == 0);
}

TEST_CASE("two frames in one view are reported as ambiguous", "[search]") {
  VoteScene<double> scene(5, SO3<double>());
  for (int k = 0; k < 3; ++k) scene.add_lines(k, 20, 0.005);
  const auto alone = find_manhattan<double>({}, scene.lines(), SearchOptions<double>{}, 1);
  const SO3<double> second = SO3<double>::exp({0.3, 0.4, 0.2});
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 3; ++k) {
      scene.truth = i % 2 == 0 ? SO3<double>() : second;
      scene.add_lines(k, 1, 0.004);  // sharper than those of the first frame alone
      scene.truth = second;
      scene.add_lines(k, 1, 0.004);
    }
  }
  const auto both = find_manhattan<double>({}, scene.lines(), SearchOptions<double>{}, 1);
  CHECK(alone.status == Status::kOk);
  CHECK(alone.ambiguity < 0.5);
  CHECK(both.ambiguity > 0.6);
}

TEST_CASE("the names are closest to the identity and segments get their axis", "[search]") {
  Random random(6);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    VoteScene<double> scene(seed, test::any_rotation(random));
    for (int k = 0; k < 3; ++k) scene.add_lines(k, 20, 0.005);
    std::array<std::int8_t, 60> axis_of;
    const auto estimate = find_manhattan<double>({}, scene.lines(), SearchOptions<double>{}, seed, axis_of);
    REQUIRE(estimate.status == Status::kOk);
    CHECK(angle_between(closest_naming(estimate.cam_from_manhattan, SO3<double>()),
                        estimate.cam_from_manhattan) < 1e-6);
    int wrong = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      if (axis_of[i] < 0) continue;
      const Vec3<double> named = estimate.cam_from_manhattan.matrix().col(axis_of[i]);
      const auto own = static_cast<int>(i / 20);
      wrong += std::abs(named.dot(scene.truth.matrix().col(own))) < 0.9;
    }
    CHECK(wrong <= 4);
  }
}

TEST_CASE("a single plane or a single direction of segments is degenerate", "[search]") {
  Random random(7);
  VoteScene<double> wall(7, test::any_rotation(random));
  wall.add_plane(0, 3000, 3);
  const auto by_normals = find_manhattan<double>(wall.normals(), wall.lines(), SearchOptions<double>{}, 1);
  CHECK(by_normals.status == Status::kDegenerate);
  VoteScene<double> columns(8, test::any_rotation(random));
  columns.add_lines(1, 40, 0.004);
  const auto by_lines =
      find_manhattan<double>(columns.normals(), columns.lines(), SearchOptions<double>{}, 1);
  CHECK(by_lines.status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("one direction alone is degenerate for the search", "[search]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(14);
  const auto kind = GENERATE(0, 1, 2);
  VoteScene<S> scene(14, test::any_rotation(random));
  for (int i = 0; i < 3000 && kind == 0; ++i) scene.add_normal(scene.truth.matrix().col(2));
  if (kind == 1) scene.add_plane(2, 3000, 0);  // two antipodal clusters
  if (kind == 2) scene.add_lines(0, 1, 0.002);
  INFO("kind " << kind);
  const auto estimate = find_manhattan<S>(scene.normals(), scene.lines(), SearchOptions<S>{}, 1);
  CHECK(estimate.status == (kind == 2 ? Status::kTooFew : Status::kDegenerate));
  CHECK(estimate.cam_from_manhattan.matrix().allFinite());
}

TEMPLATE_TEST_CASE("the search refuses odd inputs", "[search]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const SearchOptions<S> options;
  VoteScene<S> scene(9, SO3<double>());
  CHECK(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status == Status::kTooFew);
  scene.add_lines(0, 2, 0.01);
  CHECK(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status == Status::kTooFew);
  scene.votes.assign(50, scene.votes[0]);  // fifty times the same segment
  CHECK_FALSE(usable(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status));
  scene.votes[20].plane_normal.z() = std::numeric_limits<S>::quiet_NaN();
  CHECK(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status == Status::kNotFinite);
  scene.votes.clear();
  scene.add_plane(0, 10, 0);
  CHECK_FALSE(usable(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status));
  scene.x[3] = std::numeric_limits<S>::infinity();
  const auto estimate = find_manhattan<S>(scene.normals(), scene.lines(), options, 1);
  CHECK(estimate.status == Status::kNotFinite);
  CHECK(estimate.cam_from_manhattan.matrix().allFinite());
  scene.x[3] = S(1e30);  // a number, but in float its square is none
  CHECK(find_manhattan<S>(scene.normals(), scene.lines(), options, 1).status == Status::kNotFinite);
}

TEMPLATE_TEST_CASE("whatever the votes the search answers with a finite rotation", "[search]",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random draws(15);
  const auto good = test::corner<S>(15, test::any_rotation(draws), 100);
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    Random random(seed);
    const auto scene = good.spoiled(random);
    const auto estimate = find_manhattan<S>(scene.normals(), scene.lines(), SearchOptions<S>{}, seed);
    INFO("seed " << seed << ", " << name(estimate.status));
    CHECK(estimate.cam_from_manhattan.matrix().allFinite());
    if (usable(estimate.status)) CHECK(estimate.covariance.allFinite());
  }
}

TEMPLATE_TEST_CASE("a handful of random normals is no frame", "[search]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    VoteScene<S> scene(seed, SO3<double>());
    scene.add_clutter_normals(2 + static_cast<int>(seed % 20));
    accepted += usable(find_manhattan<S>(scene.normals(), {}, SearchOptions<S>{}, seed).status);
  }
  CHECK(accepted == 0);
}

TEST_CASE("the same seed gives the same bits", "[search]") {
  Random random(10);
  VoteScene<float> scene(10, test::any_rotation(random));
  for (int k = 0; k < 3; ++k) {
    scene.add_plane(k, 1000, 8);
    scene.add_lines(k, 10, 0.01);
  }
  const auto a = find_manhattan<float>(scene.normals(), scene.lines(), SearchOptions<float>{}, 3);
  const auto b = find_manhattan<float>(scene.normals(), scene.lines(), SearchOptions<float>{}, 3);
  CHECK(a.cam_from_manhattan.matrix() == b.cam_from_manhattan.matrix());
  CHECK(a.log_likelihood == b.log_likelihood);
}
