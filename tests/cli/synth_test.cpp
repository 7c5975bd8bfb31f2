// SPDX-License-Identifier: BSD-3-Clause
// What `sslam synth` writes. Runs the program itself: SSLAM_COMMAND is its path. Its complaints are tested in
// synth_tests.cmake.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/synth_run.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/opencv/camera/undistorter.hpp"
#include "support/catch.hpp"

namespace synth_test {

using namespace sslam;
using sslam::testing::Outcome;
using sslam::testing::synth;
using sslam::testing::text_of;
using Scratch = sslam::testing::SynthScratch;
namespace fs = std::filesystem;

namespace {

bool same_images(const std::string& a, const std::string& b, int frames) {
  for (int i = 0; i < frames; ++i) {
    for (const char* pattern : {"rgb/%06d.jpg", "depth/%06d.png", "normals/%06d.png"}) {
      const std::string name = cv::format(pattern, i), content = text_of(fs::path(a) / name);
      if (content.empty() || content != text_of(fs::path(b) / name)) return false;
    }
  }
  return text_of(fs::path(a) / "groundtruth.txt") == text_of(fs::path(b) / "groundtruth.txt");
}

const std::string kSmall = " --quiet --size 160x120 ";

}  // namespace

TEST_CASE("synth writes depth, poses and camera that agree") {
  const Scratch scratch;
  const Outcome outcome = synth(scratch / "a" + kSmall + "--frames 16 --seed 3 --texture poor");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  io::Warnings warnings;
  const io::Trajectory truth = io::read_trajectory(scratch / "a/groundtruth.txt", warnings);
  REQUIRE(truth.size() == 16);
  const CameraFile camera = read_camera_file(scratch / "a/camera.yaml");
  REQUIRE(camera.camera.width == 160);
  REQUIRE(camera.depth_factor == 5000.0);
  const cv::Mat first = cv::imread(scratch / "a/depth/000000.png", cv::IMREAD_UNCHANGED);
  const cv::Mat last = cv::imread(scratch / "a/depth/000015.png", cv::IMREAD_UNCHANGED);
  REQUIRE((first.type() == CV_16UC1 && last.type() == CV_16UC1 && last.size() == cv::Size(160, 120)));
  const Pinhole<double>& pinhole = camera.camera.pinhole;
  const SE3<double> last_from_first = truth[15].world_from_cam.inverse() * truth[0].world_from_cam;
  int agree = 0, seen = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double z = first.at<std::uint16_t>(y, x) / 5000.0;
      REQUIRE(z > 0.0);
      const Vec3<double> moved = last_from_first * Vec3<double>(z * pinhole.unproject({x, y}));
      const Vec2<double> pixel = pinhole.project(moved);
      const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
      if (moved.z() < 0.1 || u < 0 || v < 0 || u >= 160 || v >= 120) continue;
      ++seen;
      if (std::abs(last.at<std::uint16_t>(v, u) / 5000.0 - moved.z()) < 0.02 * moved.z()) ++agree;
    }
  }
  REQUIRE(seen > 10000);
  CHECK(agree > 0.93 * seen);  // the others are hidden in one of the two
}

TEST_CASE("synth writes normals that fit the depth") {
  const Scratch scratch;
  REQUIRE(synth(scratch / "a" + kSmall + "--frames 1 --texture poor").code == 0);
  const cv::Mat depth = cv::imread(scratch / "a/depth/000000.png", cv::IMREAD_UNCHANGED);
  const cv::Mat normals = cv::imread(scratch / "a/normals/000000.png", cv::IMREAD_UNCHANGED);
  REQUIRE((normals.type() == CV_8UC3 && normals.size() == depth.size()));
  const Pinhole<double> pinhole = read_camera_file(scratch / "a/camera.yaml").camera.pinhole;
  const auto point = [&](int x, int y) -> Vec3<double> {
    return depth.at<std::uint16_t>(y, x) / 5000.0 * pinhole.unproject({x, y});
  };
  const auto bends = [&](int x, int y, int dx, int dy) {  // inverse depth is linear in the pixel on a plane
    const auto inverse = [&](int k) { return 5000.0 / depth.at<std::uint16_t>(y + k * dy, x + k * dx); };
    return std::abs(inverse(0) - 2.0 * inverse(2) + inverse(4)) > 5e-4;
  };
  int agree = 0, checked = 0;
  for (int y = 0; y < 112; ++y) {
    for (int x = 0; x < 152; ++x) {
      if (bends(x, y, 1, 0) || bends(x, y, 0, 1)) continue;
      const cv::Vec3b& stored = normals.at<cv::Vec3b>(y, x);
      if (normals.at<cv::Vec3b>(y + 4, x) != stored || normals.at<cv::Vec3b>(y, x + 4) != stored) continue;
      const Vec3<double> n(2.0 * stored[2] / 255.0 - 1.0, 2.0 * stored[1] / 255.0 - 1.0,
                           2.0 * stored[0] / 255.0 - 1.0);
      REQUIRE(std::abs(n.norm() - 1.0) < 0.01);
      const Vec3<double> fitted =
          (point(x, y + 4) - point(x, y)).cross(point(x + 4, y) - point(x, y)).normalized();
      ++checked;
      if (fitted.dot(n.normalized()) > 0.999) ++agree;
    }
  }
  REQUIRE(checked > 3000);
  CHECK(agree > 0.95 * checked);
}

TEST_CASE("synth repeats itself for the same seed on any number of threads") {
  const Scratch scratch;
  REQUIRE(synth(scratch / "a" + kSmall + "--frames 5 --threads 1 --exposure 0.1 --blur 0.5").code == 0);
  REQUIRE(synth(scratch / "b" + kSmall + "--frames 5 --threads 3 --exposure 0.1 --blur 0.5").code == 0);
  REQUIRE(synth(scratch / "c" + kSmall + "--frames 5 --seed 2 --exposure 0.1 --blur 0.5").code == 0);
  CHECK(same_images(scratch / "a", scratch / "b", 5));
  CHECK_FALSE(same_images(scratch / "a", scratch / "c", 5));
}

TEST_CASE("synth leaves out what is not wanted") {
  const Scratch scratch;
  REQUIRE(synth(scratch / "a" + kSmall + "--frames 1 --no-depth --no-normals --image-format png").code == 0);
  CHECK(fs::exists(scratch / "a/rgb/000000.png"));
  CHECK_FALSE(fs::exists(scratch / "a/depth"));
  CHECK_FALSE(fs::exists(scratch / "a/depth.txt"));
  CHECK_FALSE(fs::exists(scratch / "a/normals"));
}

TEST_CASE("an image through a lens, undistorted with its camera file, is the pinhole's image") {
  const Scratch scratch;
  const std::string clean = kSmall + "--frames 1 --image-format png --noise 0 --vignetting 0 --no-normals ";
  REQUIRE(synth(scratch / "bent" + clean + "--lens=-0.25,0.06,0.002,-0.001").code == 0);
  REQUIRE(synth(scratch / "straight" + clean).code == 0);
  const Camera<double> camera = read_camera_file(scratch / "bent/camera.yaml").camera;
  CHECK(camera.distortion.k1 == -0.25);
  CHECK(camera.distortion.p2 == -0.001);
  const cv::Mat bent = cv::imread(scratch / "bent/rgb/000000.png");
  const cv::Mat straight = cv::imread(scratch / "straight/rgb/000000.png");
  Undistorter undistorter;
  const cv::Mat middle = undistorter.undistort(bent, camera);
  const auto difference = [](const cv::Mat& a, const cv::Mat& b) {
    const cv::Rect inside(4, 4, 152, 112);
    return cv::norm(a(inside), b(inside), cv::NORM_L1) / (3.0 * inside.area());
  };
  CHECK(difference(middle, straight) < 0.4 * difference(bent, straight));
  CHECK(difference(middle, straight) < 8.0);
  // Depth has the image's distortion: each bent pixel shows what the pinhole's pixel shows.
  const cv::Mat depth = cv::imread(scratch / "bent/depth/000000.png", cv::IMREAD_UNCHANGED);
  const cv::Mat ideal = cv::imread(scratch / "straight/depth/000000.png", cv::IMREAD_UNCHANGED);
  int agree = 0, seen = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Vec2<double> at = camera.undistort_pixel(Vec2<double>(x, y));
      const int u = static_cast<int>(std::lround(at.x())), v = static_cast<int>(std::lround(at.y()));
      if (u < 0 || v < 0 || u >= 160 || v >= 120) continue;
      ++seen;
      if (std::abs(depth.at<std::uint16_t>(y, x) - ideal.at<std::uint16_t>(v, u)) <
          0.02 * ideal.at<std::uint16_t>(v, u))
        ++agree;
    }
  }
  REQUIRE(seen > 14000);
  CHECK(agree > 0.93 * seen);
}

TEST_CASE("a camera file is off by what was asked, and the true one stands beside it") {
  const Scratch scratch;
  const std::string small = kSmall + "--frames 1 --no-depth --no-normals --texture poor --lens 0.02,0 ";
  REQUIRE(synth(scratch / "a" + small + "--camera-error focal=0.05,cx=-3,k1=0.1").code == 0);
  const Camera<double> given = read_camera_file(scratch / "a/camera.yaml").camera;
  const Camera<double> truth = read_camera_file(scratch / "a/camera_true.yaml").camera;
  CHECK(std::abs(truth.pinhole.fx - 120.0) < 1e-6);
  CHECK(std::abs(given.pinhole.fx - 126.0) < 1e-6);
  CHECK(std::abs(given.pinhole.fy - 126.0) < 1e-6);
  CHECK(std::abs(given.pinhole.cx - truth.pinhole.cx + 3.0) < 1e-6);
  CHECK(std::abs(given.distortion.k1 - 0.12) < 1e-9);
  CHECK(std::abs(truth.distortion.k1 - 0.02) < 1e-9);
  REQUIRE(synth(scratch / "a" + small).code == 0);
  CHECK_FALSE(fs::exists(scratch / "a/camera_true.yaml"));
}

TEST_CASE("a camera's look is overridden by what is said beside it, and repeats itself") {
  const Scratch scratch;
  const std::string shown = " --quiet --size 160x90 --frames 2 --tremor 2 --texture poor ";
  REQUIRE(synth(scratch / "a" + shown + "--camera-like phone --threads 1 --image-fixed bar").code == 0);
  REQUIRE(synth("--quiet --camera-like phone " + (scratch / "b") + shown + "--threads 2 --image-fixed bar")
              .code == 0);
  CHECK(same_images(scratch / "a", scratch / "b", 2));
  const std::string manifest = text_of(fs::path(scratch / "a/synth.toml"));
  INFO(manifest);
  for (const char* line : {"read-out = 0.02\n", "size = \"160x90\"\n", "focal = 128\n", "tremor = 2\n",
                           "shake = 1\n", "jpeg-quality = 85\n", "image-fixed = \"bar\"\n"})
    CHECK(manifest.find(line) != std::string::npos);
}

TEST_CASE("what is fixed to the image stays while the rest moves") {
  const Scratch scratch;
  const std::string options =
      kSmall + "--frames 2 --fps 2 --noise 0 --image-format png --no-depth --no-normals ";
  REQUIRE(synth(scratch / "a" + options + "--image-fixed bar").code == 0);
  const cv::Mat first = cv::imread(scratch / "a/rgb/000000.png");
  const cv::Mat last = cv::imread(scratch / "a/rgb/000001.png");
  const cv::Rect bar(0, 100, 160, 20), rest(0, 0, 160, 100);
  CHECK(cv::norm(first(bar), last(bar), cv::NORM_INF) == 0.0);
  CHECK(cv::norm(first(rest), last(rest), cv::NORM_INF) > 20.0);
}

}  // namespace synth_test
