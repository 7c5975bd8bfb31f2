// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/ceres/camera_adjustment.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace camera_adjustment_test {
namespace {

using namespace sslam;
using namespace sslam::testing;

const Camera<double> kTrue{{525, 525, 319.5, 239.5}, {}, 640, 480};

// A map whose images came from kTrue, undistorted with another camera by mistake.
Map<double> make_map(std::vector<SE3<double>> path, const Camera<double>& given) {
  MapScene scene({.points = 1500, .lines = 150}, std::move(path));
  Map<double> map = scene.make_map();
  for (auto& kf : map.keyframes) {
    kf.frame.pinhole = given.pinhole;
    for (auto& f : kf.frame.points) f.pixel = given.undistort_pixel(f.pixel);
    for (auto& f : kf.frame.lines)
      f.segment = {given.undistort_pixel(f.segment.start), given.undistort_pixel(f.segment.end)};
  }
  return map;
}

// Turns and moves: a focal length shows in how much a turn shifts the image.
std::vector<SE3<double>> turning_path() {
  std::vector<SE3<double>> path;
  for (int k = 0; k < 24; ++k)
    path.push_back(look({1.5 * std::sin(0.3 * k), 0.3 * std::sin(0.9 * k), -1 + 0.8 * std::cos(0.3 * k)},
                        0.8 * std::sin(0.25 * k), 0.2 * std::sin(0.5 * k)));
  return path;
}

}  // namespace

TEST_CASE("A camera that is off is found from a map of points and lines, within its own error") {
  Camera<double> given = kTrue;
  const int kind = GENERATE(0, 1, 2);
  if (kind == 0) given.pinhole.fx = given.pinhole.fy = 1.05 * kTrue.pinhole.fx;
  if (kind == 1) given.distortion.k1 = 0.1;
  if (kind == 2) {
    given.pinhole = {480, 480, 326, 233};
    given.distortion.k1 = -0.05;
    given.distortion.k2 = 0.02;
  }
  CameraAdjustment adjustment;
  const CameraEstimate found = adjustment.estimate(make_map(turning_path(), given), given);
  REQUIRE(found.status == Status::kOk);
  LensChange<double> truth;
  truth << std::log(kTrue.pinhole.fx / given.pinhole.fx), kTrue.pinhole.cx - given.pinhole.cx,
      kTrue.pinhole.cy - given.pinhole.cy, -given.distortion.k1, -given.distortion.k2;
  for (int i = 0; i < kLensDof; ++i) {
    const double sigma = std::sqrt(found.covariance(i, i));
    INFO("unknown " << i << ": " << found.change[i] << " for " << truth[i] << ", sigma " << sigma);
    CHECK(std::abs(found.change[i] - truth[i]) < 4 * sigma);
  }
  CHECK(std::sqrt(found.covariance(0, 0)) < 0.005);
  CHECK(judge_camera(given, found) == CameraVerdict::kDiffers);
}

TEST_CASE("A camera that is right is left alone") {
  CameraAdjustment adjustment;
  const CameraEstimate found = adjustment.estimate(make_map(turning_path(), kTrue), kTrue);
  REQUIRE(found.status == Status::kOk);
  CHECK(judge_camera(kTrue, found) == CameraVerdict::kAgrees);
  CHECK(found.gain < 0.01);
}

TEST_CASE("Translation alone leaves the focal length open, and the prior stands") {
  // Depth times any factor, with the focal length times the same, shows the same images.
  std::vector<SE3<double>> path;
  for (int k = 0; k < 12; ++k) path.push_back(look({0.25 * k - 1.5, 0.1 * std::sin(1.0 * k), -2}, 0));
  Camera<double> given = kTrue;
  given.pinhole.fx = given.pinhole.fy = 1.05 * kTrue.pinhole.fx;
  CameraAdjustment adjustment;
  const CameraEstimate found = adjustment.estimate(make_map(path, given), given);
  REQUIRE(found.status == Status::kOk);
  CHECK(std::sqrt(found.covariance(0, 0)) > 0.5 * adjustment.options.prior.focal);
  CHECK(judge_camera(given, found) == CameraVerdict::kOpen);
}

TEST_CASE("A map without observations says nothing about its camera") {
  CameraAdjustment adjustment;
  const CameraEstimate found = adjustment.estimate(Map<double>(), kTrue);
  CHECK(found.status == Status::kTooFew);
  CHECK(found.camera.pinhole.fx == kTrue.pinhole.fx);
  CHECK(judge_camera(kTrue, found) == CameraVerdict::kOpen);
}

TEST_CASE("How much a camera differs does not count a shift of the whole image") {
  CameraEstimate other;
  other.camera = kTrue;
  other.camera.pinhole.cx += 5;
  CHECK(camera_shift(kTrue, other).pixels < 1e-9);
  other.camera = kTrue;
  other.camera.pinhole.fx *= 1.01;
  other.camera.pinhole.fy *= 1.01;
  const double radius = std::sqrt((640 * 640 + 480 * 480) / 12.0);  // of the image's places, root mean square
  CHECK(std::abs(camera_shift(kTrue, other).pixels / (0.01 * radius) - 1) < 0.02);
}

}  // namespace camera_adjustment_test
