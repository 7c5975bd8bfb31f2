// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of points: accuracy against the predicted covariance, parallax, cheirality, disagreement.
#include <array>
#include <limits>
#include <vector>

#include "solver/two_view/two_views.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"

namespace sslam {
namespace {

// A point seen by cameras that move sideways and turn a little. far: distance of the whole scene from the
// origin.
struct PointScene {
  Vec3<double> point;
  std::vector<PointView<double>> views;

  template <Scalar S>
  [[nodiscard]] std::vector<PointView<S>> as() const {
    std::vector<PointView<S>> out;
    for (const auto& v : views)
      out.push_back({v.cam_from_world.cast<S>(), v.normalised.template cast<S>(), static_cast<S>(v.sigma)});
    return out;
  }
};

PointScene make_scene(int cameras, double step, double noise_px, std::uint64_t seed, double far = 0) {
  Random random(seed);
  PointScene scene;
  const Vec3<double> origin = far * Vec3<double>(1, -0.5, 0.7);
  scene.point =
      origin + Vec3<double>{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(2.0, 6.0)};
  for (int i = 0; i < cameras; ++i) {
    SE3<double> pose;
    pose.rotation = SO3<double>::exp(0.1 * random_direction(random));
    const Vec3<double> centre =
        origin + step * Vec3<double>{double(i), 0.3 * gaussian(random), 0.3 * gaussian(random)};
    pose.translation = -(pose.rotation * centre);
    const Vec3<double> x = pose * scene.point;
    Vec2<double> seen = x.head<2>() / x.z();
    for (int k = 0; k < 2; ++k) seen[k] += noise_px / 500 * gaussian(random);
    scene.views.push_back({pose, seen, 1.0 / 500});
  }
  return scene;
}

}  // namespace

TEMPLATE_TEST_CASE("point: exact views give the exact point", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (const int cameras : {2, 3, 8}) {
    const PointScene scene = make_scene(cameras, 0.3, 0, 5);
    const auto views = scene.as<S>();
    const auto answer = triangulate_point<S>(views);
    REQUIRE(usable(answer.status));
    const double error = (answer.point.template cast<double>() - scene.point).norm();
    CHECK(error < (std::is_same_v<S, float> ? 1e-4 : 1e-10));
    CHECK(answer.max_error < S(0.01));
  }
}

TEMPLATE_TEST_CASE("point: the error is as large as its covariance says", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (const int cameras : {2, 3, 8})
    for (const double far : {0.0, 50.0}) {
      double chi2 = 0;
      int ok = 0;
      for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const PointScene scene = make_scene(cameras, 0.3, 1, seed, far);
        const auto views = scene.as<S>();
        PointTriangulationOptions<S> options;
        options.max_error = 5;
        const auto answer = triangulate_point<S>(views, options);
        if (!usable(answer.status)) continue;
        ++ok;
        const Vec3<double> error = answer.point.template cast<double>() - scene.point;
        chi2 += error.dot(answer.covariance.template cast<double>().inverse() * error);
      }
      CAPTURE(cameras, far, ok, chi2 / ok);
      CHECK(ok >= 290);
      CHECK(chi2 / ok > 2.4);  // 3 when the covariance is exact
      CHECK(chi2 / ok < 3.8);
    }
}

TEMPLATE_TEST_CASE("point: two views agree with the general form", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const PointScene scene = make_scene(2, 0.4, 1, 7);
  const auto views = scene.as<S>();
  const SE3<S> step =
      (scene.views[1].cam_from_world * scene.views[0].cam_from_world.inverse()).template cast<S>();
  const BearingMatch<S> match{views[0].normalised.homogeneous(), views[1].normalised.homogeneous(),
                              views[0].sigma};
  const auto world = triangulate_point<S>(views);
  const auto camera = triangulate_point<S>(match, step);
  REQUIRE(usable(world.status));
  REQUIRE(usable(camera.status));
  CHECK((views[0].cam_from_world * world.point - camera.point).norm() < S(1e-3));
}

TEMPLATE_TEST_CASE("point: the parallax is the largest over all pairs", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  std::vector<PointView<S>> views;
  for (const S x : {S(0), S(0.3), S(1), S(0.5)}) {
    PointView<S> view;
    view.cam_from_world.translation = {-x, 0, 0};
    view.normalised = {-x / 2, 0};
    views.push_back(view);
  }
  const auto answer = triangulate_point<S>(views);
  CHECK(std::abs(answer.parallax - std::atan(S(0.5))) < S(1e-5));
  CHECK((answer.point - Vec3<S>(0, 0, 2)).norm() < S(1e-4));
}

TEMPLATE_TEST_CASE("point: parallel rays are low parallax", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const SE3<S> step{{}, {S(0.1), 0, 0}};
  const BearingMatch<S> infinite{Vec3<S>(S(0.2), S(0.1), 1), Vec3<S>(S(0.2), S(0.1), 1)};
  CHECK(triangulate_point<S>(infinite, step).status == Status::kLowParallax);
  const BearingMatch<S> far{Vec3<S>(S(0.2), S(0.1), 1), Vec3<S>(S(0.205), S(0.1), 1)};
  CHECK(triangulate_point<S>(far, step).status == Status::kLowParallax);
  const SE3<S> still;
  CHECK(triangulate_point<S>(infinite, still).status == Status::kLowParallax);
  PointTriangulationOptions<S> anything;
  anything.min_parallax = 0;
  CHECK(!usable(triangulate_point<S>(infinite, step, anything).status));
  CHECK(!usable(triangulate_point<S>(infinite, still, anything).status));
}

TEMPLATE_TEST_CASE("point: diverging rays meet behind the cameras", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const SE3<S> step{{}, {S(-0.5), 0, 0}};  // camera 1 stands to the right
  const BearingMatch<S> match{Vec3<S>(S(-0.1), 0, 1), Vec3<S>(S(0.1), 0, 1)};
  CHECK(triangulate_point<S>(match, step).status == Status::kBehind);
}

TEMPLATE_TEST_CASE("point: a view that disagrees is no consensus", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    auto views = make_scene(5, 0.3, 0.5, seed).as<S>();
    CHECK(usable(triangulate_point<S>(views).status));
    views[3].normalised.y() += S(0.04);  // 20 pixels across the baseline
    const auto answer = triangulate_point<S>(views);
    CHECK(answer.status == Status::kNoConsensus);
    CHECK(answer.max_error > 3);
  }
}

TEMPLATE_TEST_CASE("point: bad input is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  CHECK(triangulate_point<S>(std::span<const PointView<S>>{}).status == Status::kTooFew);
  const auto good = make_scene(3, 0.3, 0, 1).as<S>();
  CHECK(triangulate_point<S>(std::span(good).first(1)).status == Status::kTooFew);
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    auto views = good;
    views[1].normalised.x() = bad;
    CHECK(triangulate_point<S>(views).status == Status::kNotFinite);
    views = good;
    views[2].cam_from_world.translation.z() = bad;
    CHECK(triangulate_point<S>(views).status == Status::kNotFinite);
    CHECK(triangulate_point<S>(views).point.allFinite());
  }
  auto views = good;
  views[0].sigma = 0;
  CHECK(triangulate_point<S>(views).status == Status::kNotFinite);
}

TEMPLATE_TEST_CASE("point: whatever the views an answer is finite", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto good = make_scene(8, 0.3, 1, 1).as<S>();
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    INFO("seed " << seed);
    auto views = testing::spoiled<S>(good, random);
    if (views.size() > 500) views.resize(500);  // the parallax looks at every pair
    const auto answer = triangulate_point<S>(views);
    if (usable(answer.status)) CHECK((answer.point.allFinite() && answer.covariance.allFinite()));
  }
}

}  // namespace sslam
