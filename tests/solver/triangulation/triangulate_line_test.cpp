// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of lines: accuracy against the predicted covariance, known directions, epipolar planes,
// trimming.
#include <algorithm>
#include <limits>
#include <vector>

#include "solver/two_view/two_views.hpp"
#include "sslam/solver/triangulation/triangulate_line.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"

namespace sslam {
namespace {

// A segment seen in part by cameras that move sideways; each view draws its own noise and its own ends.
struct LineScene {
  Vec3<double> a, b;
  std::vector<LineView<double>> views;

  template <Scalar S>
  [[nodiscard]] std::vector<LineView<S>> as() const {
    std::vector<LineView<S>> out;
    for (const auto& v : views)
      out.push_back({v.cam_from_world.cast<S>(),
                     {v.segment.start.template cast<S>(), v.segment.end.template cast<S>()},
                     static_cast<S>(v.sigma)});
    return out;
  }
  [[nodiscard]] double distance(const Vec3<double>& x) const {
    return (x - a).cross((b - a).normalized()).norm();
  }
};

struct LineSceneOptions {
  int cameras = 3;
  double step = 0.5;      // metres between cameras, at a distance of about 4
  double noise = 1;       // pixels at a focal length of 500
  double far = 0;         // of the whole scene from the origin
  bool upright = false;   // along the y axis
  bool epipolar = false;  // line and motion in one plane
};

LineScene make_scene(const LineSceneOptions& o, std::uint64_t seed) {
  Random random(seed);
  const auto spread = [&](double limit) { return random.uniform(-limit, limit); };
  const Vec3<double> origin = o.far * Vec3<double>(1, -0.5, 0.7);
  LineScene scene;
  scene.a = {spread(1), spread(1), 4 + spread(1)};
  scene.b = scene.a + (o.upright ? Vec3<double>(0, 1, 0) : Vec3<double>(spread(0.6), 1, spread(0.6)));
  if (o.epipolar) {
    scene.a = {-0.5 + spread(0.3), 0, 4 + spread(1)};
    scene.b = {0.7 + spread(0.3), 0, 4 + spread(1)};
  }
  scene.a += origin;
  scene.b += origin;
  for (int i = 0; i < o.cameras; ++i) {
    SE3<double> pose;
    pose.rotation = SO3<double>::exp(0.1 * random_direction(random));
    const double wobble = o.epipolar ? 0 : 0.3 * o.step;
    const Vec3<double> centre = origin + Vec3<double>(o.step * i, spread(wobble), spread(wobble));
    pose.translation = -(pose.rotation * centre);
    const auto see = [&](const Vec3<double>& x) {
      const Vec3<double> y = pose * x;
      return Vec2<double>(y.head<2>() / y.z() + o.noise / 500 * gaussian_vector<2>(random));
    };
    Vec3<double> p = scene.a + random.uniform(0.0, 0.2) * (scene.b - scene.a);
    Vec3<double> q = scene.b - random.uniform(0.0, 0.2) * (scene.b - scene.a);
    if (random.below(2) == 0) std::swap(p, q);  // the direction of a segment is not to be relied on
    LineView<double> view;
    view.cam_from_world = pose;
    view.segment.start = see(p);
    view.segment.end = see(q);
    view.sigma = 1.0 / 500;
    scene.views.push_back(view);
  }
  return scene;
}

// Mean over the scenes of the squared error at the middle, across the line, over its covariance: 2 when
// exact.
struct LineScore {
  int ok = 0, low_parallax = 0;
  double chi2 = 0;
};

template <Scalar S>
LineScore score(const LineSceneOptions& o, bool along) {
  LineScore score;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const LineScene scene = make_scene(o, seed);
    const auto views = scene.as<S>();
    const auto answer =
        along ? triangulate_line_along<S>(views, Vec3<S>::UnitY()) : triangulate_line<S>(views);
    score.low_parallax += answer.status == Status::kLowParallax;
    if (!usable(answer.status)) continue;
    ++score.ok;
    const Vec3<double> d = answer.line.direction.template cast<double>();
    const Vec3<double> middle = ((answer.start + answer.end) / 2).template cast<double>();
    const Vec3<double> along_truth = (scene.b - scene.a).normalized();
    Vec3<double> error = middle - scene.a;
    error -= along_truth * along_truth.dot(error);
    error -= d * d.dot(error);
    const Mat3<double> c = answer.covariance.template cast<double>() + d * d.transpose();
    score.chi2 += error.dot(c.inverse() * error);
  }
  score.chi2 /= std::max(score.ok, 1);
  return score;
}

}  // namespace

TEMPLATE_TEST_CASE("line: exact views give the exact line", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double tolerance = std::is_same_v<S, float> ? 2e-3 : 1e-8;
  for (const int cameras : {2, 3, 6})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const LineScene scene = make_scene({.cameras = cameras, .noise = 0}, seed);
      const auto views = scene.as<S>();
      const auto answer = triangulate_line<S>(views);
      REQUIRE(usable(answer.status));
      CHECK(scene.distance(answer.start.template cast<double>()) < tolerance);
      CHECK(scene.distance(answer.end.template cast<double>()) < tolerance);
      CHECK((answer.line.point_closest_to(answer.start) - answer.start).norm() < S(1e-3));
      CHECK(std::abs(answer.line.direction.dot(answer.line.moment)) < S(1e-4));
    }
}

TEMPLATE_TEST_CASE("line: the error is as large as its covariance says", "", SSLAM_TEST_SCALARS) {
  for (const int cameras : {2, 3, 6})
    for (const double far : {0.0, 30.0}) {
      const LineScore s = score<TestType>({.cameras = cameras, .far = far}, false);
      CAPTURE(cameras, far, s.ok, s.chi2);
      CHECK(s.ok >= 150);
      CHECK(s.chi2 > 1.4);
      CHECK(s.chi2 < 2.8);
    }
}

TEMPLATE_TEST_CASE("line: a known direction needs less parallax", "", SSLAM_TEST_SCALARS) {
  const LineSceneOptions close{.cameras = 2, .step = 0.12, .upright = true};
  const LineScore open = score<TestType>(close, false), held = score<TestType>(close, true);
  CAPTURE(open.ok, held.ok, held.chi2);
  CHECK(open.ok <= 30);
  CHECK(held.ok >= 180);
  CHECK(held.chi2 > 1.4);
  CHECK(held.chi2 < 2.8);
}

TEMPLATE_TEST_CASE("line: a segment that does not follow the known direction is no consensus", "",
                   SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto views = make_scene({.upright = true}, seed).as<S>();
    CHECK(usable(triangulate_line_along<S>(views, Vec3<S>::UnitY()).status));
    CHECK(triangulate_line_along<S>(views, Vec3<S>(S(0.3), 1, 0)).status == Status::kNoConsensus);
  }
}

TEMPLATE_TEST_CASE("line: in an epipolar plane it is low parallax", "", SSLAM_TEST_SCALARS) {
  const LineScore exact = score<TestType>({.noise = 0, .epipolar = true}, false);
  CHECK(exact.ok == 0);
  CHECK(exact.low_parallax >= 195);
  CHECK(score<TestType>({.epipolar = true}, false).ok <= 2);
}

TEMPLATE_TEST_CASE("line: without a baseline it is low parallax", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto view = make_scene({.noise = 0}, 1).as<S>()[0];
  const std::vector<LineView<S>> same(3, view);
  CHECK(triangulate_line<S>(same).status == Status::kLowParallax);
  CHECK(triangulate_line_along<S>(same, Vec3<S>::UnitY()).status == Status::kLowParallax);
}

TEMPLATE_TEST_CASE("line: ends are trimmed to what the views show", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  // The line x = 0, z = 4; one view shows y in [-1, 0.5], the other [0, 1].
  std::vector<LineView<S>> views(2);
  views[0].segment = {{0, S(-0.25)}, {0, S(0.125)}};
  views[1].cam_from_world.translation = {-1, 0, 0};
  views[1].segment = {{S(-0.25), S(0.25)}, {S(-0.25), 0}};
  const auto answer = triangulate_line<S>(views);
  REQUIRE(usable(answer.status));
  const auto [low, high] = std::minmax(answer.start.y(), answer.end.y());
  CHECK(std::abs(low + 1) < S(1e-4));
  CHECK(std::abs(high - 1) < S(1e-4));
  CHECK(std::abs(answer.start.z() - 4) < S(1e-3));
  CHECK(std::abs(answer.overlap - S(0.5)) < S(1e-3));
  CHECK(std::abs(answer.parallax - std::atan(S(0.25))) < S(1e-4));
}

TEMPLATE_TEST_CASE("line: it runs the way that the first view shows it", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  int triangulated = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<LineView<S>> views = make_scene({.noise = 0.2}, seed).as<S>();
    for (const bool turned : {false, true}) {
      if (turned) std::swap(views[0].segment.start, views[0].segment.end);
      const Vec2<S> seen = views[0].segment.end - views[0].segment.start;
      for (const S sign : {S(1), S(-1)}) {
        const auto along = triangulate_line_along<S>(views, Vec3<S>(0, sign, 0));
        for (const auto& answer : {triangulate_line<S>(views), along}) {
          if (!usable(answer.status)) continue;
          ++triangulated;
          const auto project = [&](const Vec3<S>& x) {
            return Vec3<S>(views[0].cam_from_world * x).hnormalized().eval();
          };
          CHECK(seen.dot(project(answer.end) - project(answer.start)) > 0);
          CHECK(answer.line.direction.dot(answer.end - answer.start) > 0);
        }
      }
    }
  }
  CHECK(triangulated > 50);
}

TEMPLATE_TEST_CASE("line: behind the cameras", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  std::vector<LineView<S>> views(2);
  views[0].segment = {{S(-0.1), S(-0.2)}, {S(-0.1), S(0.2)}};
  views[1].cam_from_world.translation = {-1, 0, 0};  // to the right, and looks further to the right
  views[1].segment = {{S(0.1), S(-0.2)}, {S(0.1), S(0.2)}};
  CHECK(triangulate_line<S>(views).status == Status::kBehind);
}

TEMPLATE_TEST_CASE("line: absurdly long ends are refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  // A rail beside the track, seen to within a pixel of its vanishing point.
  std::vector<LineView<S>> views(2);
  const auto see = [](S camera_x, S z) { return Vec2<S>((1 - camera_x) / z, 1 / z); };
  for (int i = 0; i < 2; ++i) {
    const S x = S(0.8) * static_cast<S>(i);
    views[static_cast<std::size_t>(i)].cam_from_world.translation = {-x, 0, 0};
    views[static_cast<std::size_t>(i)].segment = {see(x, 2), see(x, 1000)};
    views[static_cast<std::size_t>(i)].sigma = S(1e-4);
  }
  const auto answer = triangulate_line<S>(views);
  CHECK(answer.status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("line: a view that disagrees is no consensus", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto views = make_scene({.cameras = 5, .noise = 0.5}, seed).as<S>();
    REQUIRE(usable(triangulate_line<S>(views).status));
    views[2].segment.start.x() += S(0.06);
    const auto answer = triangulate_line<S>(views);
    CHECK(!usable(answer.status));
    CHECK(answer.max_error > 3);
  }
}

TEMPLATE_TEST_CASE("line: bad input is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  CHECK(triangulate_line<S>(std::span<const LineView<S>>{}).status == Status::kTooFew);
  const auto good = make_scene({}, 1).as<S>();
  CHECK(triangulate_line<S>(std::span(good).first(1)).status == Status::kTooFew);
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    auto views = good;
    views[1].segment.end.y() = bad;
    CHECK(triangulate_line<S>(views).status == Status::kNotFinite);
    views = good;
    views[0].cam_from_world.translation.x() = bad;
    CHECK(triangulate_line<S>(views).status == Status::kNotFinite);
    CHECK(triangulate_line_along<S>(good, Vec3<S>(0, bad, 0)).status == Status::kNotFinite);
  }
  CHECK(triangulate_line_along<S>(good, Vec3<S>::Zero()).status == Status::kDegenerate);
  auto views = good;
  views[1].segment.end = views[1].segment.start;
  CHECK(triangulate_line<S>(views).status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("line: a view is made from pixels", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<S> pinhole{500, 510, 320, 240};
  const auto view = make_line_view<S>({}, pinhole, {{320, 240}, {S(370), S(291)}}, 2);
  CHECK(view.segment.start.norm() < S(1e-6));
  CHECK((view.segment.end - Vec2<S>(S(0.1), S(0.1))).norm() < S(1e-6));
  CHECK(std::abs(view.sigma - S(0.004)) < S(1e-6));
}

TEMPLATE_TEST_CASE("line: whatever the views an answer is finite", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto good = make_scene({.cameras = 8}, 1).as<S>();
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    INFO("seed " << seed);
    auto views = testing::spoiled<S>(good, random);
    if (views.size() > 500) views.resize(500);  // the parallax looks at every pair
    const Vec3<S> along(testing::any_number<S>(random), 1, 0);
    for (const auto& answer : {triangulate_line<S>(views), triangulate_line_along<S>(views, along)}) {
      if (!usable(answer.status)) continue;
      CHECK((answer.start.allFinite() && answer.end.allFinite() && answer.covariance.allFinite()));
      CHECK((answer.line.direction.allFinite() && answer.line.moment.allFinite()));
    }
  }
}

}  // namespace sslam
