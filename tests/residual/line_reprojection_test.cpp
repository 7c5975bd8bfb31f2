// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/residual/line_reprojection.hpp"

#include "mutant_kills.hpp"
#include "residual_scene.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

Vec2<double> error_at(const ResidualScene& scene, const SE3<double>& pose, const Line3<double>& line) {
  LineReprojection<double> out;
  REQUIRE(line_reprojection(scene.pinhole, pose, line, scene.observed, out));
  return out.error;
}

Mat<double, 2, 6> numeric_line_pose(const ResidualScene& scene) {
  return numeric_jacobian([&](const SE3<double>& pose) { return error_at(scene, pose, scene.line()); },
                          scene.cam_from_world, 1e-4);
}

Mat<double, 2, 4> numeric_line(const ResidualScene& scene) {
  return numeric_jacobian(
      [&](const Line3<double>& line) { return error_at(scene, scene.cam_from_world, line); }, scene.line(),
      1e-4);
}

Vec<double, 1> endpoint_error_at(const ResidualScene& scene, const SE3<double>& pose,
                                 const Vec3<double>& end) {
  EndpointToLine<double> out;
  REQUIRE(endpoint_to_line(scene.pinhole, pose, end, line_through(scene.observed.start, scene.observed.end),
                           out));
  return Vec<double, 1>(out.error);
}

}  // namespace

TEST_CASE("line error is the distance of the observed ends from the projected line") {
  const Pinhole<double> k{500, 530, 320, 240};
  // A horizontal line at height 0.2 and depth 2 is seen at v = 293.
  const auto line = Line3<double>::from_points({-1, 0.2, 2}, {1, 0.2, 2});
  LineReprojection<double> out;
  REQUIRE(line_reprojection<double>(k, {}, line, {{100, 294}, {500, 290}}, out));
  CHECK(std::abs(std::abs(out.error[0]) - 1) < 1e-10);
  CHECK(std::abs(std::abs(out.error[1]) - 3) < 1e-10);
  CHECK(out.error[0] * out.error[1] < 0);
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const ResidualScene scene(random);
    REQUIRE(line_reprojection(scene.pinhole, scene.cam_from_world, scene.line(), scene.observed, out));
    const Vec3<double> l = project_line(scene.pinhole, transform(scene.cam_from_world, scene.line()));
    CHECK(std::abs(out.error[0] - l.dot(scene.observed.start.homogeneous())) < 1e-9);
    CHECK(std::abs(out.error[1] - l.dot(scene.observed.end.homogeneous())) < 1e-9);
  }
}

TEMPLATE_TEST_CASE("line Jacobians entry by entry", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double agree = std::is_same_v<S, float> ? 5e-3 : kAgree;
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const ResidualScene scene(random);
    const Pinhole<S> k{S(scene.pinhole.fx), S(scene.pinhole.fy), S(scene.pinhole.cx), S(scene.pinhole.cy)};
    const auto pose = scene.cam_from_world.cast<S>();
    const auto line = scene.line().cast<S>();
    LineReprojection<S> out;
    REQUIRE(line_reprojection<S>(k, pose, line,
                                 {scene.observed.start.cast<S>(), scene.observed.end.cast<S>()}, out));
    const auto numeric = numeric_line_pose(scene);
    const Mat<double, 2, 3> translation = numeric.rightCols<3>();
    CHECK(worst_entry(out.wrt_pose(), numeric, 1e-2).error < agree);
    CHECK(worst_entry(out.wrt_translation(), translation, 1e-2).error < agree);
    CHECK(worst_entry(out.wrt_line(pose, line), numeric_line(scene), 1e-2).error < agree);
  }
}

TEST_CASE("the comparison kills wrong line Jacobians") {
  Random random(3);
  MutantKills kill;
  for (int i = 0; i < 30; ++i) {
    const ResidualScene scene(random);
    LineReprojection<double> out;
    REQUIRE(line_reprojection(scene.pinhole, scene.cam_from_world, scene.line(), scene.observed, out));
    const Mat<double, 2, 6> truth = numeric_line_pose(scene), j = out.wrt_pose();
    for_each_mutant<double, 2, 6>(j, [&](const char* name, const auto& m) { kill(name, m, truth); });
    Mat<double, 2, 6> m = j;
    m.leftCols<3>() = -out.wrt_moment * hat(scene.line().moment);
    kill("moment in the world", m, truth);
    m = j;
    m.rightCols<3>() = -out.wrt_moment * hat(scene.line().direction);
    kill("direction in the world", m, truth);
    m = j;
    m.rightCols<3>() = -j.rightCols<3>();
    kill("sign of rho", m, truth);

    const Mat<double, 2, 4> line_truth = numeric_line(scene),
                            line_j = out.wrt_line(scene.cam_from_world, scene.line());
    for_each_mutant<double, 2, 4>(
        line_j, [&](const char* name, const auto& mutant) { kill(name, mutant, line_truth); });
    const Mat<double, 6, 4> update = scene.line().retract_jacobian();
    const Mat3<double> R = scene.cam_from_world.rotation.matrix();
    Mat<double, 2, 4> l = out.wrt_moment * R * update.topRows<3>();
    kill("dropped lever arm of the camera", l, line_truth);
    l = out.wrt_moment *
        (update.topRows<3>() + hat(scene.cam_from_world.translation) * update.bottomRows<3>());
    kill("dropped rotation", l, line_truth);
  }
  CHECK(kill.count() > 1000);
}

TEST_CASE("a line without an image has no error and leaves the output") {
  LineReprojection<double> out;
  out.error = {7, 8};
  const Pinhole<double> k{500, 530, 320, 240};
  const Segment2<double> segment{{1, 2}, {3, 4}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(
      line_reprojection<double>(k, {}, Line3<double>::from_points({0, 0, 1}, {0, 0, 2}), segment, out));
  CHECK_FALSE(
      line_reprojection<double>(k, {}, Line3<double>::from_points({0, 1, 0}, {1, 0, 0}), segment, out));
  CHECK_FALSE(line_reprojection<double>(k, {}, {{nan, 0, 0}, {1, 0, 0}}, segment, out));
  CHECK(out.error == Vec2<double>(7, 8));
}

TEST_CASE("distance of a projected end from the observed line with its Jacobians") {
  Random random(4);
  int killed = 0;
  for (int i = 0; i < 30; ++i) {
    const ResidualScene scene(random);
    EndpointToLine<double> out;
    const Vec3<double> observed = line_through(scene.observed.start, scene.observed.end);
    REQUIRE(endpoint_to_line(scene.pinhole, scene.cam_from_world, scene.start, observed, out));
    const Vec2<double> seen = scene.pinhole.project(scene.cam_from_world * scene.start);
    CHECK(std::abs(out.error - observed.dot(seen.homogeneous())) < 1e-10);
    const Mat<double, 1, 6> truth =
        numeric_jacobian([&](const SE3<double>& pose) { return endpoint_error_at(scene, pose, scene.start); },
                         scene.cam_from_world);
    CHECK(worst_entry(out.wrt_pose(), truth).error < kAgree);
    for_each_mutant<double, 1, 6>(out.wrt_pose(), [&](const char* name, const Mat<double, 1, 6>& mutant) {
      CAPTURE(name);
      CHECK(worst_entry(mutant, truth).error > kDiffer);
      ++killed;
    });
    // The row as printed in the paper has a surplus factor x in its third entry.
    const Vec3<double>& x = out.in_camera;
    const Vec3<double>& l = observed;
    const auto& k = scene.pinhole;
    Mat<double, 1, 6> by_hand = out.wrt_pose();
    by_hand[2] = -(k.fx * l.x() * x.y() - k.fy * l.y() * x.x()) / x.z();
    CHECK(worst_entry(by_hand, truth).error < kAgree);
    by_hand[2] *= x.x();
    CHECK(worst_entry(by_hand, truth).error > kDiffer);
  }
  CHECK(killed > 300);
  EndpointToLine<double> out;
  CHECK_FALSE(endpoint_to_line<double>(Pinhole<double>{}, {}, {0, 0, -1}, {1, 0, 0}, out));
}
