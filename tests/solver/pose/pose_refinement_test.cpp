// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/pose/pose_refinement.hpp"

#include <array>
#include <limits>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// A camera somewhere in a cloud of points and lines, 1 to 6 m ahead, seen with noise of 1 pixel; a share of
// the matches is anywhere in the image.
template <class S>
struct PoseScene {
  Pinhole<S> pinhole{520, 530, 320, 240};
  SE3<S> truth;
  std::vector<PointObservation<S>> points;
  std::vector<LineObservation<S>> lines;
  std::vector<bool> point_is_good, line_is_good;
  std::vector<std::uint8_t> point_inliers, line_inliers;

  PoseScene(int point_count, int line_count, double outliers, double noise, std::uint64_t seed) {
    Random random(seed);
    const Pinhole<double> k{520, 530, 320, 240};
    Vec6<double> xi;
    for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-1.0, 1.0);
    const auto cam_from_world = SE3<double>::exp(xi);
    const auto pixel = [&] { return Vec2<double>{random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)}; };
    const auto world = [&](const Vec2<double>& p) -> Vec3<double> {
      return cam_from_world.inverse() * Vec3<double>(k.unproject(p) * random.uniform(1.0, 6.0));
    };
    const auto seen = [&](const Vec2<double>& p, bool good) -> Vec2<S> {
      return (good ? Vec2<double>(p + noise * gaussian_vector<2>(random)) : pixel()).template cast<S>();
    };
    truth = cam_from_world.template cast<S>();
    for (int i = 0; i < point_count; ++i) {
      const Vec2<double> p = pixel();
      point_is_good.push_back(random.uniform(0.0, 1.0) >= outliers);
      points.push_back({world(p).template cast<S>(), seen(p, point_is_good.back()), S(1)});
    }
    for (int i = 0; i < line_count; ++i) {
      const Vec2<double> p = pixel(), q = pixel();
      const bool good = random.uniform(0.0, 1.0) >= outliers;
      line_is_good.push_back(good);
      lines.push_back({Line3<double>::from_points(world(p), world(q)).template cast<S>(),
                       {seen(p, good), seen(q, good)},
                       S(1)});
    }
    point_inliers.resize(points.size());
    line_inliers.resize(lines.size());
  }

  // The truth turned by so much and moved by so much (metres) in random directions.
  [[nodiscard]] SE3<S> start(double degrees, double metres, std::uint64_t seed) const {
    Random random(seed);
    Vec6<double> xi;
    for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-1.0, 1.0);
    xi.head<3>() *= radians(degrees) / xi.head<3>().norm();
    xi.tail<3>() *= metres / xi.tail<3>().norm();
    return truth.retract(xi.template cast<S>());
  }
  auto refine(SE3<S>& pose, const PoseRefinementOptions<S>& options = {},
              const RotationPrior<S>* prior = nullptr) {
    return refine_pose<S>(pinhole, points, lines, pose, options, point_inliers, line_inliers, prior);
  }
  auto refine_position(SE3<S>& pose) {
    return refine_translation<S>(pinhole, points, lines, pose, {}, point_inliers, line_inliers);
  }
  [[nodiscard]] double position_error(const SE3<S>& pose) const {
    return static_cast<double>((pose.inverse().translation - truth.inverse().translation).norm());
  }
  [[nodiscard]] double degrees_off(const SE3<S>& pose) const {
    return degrees(static_cast<double>(angle_between(pose.rotation, truth.rotation)));
  }
};

template <class S>
bool same_pose(const SE3<S>& a, const SE3<S>& b) {
  return a.rotation.quaternion().coeffs() == b.rotation.quaternion().coeffs() &&
         a.translation == b.translation;
}

// Points in a row: a turn about it shows nowhere.
template <class S>
PoseScene<S> scene_of_one_row() {
  PoseScene<S> scene(12, 0, 0, 0, 5);
  for (int i = 0; i < 12; ++i) {
    const Vec3<S> x(S(-1.1) + S(0.2) * S(i), S(0.3), S(4));
    auto& point = scene.points[static_cast<std::size_t>(i)];
    point.point_world = scene.truth.inverse() * x;
    point.pixel = scene.pinhole.project(x);
  }
  return scene;
}

}  // namespace

TEMPLATE_TEST_CASE("exact observations give the exact pose", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double metres = std::is_same_v<S, float> ? 1e-3 : 1e-6;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const auto [points, lines] : {std::array{40, 0}, std::array{0, 40}, std::array{20, 20}}) {
      PoseScene<S> scene(points, lines, 0, 0, seed);
      auto pose = scene.start(10, 0.3, seed);
      const auto summary = scene.refine(pose);
      CAPTURE(seed, points, lines);
      CHECK(summary.status == Status::kOk);
      CHECK(scene.position_error(pose) < metres);
      CHECK(scene.degrees_off(pose) < 50 * metres);
      CHECK(summary.point_inliers == points);
      CHECK(summary.line_inliers == lines);
    }
  }
}

TEMPLATE_TEST_CASE("forty percent of gross mismatches are sorted out", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    PoseScene<S> scene(200, 60, 0.4, 0.7, seed);
    auto pose = scene.start(10, 0.4, seed + 100);
    const auto summary = scene.refine(pose);
    CAPTURE(seed);
    CHECK(summary.status == Status::kOk);
    CHECK(scene.position_error(pose) < 0.005);
    CHECK(scene.degrees_off(pose) < 0.1);
    int missed = 0, taken = 0;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      missed += scene.point_is_good[i] && !scene.point_inliers[i];
      taken += !scene.point_is_good[i] && scene.point_inliers[i];
    }
    for (std::size_t i = 0; i < scene.lines.size(); ++i) {
      missed += scene.line_is_good[i] && !scene.line_inliers[i];
      taken += !scene.line_is_good[i] && scene.line_inliers[i];
    }
    CHECK(missed <= 5);
    CHECK(taken <= 3);
  }
}

TEST_CASE("the information says how far the pose is off") {
  // With noise as stated, error^T information error has the mean of a chi-square with six degrees of freedom.
  double sum = 0;
  constexpr int kTrials = 100;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    PoseScene<double> scene(80, 20, 0, 1, seed);
    auto pose = scene.start(2, 0.05, seed);
    PoseRefinementOptions<double> options;
    options.gate = 25;
    options.huber = 5;
    const auto summary = scene.refine(pose, options);
    REQUIRE(summary.status == Status::kOk);
    const Vec6<double> error = (pose * scene.truth.inverse()).log();
    sum += error.dot(summary.information * error);
  }
  CHECK(sum / kTrials > 5);
  CHECK(sum / kTrials < 7);
}

TEST_CASE("gradient of the whole cost entry by entry") {
  PoseScene<double> scene(15, 8, 0.3, 2, 3);
  const auto pose = scene.start(3, 0.1, 4);
  Mat3<double> information;
  information << 900, 100, 0, 100, 400, -50, 0, -50, 1600;
  const RotationPrior<double> prior{scene.start(25, 0, 5).rotation, information};
  std::fill(scene.point_inliers.begin(), scene.point_inliers.end(), std::uint8_t{1});
  std::fill(scene.line_inliers.begin(), scene.line_inliers.end(), std::uint8_t{1});
  for (const double prior_width : {1e6, 2.0}) {
    const detail::PoseProblem<double> problem{
        scene.pinhole,      scene.points, scene.lines, scene.point_inliers,
        scene.line_inliers, &prior,       {2},         {prior_width}};
    const auto cost = [&](const auto& x) {
      NormalEquations<double, std::decay_t<decltype(x)>::kDof> unused;
      return Vec<double, 1>(problem(x, unused).cost);
    };
    NormalEquations<double, 6> equations;
    (void)problem(pose, equations);
    const Mat<double, 1, 6> slope = numeric_jacobian(cost, pose, 1e-5) / 2;
    CHECK(worst_entry(equations.g.transpose(), slope).error < 1e-5);
    // A prior whose derivative is taken for the identity shows this far from its mean.
    const Vec3<double> e = (pose.rotation * prior.cam_from_world.inverse()).log();
    const Vec3<double> pull = HuberLoss<double>{prior_width}.weight(e.dot(information * e)) * information * e;
    Mat<double, 1, 6> mutant = equations.g.transpose();
    mutant.leftCols<3>() += (pull - left_jacobian_inverse(e).transpose() * pull).transpose();
    CHECK(worst_entry(mutant, slope).error > 1e-4);

    NormalEquations<double, 3> position;
    const detail::TranslationState<double> state{pose};
    (void)problem(state, position);
    CHECK(worst_entry(position.g.transpose(), numeric_jacobian(cost, state, 1e-5) / 2).error < 1e-5);
  }
}

TEMPLATE_TEST_CASE("translation alone leaves the rotation", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PoseScene<S> scene(60, 20, 0.3, 0.5, seed);
    auto pose = scene.start(0, 0.5, seed);
    pose.rotation = scene.truth.rotation;
    const auto summary = scene.refine_position(pose);
    CHECK(summary.status == Status::kOk);
    CHECK(scene.position_error(pose) < 0.005);
    CHECK(pose.rotation.quaternion().coeffs() == scene.truth.rotation.quaternion().coeffs());
    CHECK(is_observable(summary.information));
  }
}

TEMPLATE_TEST_CASE("what the matches leave open is told and a prior closes it", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  auto scene = scene_of_one_row<S>();
  const auto start = scene.start(1, 0.02, 6);
  auto pose = start;
  CHECK(scene.refine(pose).status == Status::kDegenerate);
  CHECK(same_pose(pose, start));
  const RotationPrior<S> prior{scene.truth.rotation, Mat3<S>::Identity() * S(1e4)};
  CHECK(scene.refine(pose, {}, &prior).status == Status::kOk);
  CHECK(scene.degrees_off(pose) < 0.05);
  CHECK(scene.position_error(pose) < 0.01);
  // With the rotation known nothing is open.
  pose = {scene.truth.rotation, start.translation};
  CHECK(scene.refine_position(pose).status == Status::kOk);
}

TEMPLATE_TEST_CASE("lines of one direction leave the way along them open", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  PoseScene<S> scene(0, 10, 0, 0, 7);
  for (int i = 0; i < 10; ++i) {
    const Vec3<S> a(S(-1) + S(0.2) * S(i), S(-0.5), S(2 + i % 3)), b = a + Vec3<S>(0, 1, 0);
    auto& line = scene.lines[static_cast<std::size_t>(i)];
    const auto world_from_cam = scene.truth.inverse();
    line.line_world = Line3<S>::from_points(world_from_cam * a, world_from_cam * b);
    line.segment = {scene.pinhole.project(a), scene.pinhole.project(b)};
  }
  auto pose = scene.truth;
  CHECK(scene.refine_position(pose).status == Status::kDegenerate);
}

TEMPLATE_TEST_CASE("a wrong prior lets go", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  PoseScene<S> scene(100, 30, 0, 0.7, 8);
  const RotationPrior<S> wrong{scene.start(20, 0, 9).rotation, Mat3<S>::Identity() * S(1e4)};
  auto pose = scene.start(2, 0.05, 10);
  CHECK(scene.refine(pose, {}, &wrong).status == Status::kOk);
  CHECK(scene.degrees_off(pose) < 0.3);
  // A good one helps where the matches are poor.
  PoseScene<S> poor(6, 0, 0, 1, 11);
  const RotationPrior<S> good{poor.truth.rotation, Mat3<S>::Identity() * S(1e6)};
  auto alone = poor.start(2, 0.05, 12), helped = alone;
  CHECK(poor.refine(alone).status == Status::kOk);
  CHECK(poor.refine(helped, {}, &good).status == Status::kOk);
  CHECK(poor.degrees_off(helped) < poor.degrees_off(alone));
}

TEMPLATE_TEST_CASE("failure leaves the pose", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const S nan = std::numeric_limits<S>::quiet_NaN();
  const auto refuses = [](PoseScene<S> scene, const SE3<S>& start, Status status) {
    auto pose = start;
    CHECK(scene.refine(pose).status == status);
    CHECK(same_pose(pose, start));
    CHECK(scene.refine_position(pose).status == status);
    CHECK(same_pose(pose, start));
  };
  const PoseScene<S> scene(30, 10, 0, 0.5, 13);
  const auto start = scene.start(1, 0.02, 14);
  refuses(PoseScene<S>(1, 1, 0, 0, 15), start, Status::kTooFew);
  refuses(PoseScene<S>(0, 0, 0, 0, 15), start, Status::kTooFew);
  refuses(PoseScene<S>(0, 1, 0, 0, 15), start, Status::kTooFew);

  auto broken = scene;
  broken.points[3].pixel.x() = nan;
  refuses(broken, start, Status::kNotFinite);
  broken = scene;
  broken.points[3].point_world.z() = nan;
  refuses(broken, start, Status::kNotFinite);
  broken = scene;
  broken.points[3].sigma = 0;
  refuses(broken, start, Status::kNotFinite);
  broken = scene;
  broken.lines[3].line_world.moment.y() = std::numeric_limits<S>::infinity();
  refuses(broken, start, Status::kNotFinite);

  broken = scene;
  for (auto& point : broken.points) point.point_world = scene.truth.inverse() * Vec3<S>(0, 0, -2);
  broken.lines.clear();
  broken.line_inliers.clear();
  refuses(broken, start, Status::kTooFew);
  refuses(PoseScene<S>(40, 0, 1, 0, 16), start, Status::kNoConsensus);

  auto pose = start;
  pose.translation.x() = nan;
  auto whole = scene;
  CHECK(whole.refine(pose).status == Status::kNotFinite);
}

TEMPLATE_TEST_CASE("whatever the observations the pose is finite or as before", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const PoseScene<S> good(200, 60, 0.1, 0.7, 19);
  const auto start = good.start(1, 0.05, 20);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    INFO("seed " << seed);
    auto scene = good;
    scene.points = spoiled<S>(good.points, random);
    scene.lines = spoiled<S>(good.lines, random);
    scene.point_inliers.resize(scene.points.size());
    scene.line_inliers.resize(scene.lines.size());
    RotationPrior<S> prior{good.truth.rotation, Mat3<S>::Identity() * S(1e4)};
    if (seed % 2 == 0) spoil<S>(std::span(&prior, 1), 1, random);
    const auto holds = [&](Status status, const SE3<S>& pose) {
      INFO(name(status));
      CHECK((usable(status) ? pose.translation.allFinite() && pose.rotation.matrix().allFinite()
                            : same_pose(pose, start)));
    };
    auto pose = start;
    holds(scene.refine(pose, {}, &prior).status, pose);
    pose = start;
    holds(scene.refine_position(pose).status, pose);
  }
}

TEST_CASE("rounding costs no steps") {
  for (std::uint64_t seed = 21; seed < 26; ++seed) {
    PoseScene<float> coarse(200, 60, 0.1, 0.7, seed);
    PoseScene<double> fine(200, 60, 0.1, 0.7, seed);
    auto a = coarse.start(1, 0.05, seed);
    auto b = fine.start(1, 0.05, seed);
    const auto in_float = coarse.refine(a);
    const auto in_double = fine.refine(b);
    REQUIRE((usable(in_float.status) && usable(in_double.status)));
    CHECK(in_float.iterations <= in_double.iterations + 3);
  }
}

TEST_CASE("the same input gives the same bits") {
  PoseScene<double> scene(200, 60, 0.3, 0.7, 17);
  auto a = scene.start(5, 0.2, 18), b = a;
  CHECK(scene.refine(a).iterations == scene.refine(b).iterations);
  CHECK(same_pose(a, b));
}
