// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "sslam/manhattan/line_circles.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"
#include "vote_scene.hpp"

using namespace sslam;

TEMPLATE_TEST_CASE("the sigma of a line vote is the turn of its plane", "[votes]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<double> pinhole{480, 480, 320, 240};
  const Segment2<double> segment{{400, 120}, {470, 200}};
  const auto exact = line_vote(segment, pinhole, 0.5);
  CHECK(exact.plane_normal.dot(pinhole.unproject(segment.start)) == Approx(0).margin(1e-12));
  CHECK(exact.plane_normal.dot(pinhole.unproject(segment.end)) == Approx(0).margin(1e-12));
  CHECK(exact.ray.dot(exact.plane_normal) == Approx(0).margin(1e-12));

  const Segment2<S> same{segment.start.cast<S>(), segment.end.cast<S>()};
  const Pinhole<S> camera{S(480), S(480), S(320), S(240)};
  const auto vote = line_vote(same, camera, S(0.5));
  CHECK((vote.plane_normal.template cast<double>() - exact.plane_normal).norm() < 1e-4);

  // Monte Carlo: endpoints moved across the segment; the turn is measured about the ray.
  Random random(1);
  const Vec2<double> d = segment.direction();
  const Vec2<double> across(-d.y(), d.x());
  const Vec3<double> side = exact.ray.cross(exact.plane_normal);
  double squares = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const Vec2<double> start = segment.start + 0.5 * test::gaussian(random) * across;
    const Segment2<double> moved{start, segment.end + 0.5 * test::gaussian(random) * across};
    const double turn = line_vote(moved, pinhole, 0.5).plane_normal.dot(side);
    squares += turn * turn;
  }
  // The formula takes the pixel at the principal point; obliquely its angle is smaller.
  CHECK(std::sqrt(squares / kTrials) == Approx(exact.sigma).epsilon(0.15));
}

TEST_CASE("a segment of no length is a vote without NaN or weight", "[votes]") {
  const Pinhole<double> pinhole{480, 480, 320, 240};
  const auto vote = line_vote(Segment2<double>{{100, 100}, {100, 100}}, pinhole, 1.0);
  CHECK(vote.plane_normal.allFinite());
  CHECK(std::isfinite(vote.sigma));
  CHECK(vote.sigma > 100);
}

TEST_CASE("over segments in any direction the likelihood ratio has mean one", "[votes]") {
  // What lets exp(-score) bound the odds of chance.
  Random random(4);
  test::VoteScene<double> scene(4, test::any_rotation(random));
  scene.add_clutter_lines(40000, 0.1);
  const Mat3<double> axes = scene.truth.matrix();
  Vec3<double> sum = Vec3<double>::Zero();
  for (const auto& line : scene.votes) sum += detail::LineLikelihood<double>(line, axes, 0.02).ratio;
  for (int k = 0; k < 3; ++k) CHECK(sum[k] / 40000 == Approx(1).epsilon(0.1));
}

TEMPLATE_TEST_CASE("segments are told apart by axis and clutter is left out", "[votes]", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(6);
  test::VoteScene<S> scene(6, test::any_rotation(random));
  scene.add_clutter_lines(60, 0.004);
  for (int axis = 0; axis < 3; ++axis) scene.add_lines(axis, 20, 0.004);
  const Mat3<S> frame = scene.truth.template cast<S>().matrix();
  LineShares<S> shares;
  for (int i = 0; i < 5; ++i)
    shares = update_shares(weigh_lines(scene.lines(), frame, shares, S(0.001)), scene.votes.size());
  std::array<std::int8_t, 120> axis_of;
  assign_lines(scene.lines(), frame, shares, S(0.001), {true, true, true}, std::span<std::int8_t>(axis_of));
  int wrong = 0;
  int clutter = 0;
  for (int i = 0; i < 60; ++i) {
    clutter += axis_of[static_cast<std::size_t>(i)] >= 0;
    const int expected = i / 20;
    const int got = axis_of[static_cast<std::size_t>(60 + i)];
    wrong += got != expected;
  }
  CHECK(wrong <= 4);
  CHECK(clutter <= 6);
  assign_lines(scene.lines(), frame, shares, S(0.001), {true, false, true}, std::span<std::int8_t>(axis_of));
  for (const std::int8_t axis : axis_of) CHECK(axis != 1);
}

TEST_CASE("the pull of segments is the gradient of their cost", "[votes]") {
  Random random(8);
  test::VoteScene<double> scene(8, test::any_rotation(random));
  scene.add_lines(1, 1, 0.01);
  const Mat3<double> frame = (SO3<double>::exp({0.01, 0.02, -0.01}) * scene.truth).matrix();
  const LineShares<double> shares;
  const auto round = weigh_lines(scene.lines(), frame, shares, 0.005);
  // Cost of moving axis 1 by (d_2, d_0) with the weight held: 1/2 w r^2.
  const Vec3<double> n = frame.transpose() * scene.votes[0].plane_normal;
  const double weight = round.systems[1].H(0, 0) / (n[2] * n[2]);
  const auto cost = [&](double along2, double along0) {
    const double r = n[1] + along2 * n[2] + along0 * n[0];
    return 0.5 * weight * r * r;
  };
  constexpr double kStep = 1e-5;
  CHECK(round.systems[1].g[0] == Approx((cost(kStep, 0) - cost(-kStep, 0)) / (2 * kStep)).epsilon(1e-6));
  CHECK(round.systems[1].g[1] == Approx((cost(0, kStep) - cost(0, -kStep)) / (2 * kStep)).epsilon(1e-6));
}
