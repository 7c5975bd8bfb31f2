// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/camera/working_size.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

Camera<double> full_hd() {
  Camera<double> camera;
  camera.pinhole = {1500, 1490, 955.5, 541.2};
  camera.distortion = {0.1, -0.02, 0.001, -0.002, 0};
  camera.width = 1920;
  camera.height = 1080;
  return camera;
}

}  // namespace

TEST_CASE("A camera that is shrunk sees the same place at the same share of its image") {
  const Camera<double> camera = full_hd(), small = shrunk_camera(camera, 960);
  REQUIRE(small.width == 960);
  REQUIRE(small.height == 540);
  const Vec3<double> seen(0.3, -0.2, 1.1);
  const Vec3<double> m = seen / seen.z();
  const Vec2<double> at = camera.distort_pixel(camera.pinhole.project(m));
  const Vec2<double> in_small = small.distort_pixel(small.pinhole.project(m));
  CHECK((in_small - (at + Vec2<double>(0.5, 0.5)) / 2 + Vec2<double>(0.5, 0.5)).norm() < 1e-9);
}

TEST_CASE("Upright images are shrunk by their height, small ones and those without a limit stay") {
  Camera<double> camera = full_hd();
  std::swap(camera.width, camera.height);
  CHECK(shrunk_camera(camera, 960).height == 960);
  CHECK(shrunk_camera(camera, 960).width == 540);
  CHECK(shrunk_camera(camera, 0).width == 1080);
  CHECK(shrunk_camera(camera, 1920).pinhole.fx == camera.pinhole.fx);
}

TEST_CASE("What is registered to an image is shrunk with it, and a mask never shows what it hid") {
  ImageInput input;
  input.index = 7;
  input.image = cv::Mat(1080, 1920, CV_8UC3, cv::Scalar(1, 2, 3));
  input.depth = cv::Mat(1080, 1920, CV_16UC1, cv::Scalar(5000));
  input.mask = cv::Mat(1080, 1920, CV_8UC1, cv::Scalar(200));
  input.mask.at<unsigned char>(101, 301) = 0;
  const ImageInput small = shrunk_input(input, shrunk_camera(full_hd(), 960));
  CHECK(small.index == 7);
  CHECK(small.image.size() == cv::Size(960, 540));
  CHECK(small.image.at<cv::Vec3b>(10, 10) == cv::Vec3b(1, 2, 3));
  CHECK(small.depth.at<std::uint16_t>(100, 100) == 5000);
  CHECK(small.mask.at<unsigned char>(50, 150) == 0);
  CHECK(cv::countNonZero(small.mask) == 960 * 540 - 1);
}
