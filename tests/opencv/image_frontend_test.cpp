// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/image_frontend.hpp"

#include <algorithm>
#include <cmath>

#include "sslam/opencv/normals/depth_normals.hpp"
#include "support/catch.hpp"
#include "synthetic_image.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

constexpr int kWidth = 640, kHeight = 480;

Camera<double> frontend_camera() {
  Camera<double> c;
  c.pinhole = {500, 510, 322, 237};
  c.width = kWidth;
  c.height = kHeight;
  return c;
}

ImageInput scene() {
  ImageInput input;
  input.index = 42;
  input.stamp = 1.5;
  input.image = draw_box({kWidth, kHeight}, {180, 120}, {450, 330}, 0.2, 190, 70);
  draw_texture({160, 140}, 40, 1).copyTo(input.image(cv::Rect(230, 160, 160, 140)));
  input.depth = cv::Mat(kHeight, kWidth, CV_16U, cv::Scalar(7500));
  return input;
}

bool same(const Frame<double>& a, const Frame<double>& b) {
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const auto& p, const auto& q) {
                      return p.pixel == q.pixel && p.descriptor == q.descriptor;
                    }) &&
         std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(), b.lines.end(),
                    [](const auto& p, const auto& q) {
                      return p.segment.start == q.segment.start && p.segment.end == q.segment.end &&
                             p.descriptor == q.descriptor;
                    }) &&
         a.normals.x == b.normals.x && a.normals.weight == b.normals.weight;
}

}  // namespace

TEST_CASE("a frame is filled and its stages are timed") {
  ImageFrontend<DepthNormals> frontend;
  frontend.camera = frontend_camera();
  Frame<double> frame;
  const FrontendReport report = frontend.process(scene(), frame);
  CHECK(report.image == ImageStatus::kOk);
  CHECK(report.normals == NormalStatus::kOk);
  CHECK(report.total_time >= report.lines_time);
  CHECK(report.total_time >= report.points_time);
  CHECK((report.points_time > 0 && report.lines_time > 0 && report.normals_time > 0));
  CHECK(frame.index == 42);
  CHECK(frame.stamp == 1.5);
  CHECK((frame.width == kWidth && frame.height == kHeight && frame.pinhole.fx == 500));
  CHECK(frame.points.size() > 100);
  CHECK(frame.lines.size() >= 4);
  CHECK(frame.normals.size() > 2000);
}

TEST_CASE("two threads and one give the same frame") {
  ImageFrontend<DepthNormals> frontend;
  frontend.camera = frontend_camera();
  Frame<double> one, two;
  REQUIRE(frontend.process(scene(), two).image == ImageStatus::kOk);
  frontend.parallel = false;
  REQUIRE(frontend.process(scene(), one).image == ImageStatus::kOk);
  CHECK(same(one, two));
}

TEST_CASE("grey and coloured images of one scene give one frame") {
  ImageFrontend<> frontend;
  frontend.camera = frontend_camera();
  ImageInput input = scene();
  Frame<double> grey, colour, alpha;
  REQUIRE(frontend.process(input, grey).image == ImageStatus::kOk);
  const cv::Mat image = input.image;
  cv::cvtColor(image, input.image, cv::COLOR_GRAY2BGR);
  REQUIRE(frontend.process(input, colour).image == ImageStatus::kOk);
  cv::cvtColor(image, input.image, cv::COLOR_GRAY2BGRA);
  REQUIRE(frontend.process(input, alpha).image == ImageStatus::kOk);
  CHECK(same(grey, colour));
  CHECK(same(grey, alpha));
}

TEST_CASE("images that do not fit are named and leave the frame alone") {
  ImageFrontend<> frontend;
  frontend.camera = frontend_camera();
  Frame<double> frame;
  frame.index = 7;
  ImageInput input;
  CHECK(frontend.process(input, frame).image == ImageStatus::kEmpty);
  input.image = cv::Mat(240, 320, CV_8U, cv::Scalar(1));
  CHECK(frontend.process(input, frame).image == ImageStatus::kWrongSize);
  input.image = cv::Mat(kHeight, kWidth, CV_16U, cv::Scalar(1));
  CHECK(frontend.process(input, frame).image == ImageStatus::kWrongType);
  CHECK(frame.index == 7);
}

TEST_CASE("what a mask leaves out gives no points, no lines and no normals from depth") {
  ImageFrontend<DepthNormals> frontend;
  frontend.camera = frontend_camera();
  ImageInput input = scene();
  Frame<double> all, some;
  REQUIRE(frontend.process(input, all).image == ImageStatus::kOk);
  // The right half is out: it cuts the box and its texture.
  input.mask = cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(1));
  input.mask.colRange(kWidth / 2, kWidth).setTo(0);
  REQUIRE(frontend.process(input, some).image == ImageStatus::kOk);
  const double border = kWidth / 2;
  CHECK(some.points.size() > 20);
  CHECK(some.lines.size() >= 2);
  CHECK(
      std::any_of(all.points.begin(), all.points.end(), [&](const auto& p) { return p.pixel.x() > border; }));
  for (const auto& point : some.points) CHECK(point.pixel.x() < border - 4);
  for (const auto& line : some.lines) {
    CHECK(line.segment.start.x() < border);
    CHECK(line.segment.end.x() < border);
    CHECK(line.segment.midpoint().x() < border - 4);  // the mask's own border is no line
  }
  CHECK(some.normals.size() < all.normals.size() * 6 / 10);
  CHECK(some.normals.size() > all.normals.size() * 4 / 10);
  input.mask.setTo(255);
  REQUIRE(frontend.process(input, some).image == ImageStatus::kOk);
  CHECK(same(all, some));
  input.mask = cv::Mat(240, 320, CV_8UC1, cv::Scalar(1));
  CHECK(frontend.process(input, some).image == ImageStatus::kWrongMask);
}

TEST_CASE("missing depth costs the normals and nothing else") {
  ImageFrontend<DepthNormals> frontend;
  frontend.camera = frontend_camera();
  ImageInput input = scene();
  input.depth.release();
  Frame<double> frame;
  frame.normals.push_back(0, 0, -1, 1);
  const FrontendReport report = frontend.process(input, frame);
  CHECK(report.image == ImageStatus::kOk);
  CHECK(report.normals == NormalStatus::kNoInput);
  CHECK(frame.normals.size() == 0);
  CHECK(frame.points.size() > 100);
}

TEST_CASE("points and lines of a lens that distorts come out straight") {
  Camera<double> lens = frontend_camera();
  lens.distortion.k1 = -0.3;
  lens.distortion.k2 = 0.08;
  lens.distortion.p1 = 0.001;
  // A world of squares on the ideal image plane, seen through the lens and without it.
  const auto shade = [](const Vec2<double>& p) {
    const double u = p.x() / 80 + 8, v = p.y() / 80 + 8;
    const bool inside = std::abs(u - std::floor(u) - 0.5) < 0.3 && std::abs(v - std::floor(v) - 0.5) < 0.3;
    return inside ? 60 + 23 * std::fmod(3 * std::floor(u) + 5 * std::floor(v), 7) : 30.0;
  };
  ImageInput input;
  Frame<double> ideal, seen;
  ImageFrontend<> frontend;
  frontend.camera = frontend_camera();
  input.image = draw({kWidth, kHeight}, [&](double x, double y) { return shade({x, y}); });
  REQUIRE(frontend.process(input, ideal).image == ImageStatus::kOk);
  frontend.camera = lens;
  input.image = draw({kWidth, kHeight}, [&](double x, double y) {
    return shade(lens.undistort_pixel({x, y}));
  });
  REQUIRE(frontend.process(input, seen).image == ImageStatus::kOk);

  std::vector<double> point_errors, line_errors;
  for (const auto& p : ideal.points) {
    double nearest = 4;
    for (const auto& q : seen.points)
      if (q.octave <= 1) nearest = std::min(nearest, (q.pixel - p.pixel).norm());
    if (p.octave == 0) point_errors.push_back(nearest);
  }
  for (const auto& line : ideal.lines) {
    double nearest = 4;
    for (const auto& other : seen.lines) {
      const Vec3<double> l = line_through(other.segment.start, other.segment.end);
      const Vec2<double> m = line.segment.midpoint();
      if (other.segment.direction().dot(line.segment.direction()) > 0.99 &&
          (other.segment.midpoint() - m).norm() < 10)
        nearest = std::min(nearest, std::abs(l.dot(Vec3<double>(m.x(), m.y(), 1))));
    }
    line_errors.push_back(nearest);
  }
  const auto median = [](std::vector<double>& values) {
    REQUIRE(values.size() > 40);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  CHECK(median(point_errors) < 0.4);
  CHECK(median(line_errors) < 0.1);
}
