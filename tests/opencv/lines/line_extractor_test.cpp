// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/lines/line_extractor.hpp"

#include <cmath>
#include <iostream>
#include <sstream>

#include "opencv/synthetic_image.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

using Lines = std::vector<LineFeature<double>>;

Lines extract_lines(const cv::Mat& image, const LineOptions& options = {}) {
  LineExtractor extractor;
  extractor.options = options;
  Lines lines;
  extractor.extract(image, lines);
  return lines;
}

// Distance of both endpoints from the line through p and q.
double across(const Segment2<double>& segment, const Vec2<double>& p, const Vec2<double>& q) {
  const Vec3<double> line = line_through(p, q);
  const auto off = [&](const Vec2<double>& x) { return std::abs(line.dot(Vec3<double>(x.x(), x.y(), 1))); };
  return std::max(off(segment.start), off(segment.end));
}

// Catches what is printed while it lives.
class Silence {
 public:
  Silence() : old_(std::cout.rdbuf(caught_.rdbuf())) {}
  ~Silence() { std::cout.rdbuf(old_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  [[nodiscard]] std::string text() const { return caught_.str(); }

 private:
  std::ostringstream caught_;
  std::streambuf* old_;
};

}  // namespace

TEST_CASE("the sides of a box are found to a tenth of a pixel") {
  const double angle = GENERATE(0.0, 0.21, 0.7);
  const Vec2<double> low(200.3, 140.8), high(430.6, 310.1), middle = (low + high) / 2,
                                                            half = (high - low) / 2;
  const Lines lines = extract_lines(draw_box({640, 480}, low, high, angle, 190, 70));
  REQUIRE(lines.size() == 4);
  const Vec2<double> x(std::cos(angle), std::sin(angle)), y(-x.y(), x.x());
  const std::array<Vec2<double>, 4> corners{
      middle - half.x() * x - half.y() * y, middle + half.x() * x - half.y() * y,
      middle + half.x() * x + half.y() * y, middle - half.x() * x + half.y() * y};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2<double>&p = corners[i], &q = corners[(i + 1) % 4];
    const LineFeature<double>* best = &lines[0];
    for (const auto& line : lines)
      if (across(line.segment, p, q) < across(best->segment, p, q)) best = &line;
    CHECK(across(best->segment, p, q) < 0.1);
    CHECK(best->segment.length() > 0.95 * (q - p).norm());
    CHECK(best->segment.length() < (q - p).norm() + 3);
    CHECK(best->sigma < 0.3);
    // The bright inside lies to the left of start -> end, as seen on the screen.
    const Vec2<double> d = best->segment.direction(), inwards = middle - best->segment.midpoint();
    CHECK(d.x() * inwards.y() - d.y() * inwards.x() < 0);
  }
}

TEST_CASE("images without an edge give no lines and print nothing") {
  const Silence silence;
  CHECK(extract_lines(cv::Mat()).empty());
  CHECK(extract_lines(cv::Mat(480, 640, CV_8U, cv::Scalar(90))).empty());
  CHECK(extract_lines(cv::Mat(20, 20, CV_8U, cv::Scalar(90))).empty());
  CHECK(extract_lines(cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3))).empty());
  CHECK(extract_lines(cv::Mat(480, 640, CV_16U, cv::Scalar(1))).empty());
  CHECK(silence.text().empty());
}

TEST_CASE("the same image gives the same lines") {
  const cv::Mat image = draw_box({640, 480}, {200, 140}, {430, 310}, 0.2, 190, 70);
  LineExtractor reused;
  Lines first, second;
  reused.extract(image, first);
  reused.extract(draw_texture({320, 240}, 30, 1), second);
  reused.extract(image, second);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].segment.start == second[i].segment.start);
    CHECK(first[i].segment.end == second[i].segment.end);
    CHECK(first[i].descriptor == second[i].descriptor);
  }
}

TEST_CASE("an edge with gaps is one line") {
  // Posts in front of the edge hide 8 of every 60 pixels of it.
  const cv::Mat image = draw({640, 480}, [](double x, double y) {
    if (x > 80 && x < 560 && std::fmod(x, 60) < 8) return 120.0;
    return y > 240.25 + 0.1 * (x - 320) ? 160.0 : 80.0;
  });
  const Lines lines = extract_lines(image);
  const auto longest = std::max_element(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
    return a.segment.length() < b.segment.length();
  });
  REQUIRE(longest != lines.end());
  CHECK(longest->segment.length() > 500);
  CHECK(across(longest->segment, {0, 208.25}, {640, 272.25}) < 0.15);
}

TEST_CASE("faint edges under noise are found") {
  cv::Mat image = draw_box({640, 480}, {200.3, 140.8}, {430.6, 310.1}, 0.2, 110, 100);
  add_noise(image, 1.5, 2);
  const Lines lines = extract_lines(image);
  CHECK(lines.size() >= 4);
  double length = 0;
  for (const auto& line : lines) length += line.segment.length();
  CHECK(length > 0.8 * 2 * (230.3 + 169.3));
}

TEST_CASE("a dark rim of the image is no line") {
  cv::Mat image(480, 640, CV_8U, cv::Scalar(150));
  image.row(479).setTo(0);
  image.col(0).setTo(0);
  image.col(1).setTo(0);
  CHECK(extract_lines(image).empty());
}

TEST_CASE("lines are no shorter than asked for and no more") {
  const cv::Mat image = draw_texture({640, 480}, 50, 3);
  LineOptions options;
  options.min_length_ratio = 0.05;
  options.max_lines = 5;
  const Lines lines = extract_lines(image, options);
  CHECK(lines.size() <= 5);
  for (const auto& line : lines) CHECK(line.segment.length() >= 32);
}

TEST_CASE("the descriptor finds an edge again in a shifted image") {
  // Books on a shelf: stripes of random width, brightness and texture.
  cv::Mat shelf = draw_texture({800, 480}, 4, 4);
  Random random(5);
  for (int x = 20; x < 740;) {
    const int width = 25 + static_cast<int>(random.below(40)), top = 40 + static_cast<int>(random.below(80));
    shelf(cv::Rect(x, top, width, 400 - top)) += cv::Scalar(static_cast<int>(random.below(160)) - 80);
    x += width;
  }
  const Vec2<double> shift(-23, 7);
  const Lines first = extract_lines(shelf(cv::Rect(0, 10, 640, 460)).clone()),
              second = extract_lines(shelf(cv::Rect(23, 3, 640, 460)).clone());
  int right = 0, total = 0;
  for (const auto& line : first) {
    const Segment2<double>& s = line.segment;
    if (s.length() < 100 || s.midpoint().x() < 60) continue;
    const auto best = std::min_element(second.begin(), second.end(), [&](const auto& a, const auto& b) {
      return hamming(a.descriptor, line.descriptor) < hamming(b.descriptor, line.descriptor);
    });
    ++total;
    right += across(s, best->segment.start - shift, best->segment.end - shift) < 1;
  }
  CHECK(total >= 10);
  CHECK(right >= 0.9 * total);
}
