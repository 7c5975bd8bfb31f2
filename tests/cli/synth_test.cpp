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

#include "cli/program.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace synth_test {

using namespace sslam;
using sslam::testing::Outcome;
using sslam::testing::run_program;
using sslam::testing::text_of;
namespace fs = std::filesystem;

namespace {

Outcome synth(const std::string& arguments) {
  return run_program("synth " + arguments);
}

struct Scratch : testing::ScratchFolder {
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path() / name).string(); }
};

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

}  // namespace synth_test
