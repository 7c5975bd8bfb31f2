// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/normals/file_normals.hpp"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using sslam::testing::ScratchFolder;

namespace {

Camera<double> rendered_camera() {
  Camera<double> c;
  c.pinhole = {481.2, 480, 319.5, 239.5};
  c.width = 640;
  c.height = 480;
  return c;
}

const Vec3<double> kLeft = Vec3<double>(0.6, 0.1, -1).normalized();
const Vec3<double> kRight = Vec3<double>(-0.5, -0.4, -1).normalized();

// Left and right half have a normal each, stored as blue = x, green = y, red = z with these signs.
template <class Pixel>
cv::Mat store(int type, double full, const Vec3<double>& sign) {
  cv::Mat image(192, 256, type);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const Vec3<double> n = (u < 128 ? kLeft : kRight).cwiseProduct(sign);
      Pixel* pixel = image.ptr<Pixel>(v) + 3 * u;
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<Pixel>((n[i] + 1) / 2 * full);
    }
  return image;
}

void check_halves(const NormalField& field, double tolerance) {
  REQUIRE(field.size() > 2500);
  std::size_t left = 0, right = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Vec3<double> n(field.x[i], field.y[i], field.z[i]);
    CHECK(n.norm() == Approx(1).margin(1e-5));
    left += (n - kLeft).norm() < tolerance;
    right += (n - kRight).norm() < tolerance;
  }
  CHECK(left + right == field.size());
  CHECK(left > 1000);
  CHECK(right > 1000);
}

}  // namespace

TEST_CASE("stored normals come back") {
  const ScratchFolder folder;
  FileNormals source;
  source.options.folder = folder.path();
  ImageInput input;
  NormalField field;
  SECTION("8 bit and negated") {
    cv::imwrite((folder.path() / "17.png").string(), store<std::uint8_t>(CV_8UC3, 255, {-1, -1, -1}));
    input.name = "17";
    REQUIRE(source.fill(input, rendered_camera(), field) == NormalStatus::kOk);
    check_halves(field, 0.01);
  }
  SECTION("16 bit and other signs") {
    cv::imwrite((folder.path() / "frame.png").string(), store<std::uint16_t>(CV_16UC3, 65535, {1, -1, 1}));
    input.name = "frame";
    source.options.sign = {1, -1, 1};
    REQUIRE(source.fill(input, rendered_camera(), field) == NormalStatus::kOk);
    check_halves(field, 1e-4);
  }
  SECTION("other channels") {
    cv::Mat image = store<std::uint8_t>(CV_8UC3, 255, {1, 1, 1});
    cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
    cv::imwrite((folder.path() / "rgb.png").string(), image);
    input.name = "rgb";
    REQUIRE(parse_normal_encoding("r=+x g=+y b=+z", source.options));
    REQUIRE(source.fill(input, rendered_camera(), field) == NormalStatus::kOk);
    check_halves(field, 0.01);
  }
}

TEST_CASE("what cannot be used is named and leaves no normals") {
  const ScratchFolder folder;
  FileNormals source;
  source.options.folder = folder.path();
  ImageInput input;
  NormalField field;
  field.push_back(0, 0, -1, 1);
  input.name = "absent";
  CHECK(source.fill(input, rendered_camera(), field) == NormalStatus::kNoInput);
  CHECK(field.size() == 0);
  folder.write("broken.png", "no image");
  input.name = "broken";
  CHECK(source.fill(input, rendered_camera(), field) == NormalStatus::kUnreadable);
  CHECK(source.decode(cv::Mat(192, 200, CV_8UC3, cv::Scalar(1)), rendered_camera(), field) ==
        NormalStatus::kWrongSize);
  CHECK(source.decode(cv::Mat(192, 256, CV_8U, cv::Scalar(1)), rendered_camera(), field) ==
        NormalStatus::kWrongType);
  CHECK(source.decode(cv::Mat(192, 256, CV_32FC3, cv::Scalar(1)), rendered_camera(), field) ==
        NormalStatus::kWrongType);
}

TEST_CASE("vectors that are no normals are dropped") {
  FileNormals source;
  source.options.sign = {1, 1, 1};
  NormalField field;
  SECTION("far from unit length") {
    CHECK(source.decode(cv::Mat(192, 256, CV_8UC3, cv::Scalar(128, 128, 128)), rendered_camera(), field) ==
          NormalStatus::kOk);
    CHECK(field.size() == 0);
  }
  SECTION("turned away from the camera") {
    cv::Mat image(192, 256, CV_8UC3, cv::Scalar(128, 128, 0));
    image(cv::Rect(0, 0, 60, 192)).setTo(cv::Scalar(128, 128, 255));
    CHECK(source.decode(image, rendered_camera(), field) == NormalStatus::kOk);
    CHECK(field.size() > 1500);
    for (const float z : field.z) CHECK(z < -0.99F);
  }
  SECTION("most turned away: another convention") {
    CHECK(source.decode(cv::Mat(192, 256, CV_8UC3, cv::Scalar(128, 128, 255)), rendered_camera(), field) ==
          NormalStatus::kFacesAway);
    CHECK(field.size() == 0);
  }
}

TEST_CASE("an encoding that is none changes nothing") {
  FileNormalsOptions options;
  for (const char* text :
       {"", "r=+x g=+y", "r=+x g=+x b=+z", "r=x g=+y b=+z", "r=+x r=+y b=+z", "a=+x g=+y b=+z"})
    CHECK(!parse_normal_encoding(text, options));
  CHECK(options.channel == FileNormalsOptions().channel);
  CHECK(options.sign == FileNormalsOptions().sign);
}

TEST_CASE("an encoding says how far the normals of a plane may be off") {
  FileNormalsOptions options;
  REQUIRE(parse_normal_encoding("r=+x g=+y b=+z", options));
  CHECK(options.plane_sigma == 0);
  REQUIRE(parse_normal_encoding("r=+x g=+y b=+z plane_sigma_deg=4.7", options));
  CHECK(options.plane_sigma == radians(4.7));
  for (const char* end :
       {"plane_sigma_deg=", "plane_sigma_deg=x", "plane_sigma_deg=-1", "plane_sigma_deg=4 5", "4.7"})
    CHECK(!parse_normal_encoding(std::string("r=+x g=+y b=+z ") + end, options));
  CHECK(options.plane_sigma == radians(4.7));
}
