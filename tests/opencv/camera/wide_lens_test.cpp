// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/camera/wide_lens.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/opencv/camera/wide_view.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace wide_lens_camera_test {
using namespace sslam;

namespace {

WideLens lens_of(WideModel model, const std::array<double, 5>& k) {
  WideLens lens;
  lens.model = model;
  lens.k = k;
  lens.pinhole = {190.9, 190.8, 254.9, 256.8};
  lens.width = lens.height = 512;
  return lens;
}

Vec2<double> seen(const WideLens& lens, const Vec3<double>& ray) {
  Vec2<double> pixel;
  REQUIRE(lens.project(ray, pixel));
  return pixel;
}

constexpr std::array<double, 5> kTumVi{0.0034, 0.00076, -0.0008, 0.0002, 0};

std::string refusal(const std::filesystem::path& file) {
  try {
    (void)read_camera_file(file);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("A fisheye shows what OpenCV's fisheye module says, also beyond a right angle") {
  const WideLens lens = lens_of(WideModel::kFisheye, kTumVi);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> ray(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 1);
    std::vector<cv::Point2d> pixels;
    const cv::Matx33d matrix(lens.pinhole.fx, 0, lens.pinhole.cx, 0, lens.pinhole.fy, lens.pinhole.cy, 0, 0,
                             1);
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), ray.z()}}, pixels, cv::Vec3d(),
                               cv::Vec3d(), matrix, cv::Vec4d(lens.k[0], lens.k[1], lens.k[2], lens.k[3]));
    CHECK((seen(lens, 0.3 * ray) - Vec2<double>(pixels[0].x, pixels[0].y)).norm() < 1e-9);
  }
  // 100 degrees off the axis, without coefficients: 100 degrees times the focal length.
  const WideLens plain = lens_of(WideModel::kFisheye, {});
  const double angle = radians(100.0);
  CHECK(std::abs(seen(plain, {std::sin(angle), 0, std::cos(angle)}).x() -
                 (plain.pinhole.cx + plain.pinhole.fx * angle)) < 1e-9);
}

TEST_CASE("The wide models agree with each other where they are the same lens") {
  // A sphere seen from its rim is a stereographic lens: omni with xi 1, EUCM with alpha 0.5 and beta 1,
  // double sphere with its first sphere of no size and alpha 0.5. Their planes differ by a factor of 2.
  WideLens omni = lens_of(WideModel::kOmni, {1}), unified = lens_of(WideModel::kUnified, {0.5, 1}),
           spheres = lens_of(WideModel::kDoubleSphere, {0, 0.5});
  omni.pinhole.fx *= 2;
  omni.pinhole.fy *= 2;
  for (const double degrees_off : {0.0, 10.0, 60.0, 89.0, 90.0, 105.0}) {
    const double angle = radians(degrees_off);
    const Vec3<double> ray(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle));
    const double radius = 2 * std::tan(angle / 2);
    const Vec2<double> wanted(190.9 * radius * 0.6 + 254.9, 190.8 * radius * 0.8 + 256.8);
    for (const WideLens& lens : {omni, unified, spheres}) CHECK((seen(lens, ray) - wanted).norm() < 1e-6);
  }
  const double omega = 0.9;
  const WideLens fov = lens_of(WideModel::kFov, {omega});
  CHECK(std::abs(seen(fov, {1, 0, 1}).x() - (254.9 + 190.9 * std::atan(2 * std::tan(omega / 2)) / omega)) <
        1e-9);
}

TEST_CASE("A lens reaches to its image's edge or to where its model turns back") {
  const WideLens plain = lens_of(WideModel::kFisheye, {});
  CHECK(std::abs(degrees(plain.reach({1, 0})) - degrees((511 - 254.9) / 190.9)) < 0.5);
  CHECK(std::abs(degrees(plain.reach({0, -1})) - degrees(256.8 / 190.8)) < 0.5);
  // Largest where 1 + 3 k1 angle^2 is 0, at a radian.
  const WideLens folded = lens_of(WideModel::kFisheye, {-1.0 / 3});
  CHECK(std::abs(folded.reach({1, 0}) - 1) < 0.02);
  CHECK(std::abs(WideView::field_of(plain) - degrees(2 * 254.9 / 190.9)) < 1);
}

TEST_CASE("In the view of a wide lens straight edges are straight, and nothing is made up beyond its image") {
  const WideLens lens = lens_of(WideModel::kFisheye, kTumVi);
  const WideView view(lens, 120);
  CHECK(std::abs(degrees(2 * std::atan(256 / view.camera().pinhole.fx)) - 120) < 1e-9);
  CHECK(view.camera().distortion.is_identity());
  CHECK(view.seen().empty());  // TUM-VI's lens sees more than that in every direction
  // Each pixel holds where the lens has its ray: the image is a ramp.
  cv::Mat across(512, 512, CV_16UC1);
  for (int v = 0; v < 512; ++v)
    for (int u = 0; u < 512; ++u) across.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(64 * u);
  const cv::Mat seen_across = view.of(across);
  for (const cv::Point at : {cv::Point(5, 9), cv::Point(255, 255), cv::Point(400, 30), cv::Point(500, 505)}) {
    const Vec3<double> ray = view.camera().pinhole.unproject(Vec2<double>(at.x, at.y));
    CHECK(std::abs(seen_across.at<std::uint16_t>(at) / 64.0 - seen(lens, ray).x()) < 0.1);
  }
  WideLens cut = lens;  // as a video of 16:9: less is seen above and below
  cut.height = 288;
  cut.pinhole.cy = 143.5;
  const WideView flat(cut, 130);
  REQUIRE(flat.seen().size() == cv::Size(512, 288));
  CHECK(flat.seen().at<std::uint8_t>(144, 256) == 255);
  CHECK(flat.seen().at<std::uint8_t>(0, 256) ==
        (cut.reach({0, -1}) > std::atan(143.5 / flat.camera().pinhole.fy) ? 255 : 0));
}

TEST_CASE("Wide lenses in camera files are refused as a pinhole's and read as what they are") {
  const testing::ScratchFolder scratch;
  const auto read = [&](const char* name, const std::string& text) {
    const auto file = scratch.write(name, text);
    CHECK(refusal(file).find("undistort the images to a pinhole") != std::string::npos);
    return read_wide_camera_file(file);
  };
  const std::string head = "cam0:\n  camera_model: ", size = "  resolution: [512, 512]\n";
  const CameraFile tum =
      read("tum.yaml", head + "pinhole\n  intrinsics: [190.9, 190.8, 254.9, 256.8]\n" + size +
                           "  distortion_model: equidistant\n"
                           "  distortion_coeffs: [0.0034, 0.00076, -0.0008, 0.0002]\n");
  REQUIRE(tum.wide);
  CHECK(tum.wide->model == WideModel::kFisheye);
  CHECK(tum.wide->k == kTumVi);
  CHECK(tum.wide->pinhole.cy == 256.8);
  CHECK(tum.wide->width == 512);
  const CameraFile omni =
      read("omni.yaml", head + "omni\n  intrinsics: [1.2, 400, 401, 254, 255]\n" + size +
                            "  distortion_model: radtan\n  distortion_coeffs: [-0.1, 0.2, 0.003, -0.004]\n");
  CHECK(omni.wide->model == WideModel::kOmni);
  CHECK(omni.wide->k == std::array<double, 5>{1.2, -0.1, 0.2, 0.003, -0.004});
  CHECK(omni.camera.pinhole.fx == 400);
  const CameraFile spheres =
      read("ds.yaml", head + "ds\n  intrinsics: [-0.2, 0.6, 150, 151, 254, 255]\n" + size +
                          "  distortion_model: none\n  distortion_coeffs: []\n");
  CHECK(spheres.wide->model == WideModel::kDoubleSphere);
  CHECK(spheres.wide->k[1] == 0.6);
  CHECK(read("eucm.yaml", head + "eucm\n  intrinsics: [0.6, 1.1, 150, 151, 254, 255]\n" + size).wide->model ==
        WideModel::kUnified);
  CHECK(read("orb.yaml",
             "Camera.type: KannalaBrandt8\nCamera.fx: 190\nCamera.fy: 190\nCamera.cx: 254\nCamera.cy: 256\n"
             "Camera.k1: 0.0034\nCamera.k2: 0\nCamera.k3: 0\nCamera.k4: 0\nCamera.width: 512\n"
             "Camera.height: 512\n")
            .wide->k[0] == 0.0034);
  const auto broken =
      scratch.write("broken.yaml", head + "ds\n  intrinsics: [3, 0.6, 150, 151, 254, 255]\n" + size);
  CHECK(refusal(broken).find("the first numbers are none of the model 'ds'") != std::string::npos);
  const auto few = scratch.write("few.yaml", head + "omni\n  intrinsics: [150, 151, 254, 255]\n" + size);
  CHECK(refusal(few).find("expected 1 numbers of the model 'omni'") != std::string::npos);
}

}  // namespace wide_lens_camera_test
