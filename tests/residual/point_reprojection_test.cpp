// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/residual/point_reprojection.hpp"

#include <limits>

#include "mutant_kills.hpp"
#include "residual_scene.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

template <class S>
PointReprojection<S> evaluate(const ResidualScene& scene) {
  PointReprojection<S> out;
  const Pinhole<S> k{S(scene.pinhole.fx), S(scene.pinhole.fy), S(scene.pinhole.cx), S(scene.pinhole.cy)};
  REQUIRE(point_reprojection<S>(k, scene.cam_from_world.cast<S>(), scene.start.cast<S>(),
                                scene.observed.start.cast<S>(), out));
  return out;
}

Vec2<double> error_at(const ResidualScene& scene, const SE3<double>& pose, const Vec3<double>& point) {
  PointReprojection<double> out;
  REQUIRE(point_reprojection(scene.pinhole, pose, point, scene.observed.start, out));
  return out.error;
}

Mat<double, 2, 6> numeric_point_pose(const ResidualScene& scene) {
  return numeric_jacobian([&](const SE3<double>& pose) { return error_at(scene, pose, scene.start); },
                          scene.cam_from_world);
}

}  // namespace

TEST_CASE("point error is observed minus projected in pixels") {
  const Pinhole<double> k{500, 530, 320, 240};
  const SE3<double> pose{{}, {0, 0, 1}};
  PointReprojection<double> out;
  REQUIRE(point_reprojection(k, pose, {0.5, 0.1, 1}, {450, 260}, out));
  CHECK((out.error - Vec2<double>(450 - (320 + 125), 260 - (240 + 26.5))).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("point Jacobians entry by entry", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const double agree = std::is_same_v<S, float> ? 2e-3 : kAgree;
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const ResidualScene scene(random);
    const auto out = evaluate<S>(scene);
    const auto pose = numeric_point_pose(scene);
    const Mat<double, 2, 3> translation = pose.rightCols<3>();
    const auto point = numeric_jacobian(
        [&](const Euclidean<double, 3>& p) { return error_at(scene, scene.cam_from_world, p.value); },
        Euclidean<double, 3>{scene.start});
    const Mat3<S> R = scene.cam_from_world.rotation.matrix().cast<S>();
    CHECK(worst_entry(out.wrt_pose(), pose, 1e-2).error < agree);
    CHECK(worst_entry(out.wrt_translation(), translation, 1e-2).error < agree);
    CHECK(worst_entry(out.wrt_point(R), point, 1e-2).error < agree);
  }
}

TEST_CASE("the comparison kills wrong point Jacobians") {
  Random random(2);
  MutantKills kill;
  for (int i = 0; i < 30; ++i) {
    const ResidualScene scene(random);
    const auto out = evaluate<double>(scene);
    const Mat<double, 2, 6> truth = numeric_point_pose(scene), j = out.wrt_pose();
    for_each_mutant<double, 2, 6>(j, [&](const char* name, const auto& m) { kill(name, m, truth); });
    const Mat3<double> R = scene.cam_from_world.rotation.matrix();
    Mat<double, 2, 6> m = -j;
    kill("predicted minus observed", m, truth);
    m << j.rightCols<3>(), j.leftCols<3>();
    kill("translation first", m, truth);
    m = j;
    m.leftCols<3>() = -j.leftCols<3>();
    kill("sign of phi", m, truth);
    m.leftCols<3>() = -out.wrt_camera_point * hat(scene.start);
    kill("lever arm in the world", m, truth);
    m.leftCols<3>() = -out.wrt_camera_point * R * hat(scene.start);
    m.rightCols<3>() = out.wrt_camera_point * R;
    kill("perturbed on the right", m, truth);
    Mat<double, 2, 3> p = out.wrt_camera_point;
    const Mat<double, 2, 3> by_point = out.wrt_point(R);
    kill("dropped rotation", p, by_point);
    p = out.wrt_camera_point * R.transpose();
    kill("inverse rotation", p, by_point);
  }
  CHECK(kill.count() > 1000);
}

TEMPLATE_TEST_CASE("a point behind the camera has no error and leaves the output", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const Pinhole<S> k{500, 530, 320, 240};
  PointReprojection<S> out;
  out.error = {7, 8};
  for (const S z : {S(-1), S(0), kMinDepth<S>, std::numeric_limits<S>::quiet_NaN()})
    CHECK_FALSE(point_reprojection<S>(k, {}, {0, 0, z}, {0, 0}, out));
  CHECK(out.error == Vec2<S>(7, 8));
}
