// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/residual/lens_reprojection.hpp"

#include <limits>

#include "residual_scene.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"

namespace lens_reprojection_test {
namespace {

using namespace sslam;
using namespace sslam::testing;

// A scene as a lens with all its coefficients shows it.
struct LensScene : ResidualScene {
  Camera<double> camera;
  Segment2<double> raw;

  explicit LensScene(Random& random) : ResidualScene(random) {
    camera.pinhole = pinhole;
    camera.distortion = {random.uniform(-0.2, 0.2), random.uniform(-0.05, 0.05), 0.002, -0.003, 0.01};
    camera.width = 640;
    camera.height = 480;
    raw = {camera.distort_pixel(observed.start), camera.distort_pixel(observed.end)};
  }
};

using Change = Euclidean<double, kLensDof>;

Vec2<double> point_error(const LensScene& scene, const Camera<double>& camera, const SE3<double>& pose,
                         const Vec3<double>& point) {
  PointReprojection<double> out;
  REQUIRE(lens_point_reprojection(camera, pose, point, scene.raw.start, out));
  return out.error;
}

Vec2<double> line_error(const LensScene& scene, const Camera<double>& camera, const SE3<double>& pose,
                        const Line3<double>& line) {
  LineReprojection<double> out;
  REQUIRE(lens_line_reprojection(camera, pose, line, scene.raw, out));
  return out.error;
}

}  // namespace

TEST_CASE("Without distortion the errors through a lens are those of the pinhole") {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const ResidualScene scene(random);
    const Camera<double> camera{scene.pinhole, {}, 640, 480};
    PointReprojection<double> point, plain_point;
    REQUIRE(lens_point_reprojection(camera, scene.cam_from_world, scene.start, scene.observed.start, point));
    REQUIRE(point_reprojection(scene.pinhole, scene.cam_from_world, scene.start, scene.observed.start,
                               plain_point));
    CHECK((point.error - plain_point.error).norm() < 1e-10);
    LineReprojection<double> line, plain_line;
    REQUIRE(lens_line_reprojection(camera, scene.cam_from_world, scene.line(), scene.observed, line));
    REQUIRE(line_reprojection(scene.pinhole, scene.cam_from_world, scene.line(), scene.observed, plain_line));
    CHECK((line.error - plain_line.error).norm() < 1e-9);
  }
}

TEST_CASE("A line is straight where the distortion has been taken out, and has no error there") {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    LensScene scene(random);
    const Pinhole<double>& k = scene.pinhole;
    scene.raw = {scene.camera.distort_pixel(k.project(scene.cam_from_world * scene.start)),
                 scene.camera.distort_pixel(k.project(scene.cam_from_world * scene.end))};
    CHECK(line_error(scene, scene.camera, scene.cam_from_world, scene.line()).norm() < 1e-6);
    CHECK(point_error(scene, scene.camera, scene.cam_from_world, scene.start).norm() < 1e-9);
  }
}

TEST_CASE("Derivatives through a lens, by camera, pose and landmark, entry by entry") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const LensScene scene(random);
    const SE3<double>& pose = scene.cam_from_world;
    const Change at{LensChange<double>(0.02, 3, -2, 0.01, 0.005)};
    const Camera<double> camera = changed(scene.camera, at.value);
    // By the change itself: its first entry is a logarithm, the others add up.
    Mat<double, 2, kLensDof> by_camera;
    PointReprojection<double> point;
    REQUIRE(lens_point_reprojection(camera, pose, scene.start, scene.raw.start, point, &by_camera));
    const auto point_by_camera = numeric_jacobian(
        [&](const Change& c) {
          return point_error(scene, changed(scene.camera, c.value), pose, scene.start);
        },
        at, 1e-4);
    CHECK(worst_entry(by_camera, point_by_camera, 1e-2).error < 1e-5);
    const auto point_by_pose = numeric_jacobian(
        [&](const SE3<double>& p) { return point_error(scene, camera, p, scene.start); }, pose, 1e-4);
    CHECK(worst_entry(point.wrt_pose(), point_by_pose, 1e-2).error < 1e-5);
    LineReprojection<double> line;
    REQUIRE(lens_line_reprojection(camera, pose, scene.line(), scene.raw, line, &by_camera));
    const auto line_by_camera = numeric_jacobian(
        [&](const Change& c) {
          return line_error(scene, changed(scene.camera, c.value), pose, scene.line());
        },
        at, 1e-4);
    CHECK(worst_entry(by_camera, line_by_camera, 1e-2).error < 1e-4);
    const auto line_by_pose = numeric_jacobian(
        [&](const SE3<double>& p) { return line_error(scene, camera, p, scene.line()); }, pose, 1e-4);
    CHECK(worst_entry(line.wrt_pose(), line_by_pose, 1e-2).error < 1e-5);
    const auto by_line = numeric_jacobian(
        [&](const Line3<double>& l) { return line_error(scene, camera, pose, l); }, scene.line(), 1e-4);
    CHECK(worst_entry(line.wrt_line(pose, scene.line()), by_line, 1e-2).error < 1e-5);
  }
}

TEST_CASE("What a lens cannot see has no error: behind the camera, through its centre, not finite") {
  const Camera<double> camera{{500, 500, 320, 240}, {-0.1, 0, 0, 0, 0}, 640, 480};
  PointReprojection<double> point;
  CHECK_FALSE(lens_point_reprojection(camera, {}, {0, 0, -1}, {0, 0}, point));
  CHECK_FALSE(
      lens_point_reprojection(camera, {}, {0, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 0}, point));
  LineReprojection<double> line;
  const auto through_centre = Line3<double>::from_points({0, 0, 1}, {0, 0, 2});
  CHECK_FALSE(lens_line_reprojection(camera, {}, through_centre, {{100, 100}, {200, 100}}, line));
}

}  // namespace lens_reprojection_test
