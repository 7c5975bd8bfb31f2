// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/normals/depth_normals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

namespace {

Camera<double> depth_camera() {
  Camera<double> c;
  c.pinhole = {535.4, 539.2, 320.1, 247.6};
  c.width = 640;
  c.height = 480;
  return c;
}

struct Plane {
  Vec3<double> normal;  // unit, towards the camera
  double distance;      // of the camera from the plane, metres
};

double depth_at(const Plane& plane, const Vec2<double>& ray) {
  return -plane.distance / plane.normal.dot(Vec3<double>(ray.x(), ray.y(), 1));
}

// The depth map of a structured light sensor: disparity with noise, in steps of an eighth of a pixel, then in
// steps of a fifth of a millimetre. `plane_at(u, v)` says what a pixel sees.
cv::Mat sense(const Camera<double>& c, const std::function<const Plane*(int, int)>& plane_at, double noise) {
  constexpr double kFocalBaseline = 580 * 0.075;  // pixels times metres
  Random random(7);
  cv::Mat depth(c.height, c.width, CV_16U, cv::Scalar(0));
  for (int v = 0; v < c.height; ++v)
    for (int u = 0; u < c.width; ++u) {
      const Plane* plane = plane_at(u, v);
      if (plane == nullptr) continue;
      const Vec3<double> ray = c.pinhole.unproject(c.undistort_pixel(Vec2<double>(u, v)));
      double gauss = 0;
      for (int i = 0; i < 12; ++i) gauss += random.uniform(-0.5, 0.5);
      const double disparity = kFocalBaseline / depth_at(*plane, ray.head<2>()) + noise * gauss;
      const double z = kFocalBaseline / (std::round(disparity * 8) / 8);
      depth.at<std::uint16_t>(v, u) = cv::saturate_cast<std::uint16_t>(z * 5000);
    }
  return depth;
}

double angle_deg(const NormalField& field, std::size_t i, const Vec3<double>& normal) {
  const Vec3<double> n(field.x[i], field.y[i], field.z[i]);
  return degrees(std::acos(std::min(1.0, n.dot(normal))));
}

double median_error_deg(const NormalField& field, const Vec3<double>& normal) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < field.size(); ++i) errors.push_back(angle_deg(field, i, normal));
  REQUIRE(!errors.empty());
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

NormalField fill(const Camera<double>& c, const cv::Mat& depth) {
  DepthNormals source;
  ImageInput input;
  input.depth = depth;
  NormalField field;
  REQUIRE(source.fill(input, c, field) == NormalStatus::kOk);
  return field;
}

}  // namespace

TEST_CASE("normals of a noisy plane are good to a degree") {
  const double distance = GENERATE(0.8, 1.5, 2.5);
  const Plane plane{Vec3<double>(0.5, -0.3, -1).normalized(), distance};
  const NormalField field = fill(depth_camera(), sense(
                                                     depth_camera(), [&](int, int) { return &plane; }, 0.1));
  CHECK(field.size() > 2000);
  CHECK(median_error_deg(field, plane.normal) < 1);
  for (std::size_t i = 0; i < field.size(); ++i) {
    CHECK(std::abs(std::hypot(field.x[i], field.y[i], field.z[i]) - 1) < 1e-5);
    CHECK((field.weight[i] > 0 && field.weight[i] <= 1));
  }
}

TEST_CASE("no normal bridges a step in depth") {
  const Plane near{Vec3<double>(0.2, 0, -1).normalized(), 1.5},
      far{Vec3<double>(-0.3, 0.1, -1).normalized(), 2.5};
  const NormalField field = fill(
      depth_camera(), sense(
                          depth_camera(), [&](int u, int v) { return u + v / 3 < 380 ? &near : &far; }, 0.1));
  std::size_t wrong = 0, of_near = 0, of_far = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double a = angle_deg(field, i, near.normal), b = angle_deg(field, i, far.normal);
    of_near += a < 5;
    of_far += b < 5;
    wrong += std::min(a, b) > 6;
  }
  CHECK(of_near > 1000);
  CHECK(of_far > 700);
  CHECK(static_cast<double>(wrong) < 0.01 * static_cast<double>(field.size()));
}

TEST_CASE("holes cost only what they cover") {
  const Plane plane{Vec3<double>(-0.3, 0.4, -1).normalized(), 1.5};
  const NormalField field = fill(
      depth_camera(),
      sense(
          depth_camera(), [&](int u, int v) { return (u / 5 + v / 7) % 5 == 0 ? nullptr : &plane; }, 0.1));
  CHECK(field.size() > 2000);
  CHECK(median_error_deg(field, plane.normal) < 1);
}

TEST_CASE("a curved surface is no plane") {
  cv::Mat depth(480, 640, CV_32F);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      depth.at<float>(v, u) = static_cast<float>(1 + 0.08 * std::sin(u * 0.2) * std::sin(v * 0.2));
  CHECK(fill(depth_camera(), depth).size() < 50);
}

TEST_CASE("lens distortion is taken out of the normals") {
  Camera<double> c = depth_camera();
  c.distortion.k1 = 0.25;
  c.distortion.k2 = -0.3;
  const Plane plane{Vec3<double>(0.6, 0.3, -1).normalized(), 1.2};
  const NormalField field = fill(c, sense(
                                        c, [&](int, int) { return &plane; }, 0.05));
  CHECK(field.size() > 2000);
  CHECK(median_error_deg(field, plane.normal) < 1);
}

TEST_CASE("a depth map of half the size serves as well") {
  const Plane plane{Vec3<double>(0.5, -0.3, -1).normalized(), 1.2};
  Camera<double> half = depth_camera();
  half.width = 320;
  half.height = 240;
  half.pinhole = {267.7, 269.6, (320.1 + 0.5) / 2 - 0.5, (247.6 + 0.5) / 2 - 0.5};
  const NormalField field = fill(depth_camera(), sense(
                                                     half, [&](int, int) { return &plane; }, 0.05));
  CHECK(field.size() > 500);
  CHECK(median_error_deg(field, plane.normal) < 1);
}

TEST_CASE("unfit depth is refused and leaves no normals") {
  DepthNormals source;
  ImageInput input;
  NormalField field;
  field.push_back(0, 0, -1, 1);
  CHECK(source.fill(input, depth_camera(), field) == NormalStatus::kNoInput);
  CHECK(field.size() == 0);
  input.depth = cv::Mat(480, 500, CV_16U, cv::Scalar(5000));
  CHECK(source.fill(input, depth_camera(), field) == NormalStatus::kWrongSize);
  input.depth = cv::Mat(480, 640, CV_8UC3, cv::Scalar(1));
  CHECK(source.fill(input, depth_camera(), field) == NormalStatus::kWrongType);
  input.depth = cv::Mat(480, 640, CV_16U, cv::Scalar(20));  // 4 mm: somebody's factor is wrong
  CHECK(source.fill(input, depth_camera(), field) == NormalStatus::kOutOfRange);
  input.depth = cv::Mat(480, 640, CV_16U, cv::Scalar(0));
  CHECK(source.fill(input, depth_camera(), field) == NormalStatus::kOk);
  CHECK(field.size() == 0);
}

TEST_CASE("depth that is not finite counts as a hole") {
  cv::Mat depth(480, 640, CV_32F, cv::Scalar(1.5));
  depth(cv::Rect(0, 0, 320, 480)).setTo(std::numeric_limits<float>::quiet_NaN());
  depth(cv::Rect(320, 0, 40, 480)).setTo(std::numeric_limits<float>::infinity());
  const NormalField field = fill(depth_camera(), depth);
  CHECK(field.size() > 1000);
  CHECK(median_error_deg(field, {0, 0, -1}) < 1e-2);
}
