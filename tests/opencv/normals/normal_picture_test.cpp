// SPDX-License-Identifier: BSD-3-Clause
// Dense normals as pictures: what FileNormals reads back, what is left out, and the overlay.
#include "sslam/opencv/normals/normal_picture.hpp"

#include <filesystem>

#include "model_fixture.hpp"
#include "sslam/opencv/normals/file_normals.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

namespace {

const cv::Vec3f kWall(0, 0, -1), kFloor(0, -0.98F, -0.199F);

// A wall above a floor on a grid of 16 x 12 that shows what a camera of 160 x 120 sees.
DenseNormals wall_and_floor() {
  DenseNormals dense;
  dense.normal.create(12, 16);
  dense.normal.rowRange(0, 6).setTo(kWall);
  dense.normal.rowRange(6, 12).setTo(kFloor);
  dense.planar = cv::Mat_<float>(12, 16, 1.0F);
  dense.pinhole = {13, 13, 7.5, 5.5};
  return dense;
}

double angle_deg(const cv::Vec3b& pixel, const cv::Vec3f& n) {
  const cv::Vec3f m(static_cast<float>(pixel[2]) / 127.5F - 1, static_cast<float>(pixel[1]) / 127.5F - 1,
                    static_cast<float>(pixel[0]) / 127.5F - 1);
  return degrees(std::atan2(cv::norm(m.cross(n)), static_cast<double>(m.dot(n))));
}

}  // namespace

TEST_CASE("a picture of normals has the camera's pixels and no normal between planes", "[normals]") {
  const auto picture = normal_picture(wall_and_floor(), camera(160, 120, 130));
  REQUIRE(picture.size() == cv::Size(160, 120));
  for (const int u : {0, 80, 159}) {
    CHECK(angle_deg(picture(0, u), kWall) < 0.6);
    CHECK(angle_deg(picture(119, u), kFloor) < 0.6);
    CHECK(picture(59, u) == no_normal());
  }
  CHECK(planar_share(picture) > 0.9);
  CHECK(planar_share(picture) < 0.97);
}

TEST_CASE("a picture of normals leaves out what is not planar and what was not looked at", "[normals]") {
  DenseNormals dense = wall_and_floor();
  dense.planar.colRange(0, 8).setTo(0.2F);
  dense.normal.colRange(12, 16).setTo(cv::Vec3f());  // planar, but nothing is known there
  auto picture = normal_picture(dense, camera(160, 120, 130));
  CHECK(picture(20, 60) == no_normal());
  CHECK(angle_deg(picture(20, 100), kWall) < 0.6);
  CHECK(picture(20, 150) == no_normal());
  // A wider camera than the network's: its border is not on the grid.
  picture = normal_picture(wall_and_floor(), camera(160, 120, 65));
  CHECK(picture(20, 20) == no_normal());
  CHECK(angle_deg(picture(50, 80), kWall) < 0.6);
}

TEST_CASE("a picture of normals is in the camera's image with its lens distortion", "[normals]") {
  Camera<double> cam = camera(160, 120, 130);
  cam.distortion.k1 = 0.4;  // the image shows less of the room at its border
  DenseNormals dense = wall_and_floor();
  dense.planar.colRange(0, 2).setTo(0.0F);
  const auto planar_columns = [&](const cv::Mat_<cv::Vec3b>& picture) {
    int count = 0;
    for (int u = 0; u < picture.cols; ++u) count += picture(10, u) == no_normal() ? 0 : 1;
    return count;
  };
  CHECK(planar_columns(normal_picture(dense, cam)) >
        planar_columns(normal_picture(dense, camera(160, 120, 130))));
}

TEST_CASE("stored pictures come back through FileNormals", "[normals]") {
  FileNormals files;
  REQUIRE(parse_normal_encoding(kNormalEncoding, files.options));
  const Camera<double> cam = camera(160, 120, 130);
  DenseNormals dense = wall_and_floor();
  dense.planar.colRange(0, 8).setTo(0.0F);
  NormalField field;
  REQUIRE(files.decode(normal_picture(dense, cam), cam, field) == NormalStatus::kOk);
  REQUIRE(field.size() > 400);
  CHECK(field.size() <= 600);  // of 40 x 30, the right half
  for (std::size_t i = 0; i < field.size(); ++i) {
    const cv::Vec3f n(field.x[i], field.y[i], field.z[i]);
    CHECK(std::max(n.dot(kWall), n.dot(kFloor)) > 0.9999F);
  }
  REQUIRE(files.decode(cv::Mat(120, 160, CV_8UC3, no_normal()), cam, field) == NormalStatus::kOk);
  CHECK(field.size() == 0);
}

TEST_CASE("an overlay leaves pixels without a normal alone", "[normals]") {
  cv::Mat_<cv::Vec3b> image(1, 2, cv::Vec3b(10, 20, 30)), picture(1, 2, no_normal());
  picture(0, 1) = encode_normal(kWall);
  const auto overlay = overlay_normals(image, picture, 0.5);
  CHECK(overlay(0, 0) == image(0, 0));
  CHECK(overlay(0, 1) == cv::Vec3b(5, 74, 79));
}
