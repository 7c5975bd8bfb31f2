// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/points/orb_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "opencv/synthetic_image.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

using Points = std::vector<PointFeature<double>>;

Points extract_points(const cv::Mat& image, const OrbOptions& options = {}) {
  OrbExtractor extractor;
  extractor.options = options;
  Points points;
  std::vector<FeaturePatch> patches;
  extractor.extract(image, points, patches);
  return points;
}

bool same(const Points& a, const Points& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.pixel == q.pixel && p.sigma == q.sigma && p.angle == q.angle && p.octave == q.octave &&
           p.descriptor == q.descriptor;
  });
}

const PointFeature<double>& most_alike(const PointFeature<double>& point, const Points& others) {
  return *std::min_element(others.begin(), others.end(), [&](const auto& a, const auto& b) {
    return hamming(a.descriptor, point.descriptor) < hamming(b.descriptor, point.descriptor);
  });
}

double median(std::vector<double> values) {
  REQUIRE(!values.empty());
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

TEST_CASE("images without a corner give no points") {
  CHECK(extract_points(cv::Mat()).empty());
  CHECK(extract_points(cv::Mat(480, 640, CV_8U, cv::Scalar(90))).empty());
  CHECK(extract_points(draw({320, 240}, [](double x, double) { return x / 2; })).empty());
  CHECK(extract_points(draw_texture({20, 20}, 40, 1)).empty());
  CHECK(extract_points(cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3))).empty());
  CHECK(extract_points(cv::Mat(480, 640, CV_32F, cv::Scalar(1))).empty());
}

TEST_CASE("an image that is refused clears what was there") {
  OrbExtractor extractor;
  Points points;
  std::vector<FeaturePatch> patches;
  extractor.extract(draw_texture({320, 240}, 40, 1), points, patches);
  REQUIRE(!points.empty());
  REQUIRE(!patches.empty());
  extractor.extract(cv::Mat(), points, patches);
  CHECK(points.empty());
  CHECK(patches.empty());
}

TEST_CASE("the same image gives the same points") {
  const cv::Mat image = draw_texture({320, 240}, 40, 2);
  OrbExtractor reused;
  Points first, second;
  std::vector<FeaturePatch> patches;
  reused.extract(image, first, patches);
  reused.extract(draw_texture({200, 150}, 40, 3), second, patches);
  reused.extract(image, second, patches);
  CHECK(same(first, second));
  CHECK(same(first, extract_points(image)));
}

TEST_CASE("each point keeps a patch of its level, with itself at its centre") {
  const cv::Mat image = draw_texture({320, 240}, 40, 5);
  OrbExtractor extractor;
  Points points;
  std::vector<FeaturePatch> patches;
  extractor.extract(image, points, patches);
  REQUIRE(points.size() > 50);
  for (const auto& point : points) {
    const FeaturePatch& patch = patches.at(static_cast<std::size_t>(point.patch));
    CHECK((patch.centre - Vec2<float>::Constant(FeaturePatch::kRadius)).cwiseAbs().maxCoeff() <= 0.51F);
    CHECK(patch.spacing(0, 0) == Approx(point.sigma / extractor.options.sigma).epsilon(1e-5));
    if (point.octave > 0) continue;
    // At full resolution the patch is the image around the point.
    const Vec2<double> corner = point.pixel - patch.centre.cast<double>();
    const int left = static_cast<int>(std::lround(corner.x())),
              top = static_cast<int>(std::lround(corner.y()));
    CHECK(corner.x() == Approx(left).margin(1e-4));
    for (int row = 0; row < FeaturePatch::kSide; row += 7)
      for (int column = 0; column < FeaturePatch::kSide; column += 7)
        CHECK(patch.view().at(column, row) == image.at<std::uint8_t>(top + row, left + column));
  }
}

TEST_CASE("points are finite and inside the image and within the budget") {
  OrbOptions options;
  options.points = 300;
  const Points points = extract_points(draw_texture({640, 480}, 40, 4), options);
  CHECK(points.size() <= 300);
  CHECK(points.size() >= 290);
  for (const auto& p : points) {
    CHECK(p.pixel.allFinite());
    CHECK((p.pixel.x() > 0 && p.pixel.x() < 639 && p.pixel.y() > 0 && p.pixel.y() < 479));
    CHECK(p.sigma == Approx(options.sigma * std::pow(options.ratio, p.octave)).epsilon(0.02));
  }
}

TEST_CASE("points follow a shift by a fraction of a pixel") {
  const Vec2<double> shift = Vec2<double>(0.3, -0.4);
  const auto squares = [](const Vec2<double>& offset) {
    return draw({320, 240}, [&](double x, double y) {
      const double u = (x - offset.x()) / 40, v = (y - offset.y()) / 40;
      const double iu = std::floor(u), iv = std::floor(v);
      const bool inside = std::abs(u - iu - 0.5) < 0.25 && std::abs(v - iv - 0.5) < 0.3;
      return inside ? 60 + 23 * std::fmod(3 * iu + 5 * iv + 40, 7) : 30.0;
    });
  };
  const Points before = extract_points(squares({0, 0})), after = extract_points(squares(shift));
  std::vector<double> errors;
  for (const auto& p : before) {
    double nearest = 3;
    for (const auto& q : after)
      if (q.octave == p.octave) nearest = std::min(nearest, (q.pixel - p.pixel - shift).norm());
    if (p.octave < 3) errors.push_back(nearest);
  }
  CHECK(errors.size() > 80);
  CHECK(median(errors) < 0.08);
}

TEST_CASE("every part of a textured image gets its share") {
  // Strong texture in one quarter, and a fifth of its contrast elsewhere.
  cv::Mat image = draw_texture({640, 480}, 8, 5);
  draw_texture({320, 240}, 40, 6).copyTo(image(cv::Rect(0, 0, 320, 240)));
  OrbOptions options;
  options.points = 600;
  std::array<int, 4> quarters{};
  for (const auto& p : extract_points(image, options))
    ++quarters[(p.pixel.x() > 320) + 2 * (p.pixel.y() > 240)];
  for (const int count : quarters) CHECK(count > 80);
}

TEST_CASE("the contrast that is asked for falls where texture is poor") {
  const cv::Mat faint = draw_texture({640, 480}, 4, 7);
  OrbOptions fixed;
  fixed.contrast = {20, 20, 20};
  CHECK(extract_points(faint, fixed).size() < 10);
  CHECK(extract_points(faint).size() > 200);
}

TEST_CASE("noise alone gives few points") {
  cv::Mat image(480, 640, CV_8U, cv::Scalar(128));
  add_noise(image, 3, 8);
  OrbOptions bold;
  bold.noise_factor = 0;
  const auto found = extract_points(image).size();
  CHECK(found < 150);
  CHECK(extract_points(image, bold).size() > 3 * found + 100);
}

TEST_CASE("descriptor and angle turn with the image") {
  const cv::Mat image = draw_texture({320, 320}, 40, 9);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const Points points = extract_points(image), others = extract_points(turned);
  int right = 0, total = 0;
  for (const auto& p : points) {
    const auto& q = most_alike(p, others);
    const Vec2<double> expected(319 - p.pixel.y(), p.pixel.x());
    ++total;
    if ((q.pixel - expected).norm() > 2 * p.sigma + 1) continue;
    right += std::cos(q.angle - p.angle - std::acos(0.0)) > 0.9;
  }
  CHECK(total > 300);
  CHECK(right > 0.85 * total);
}
