// SPDX-License-Identifier: BSD-3-Clause
// What makes a room of `sslam synth` more like a real one. Runs the program itself; its complaints are tested
// in synth_tests.cmake.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "cli/synth_run.hpp"
#include "sslam/core/types.hpp"
#include "support/catch.hpp"

namespace real_room_test {

using namespace sslam;
using sslam::testing::Outcome;
using sslam::testing::synth;
using sslam::testing::text_of;
using Scratch = sslam::testing::SynthScratch;
namespace fs = std::filesystem;

namespace {

const std::string kSmall = " --quiet --size 160x120 --texture poor ";

}  // namespace

TEST_CASE("dots are some three hundred, at the same pixels of every image, placed by the seed") {
  const Scratch scratch;
  const std::string options =
      kSmall + "--frames 2 --fps 2 --noise 0 --image-format png --no-depth --no-normals ";
  const auto image = [&](const char* name, int frame) {
    return cv::imread(scratch / cv::format("%s/rgb/%06d.png", name, frame));
  };
  REQUIRE(synth(scratch / "plain" + options).code == 0);
  REQUIRE(synth(scratch / "dots" + options + "--image-fixed dots").code == 0);
  const cv::Mat first = image("dots", 0), second = image("dots", 1);
  const cv::Mat added = first - image("plain", 0), later = second - image("plain", 1);
  cv::Mat white, other;  // neither image is at its end
  cv::bitwise_or(first >= 255, second >= 255, white);
  cv::Mat changed = added != later;
  changed.setTo(cv::Scalar::all(0), white);
  CHECK(cv::countNonZero(changed.reshape(1)) == 0);
  cv::Mat peaks, labels;
  cv::extractChannel(added > 25, peaks, 1);
  const int spots = cv::connectedComponents(peaks, labels) - 1;
  CHECK((spots > 200 && spots <= 300));
  CHECK(cv::norm(first, second, cv::NORM_INF) > 20.0);
  REQUIRE(synth(scratch / "other" + options + "--image-fixed dots --seed 2").code == 0);
  REQUIRE(synth(scratch / "plain" + options + "--seed 2").code == 0);
  other = image("other", 0) - image("plain", 0);
  CHECK(cv::norm(added, other, cv::NORM_INF) > 40.0);
}

TEST_CASE("the manifest tells what makes a room real, and where its walls are") {
  const Scratch scratch;
  REQUIRE(synth(scratch / "a" + kSmall + "--frames 1 --off-square 2.5 --doors-ajar --clutter 12").code == 0);
  REQUIRE(synth(scratch / "b" + kSmall + "--frames 1").code == 0);
  const std::string real = text_of(fs::path(scratch / "a/synth.toml"));
  INFO(real);
  for (const char* line : {"off-square = 2.5\n", "doors-ajar = true\n", "clutter = 12\n"})
    CHECK(real.find(line) != std::string::npos);
  const auto corners = [&](const std::string& text) {
    std::array<Vec2<double>, 4> c;
    const std::size_t at = text.find("\noutline = ");
    REQUIRE(at != std::string::npos);
    REQUIRE(std::sscanf(text.c_str() + at, "\noutline = [[%lf, %lf], [%lf, %lf], [%lf, %lf], [%lf, %lf]]\n",
                        &c[0].x(), &c[0].y(), &c[1].x(), &c[1].y(), &c[2].x(), &c[2].y(), &c[3].x(),
                        &c[3].y()) == 8);
    return c;
  };
  const std::array<Vec2<double>, 4> square = corners(text_of(fs::path(scratch / "b/synth.toml")));
  CHECK((square[0].isZero() && square[1].y() == 0.0 && square[2].x() == square[1].x()));
  const std::array<Vec2<double>, 4> off = corners(real);
  for (int i = 0; i < 4; ++i) {
    const Vec2<double> run = off[(i + 1) % 4] - off[i], side = square[(i + 1) % 4] - square[i];
    const double angle = degrees(std::acos(run.dot(side) / (run.norm() * side.norm())));
    CHECK((angle > 1e-3 && angle < 2.5 * 2.63));
  }
}

}  // namespace real_room_test
