// SPDX-License-Identifier: BSD-3-Clause
// Camera files of other SLAM and photogrammetry programs, of other encodings, and files that are no camera.
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/errors.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;

namespace program_cameras_test {
namespace {

CameraFile read_as(const std::string& text) {
  const testing::ScratchFolder folder;
  return read_wide_camera_file(folder.write("camera", text));
}

void check_plane(const CameraFile& file, const Pinhole<double>& expected, int width, int height) {
  const Pinhole<double>& p = file.camera.pinhole;
  INFO(p.fx << " " << p.fy << " " << p.cx << " " << p.cy);
  const double off = std::max({std::abs(p.fx - expected.fx), std::abs(p.fy - expected.fy),
                               std::abs(p.cx - expected.cx), std::abs(p.cy - expected.cy)});
  CHECK(off < 1e-9);
  CHECK(file.camera.width == width);
  CHECK(file.camera.height == height);
}

void check_lens(const CameraFile& file, const RadTan<double>& expected) {
  const RadTan<double>& lens = file.camera.distortion;
  CHECK(lens.k1 == expected.k1);
  CHECK(lens.k2 == expected.k2);
  CHECK(lens.p1 == expected.p1);
  CHECK(lens.p2 == expected.p2);
  CHECK(lens.k3 == expected.k3);
}

void check_refusal(const std::string& text, const std::string& part) {
  const std::string complaint = testing::error_of([&] { (void)read_as(text); });
  INFO(complaint);
  CHECK(complaint.find(part) != std::string::npos);
  CHECK(complaint.find('\n') == std::string::npos);
}

// Two bytes a letter, the low one first.
std::string utf16(std::string_view text) {
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  return wide;
}

constexpr Pinhole<double> kPlane{461.5, 460.25, 363, 248.5};

}  // namespace

TEST_CASE("A camera file in UTF-16 is read") {
  const std::string text = "fx: 461.5\r\nfy: 460.25\r\ncx: 363\r\ncy: 248.5\r\nwidth: 752\r\nheight: 480\r\n";
  check_plane(read_as(utf16(text)), kPlane, 752, 480);
  check_plane(read_as(utf16(text).substr(2)), kPlane, 752, 480);
}

TEST_CASE("Camera files of VINS-Fusion: pinhole, fisheye, mirror") {
  const std::string head = "%YAML:1.0\n---\ncamera_name: left\nimage_width: 752\nimage_height: 480\n";
  const CameraFile pinhole = read_as(
      head +
      "model_type: PINHOLE\ndistortion_parameters:\n   k1: -0.25\n   k2: 0.125\n   p1: 0.001\n"
      "   p2: 0.002\nprojection_parameters:\n   fx: 461.5\n   fy: 460.25\n   cx: 363\n   cy: 248.5\n");
  check_plane(pinhole, kPlane, 752, 480);
  check_lens(pinhole, {-0.25, 0.125, 0.001, 0.002, 0});
  const CameraFile mirror =
      read_as(head +
              "model_type: MEI\nmirror_parameters:\n   xi: 0.9\ndistortion_parameters:\n   k1: -0.1\n"
              "   k2: 0\n   p1: 0\n   p2: 0\nprojection_parameters:\n   gamma1: 461.5\n   gamma2: 460.25\n"
              "   u0: 363\n   v0: 248.5\n");
  check_plane(mirror, kPlane, 752, 480);
  REQUIRE(mirror.wide);
  CHECK(mirror.wide->model == WideModel::kOmni);
  CHECK(mirror.wide->k[0] == 0.9);
  CHECK(mirror.wide->k[1] == -0.1);
  const CameraFile fisheye =
      read_as(head +
              "model_type: KANNALA_BRANDT\nprojection_parameters:\n   k2: 0.5\n   k3: 0.1\n   k4: 0\n"
              "   k5: 0\n   mu: 161.5\n   mv: 160.25\n   u0: 363\n   v0: 248.5\n");
  REQUIRE(fisheye.wide);
  CHECK(fisheye.wide->k[0] == 0.5);
  check_refusal(head + "model_type: SCARAMUZZA\nprojection_parameters:\n   p0: 1\n", "SCARAMUZZA");
  check_refusal("%YAML:1.0\nimu: 1\ncam0_calib: \"left.yaml\"\n", "its camera file is left.yaml");
}

TEST_CASE("Camera files of OKVIS and Basalt") {
  const CameraFile okvis = read_as(
      "%YAML:1.0\ncameras:\n     - {T_SC:\n        [1, 0, 0, 0,\n         0, 1, 0, 0],\n"
      "        image_dimension: [752, 480],\n        distortion_coefficients: [-0.25, 0.125, 0.001, 0.002],\n"
      "        distortion_type: radialtangential,\n        focal_length: [461.5, 460.25],\n"
      "        principal_point: [363, 248.5]}\n     - {image_dimension: [752, 480]}\n");
  check_plane(okvis, kPlane, 752, 480);
  check_lens(okvis, {-0.25, 0.125, 0.001, 0.002, 0});
  REQUIRE(okvis.notes.size() == 1);
  CHECK(okvis.notes[0].find("has 2 cameras; the first is taken") != std::string::npos);
  const CameraFile basalt = read_as(
      "{\"value0\": {\"intrinsics\": [{\"camera_type\": \"ds\", \"intrinsics\": {\"fx\": 161.5, \"fy\": "
      "160.25,"
      " \"cx\": 363, \"cy\": 248.5, \"xi\": -0.25, \"alpha\": 0.5}}], \"resolution\": [[752, 480]]}}");
  check_plane(basalt, {161.5, 160.25, 363, 248.5}, 752, 480);
  REQUIRE(basalt.wide);
  CHECK(basalt.wide->model == WideModel::kDoubleSphere);
  CHECK(basalt.wide->k[1] == 0.5);
}

TEST_CASE("Camera files of OpenSfM and OpenDroneMap are parts of the image's longer side") {
  const CameraFile file = read_as(
      "{\"v2 maker 4000 3000 brown 0.6\": {\"projection_type\": \"brown\", \"width\": 4000, \"height\": 3000,"
      " \"focal_x\": 0.5, \"focal_y\": 0.75, \"c_x\": 0.0025, \"c_y\": -0.0025, \"k1\": 0.125, \"k2\": -0.25,"
      " \"p1\": 0.001, \"p2\": 0.002, \"k3\": 0.0625}}");
  check_plane(file, {2000, 3000, 2009.5, 1489.5}, 4000, 3000);
  check_lens(file, {0.125, -0.25, 0.001, 0.002, 0.0625});
  check_refusal("{\"a\": {\"projection_type\": \"spherical\", \"width\": 8, \"height\": 4, \"focal\": 1}}",
                "'spherical'");
}

TEST_CASE("Camera files of Meshroom and OpenMVG") {
  const std::string meshroom =
      "{\"views\": [], \"intrinsics\": [{\"width\": \"1920\", \"height\": \"1080\", \"sensorWidth\": \"36\","
      " \"type\": \"radial3\", \"distortionParams\": [\"0.125\", \"-0.25\", \"0.0625\"],";
  const std::string absolute = "\"pxFocalLength\": \"1500.5\", \"principalPoint\": [\"961\", \"541.5\"]}]}";
  const std::string relative = "\"focalLength\": \"27\", \"principalPoint\": [\"1\", \"1.5\"]}]}";
  check_plane(read_as(meshroom + absolute), {1500.5, 1500.5, 961, 541.5}, 1920, 1080);
  check_plane(read_as(meshroom + relative), {1440, 1440, 961, 541.5}, 1920, 1080);
  check_lens(read_as(meshroom + relative), {0.125, -0.25, 0, 0, 0.0625});
  const CameraFile openmvg = read_as(
      "{\"intrinsics\": [{\"key\": 0, \"value\": {\"polymorphic_name\": \"pinhole_brown_t2\", "
      "\"ptr_wrapper\":"
      " {\"data\": {\"width\": 1920, \"height\": 1080, \"focal_length\": 1500.5, \"principal_point\":"
      " [961, 541.5], \"disto_t2\": [0.125, -0.25, 0.0625, 0.001, 0.002]}}}}]}");
  check_plane(openmvg, {1500.5, 1500.5, 961, 541.5}, 1920, 1080);
  check_lens(openmvg, {0.125, -0.25, 0.001, 0.002, 0.0625});
}

TEST_CASE("Camera files of Metashape count from the middle, and have p1 and p2 in the other order") {
  const std::string numbers =
      "<f>3600.5</f><cx>-12.5</cx><cy>8.25</cy><k1>0.125</k1><k2>-0.25</k2>"
      "<k3>0.0625</k3><p1>0.001</p1><p2>0.002</p2>";
  const CameraFile alone = read_as(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<calibration>\n<projection>frame</projection>"
      "<width>4000</width><height>3000</height>" +
      numbers + "</calibration>\n");
  check_plane(alone, {3600.5, 3600.5, 1987, 1507.75}, 4000, 3000);
  check_lens(alone, {0.125, -0.25, 0.002, 0.001, 0.0625});
  const CameraFile whole = read_as(
      "<document><sensor><calibration type=\"frame\" class=\"initial\"><resolution width=\"4000\" "
      "height=\"3000\"/><f>3000</f></calibration><calibration type=\"frame\" class=\"adjusted\">"
      "<resolution width=\"4000\" height=\"3000\"/>" +
      numbers + "</calibration></sensor></document>");
  check_plane(whole, {3600.5, 3600.5, 1987, 1507.75}, 4000, 3000);
  check_refusal("<calibration><width>40</width><height>30</height><f>36</f><k4>0.1</k4></calibration>",
                "calibration.k4");
}

TEST_CASE("Rows of 'key = value', also below a section") {
  const std::string numbers = "fx = 461.5\nfy=460.25  # of the left one\ncx = \"363\"\ncy = 248.5\n";
  check_plane(read_as(numbers), kPlane, 0, 0);
  check_plane(read_as("; the left camera\n[LEFT]\n" + numbers + "width = 752\nheight = 480\n"), kPlane, 752,
              480);
  check_refusal("[LEFT]\n" + numbers + "[RIGHT]\n" + numbers, "has several cameras: LEFT, RIGHT");
  check_refusal("[LEFT]\nfx = 461.5\nfx = 462\n", "line 3: fx is given a second time");
  check_plane(read_as("colorWidth = 752\ncolorHeight = 480\nfx_color = 461.5\nfy_color = 460.25\n"
                      "mx_color = 363\nmy_color = 248.5\nsceneType = Office\n"),
              kPlane, 752, 480);
}

TEST_CASE("Of COLMAP's cameras the first is taken, and another size is told") {
  const CameraFile file = read_as(
      "# cameras\n1 PINHOLE 752 480 461.5 460.25 363.5 249\n"
      "2 PINHOLE 320 240 200 200 160 120\n");
  check_plane(file, kPlane, 752, 480);
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].find("the first is taken (752x480; another is of 320x240: ") != std::string::npos);
}

TEST_CASE("Files that hold no camera are told by their kind") {
  using namespace std::string_literals;
  check_refusal("PK\3\4\0\0abc"s, "NumPy's .npz");
  check_refusal("\x80\4\x95\0\0"s, "pickled by Python");
  check_refusal("\xff\xd8\xff\xe0\0\x10JFIF\0"s, "is an image");
  check_refusal("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "git lfs pull");
  check_refusal("<!DOCTYPE html>\n<html><body>Not Found</body></html>\n", "is a web page");
  check_refusal("500,5 501,25 320,5 240,75\n", "line 1: '500,5 501,25 320,5 240,75' has decimal commas");
  check_refusal("K: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n", "never calibrated");
}

}  // namespace program_cameras_test

namespace program_cameras_test {
namespace {

// A camera of an OAK as DepthAI writes it.
std::string depthai_camera(int socket, int type, double focal, int width, int height,
                           const std::string& lens) {
  const auto text = [](double value) { return std::to_string(value); };
  return "[" + std::to_string(socket) + ", {\"cameraType\": " + std::to_string(type) +
         ", \"distortionCoeff\": [" + lens +
         "],\n \"extrinsics\": {\"rotationMatrix\": [], \"toCameraSocket\": 1}, \"height\": " +
         std::to_string(height) + ",\n \"intrinsicMatrix\": [[" + text(focal) + ", 0.0, " +
         text(width / 2.0) + "], [0.0, " + text(focal) + ", " + text(height / 2.0) +
         "], [0.0, 0.0, 1.0]], \"lensPosition\": 0, \"specHfovDeg\": 71.0, \"width\": " +
         std::to_string(width) + "}]";
}

std::string depthai(const std::string& cameras) {
  return "{\"batchName\": \"\", \"boardName\": \"BW1098OBC\", \"cameraData\": [" + cameras +
         "],\n \"stereoRectificationData\": {\"leftCameraSocket\": 1}, \"version\": 7}";
}

constexpr const char* kStraight = "0,0,0,0,0,0,0,0,0,0,0,0,0,0";

}  // namespace
}  // namespace program_cameras_test

TEST_CASE("DepthAI's calibration of an OAK: all its cameras, by the names of their sockets") {
  using namespace program_cameras_test;
  const CameraFile file = read_as(
      depthai(depthai_camera(2, 0, 800, 1280, 800, kStraight) + ", " +
              depthai_camera(0, 0, 3000, 3840, 2160, "0.1,-0.2,0.001,0.002,0.05,0,0,0,0,0,0,0,0,0") + ", " +
              depthai_camera(1, 1, 560, 1280, 800, "0.1,0.02,-0.01,0.002,0,0,0,0,0,0,0,0,0,0")));
  CHECK(file.name == "CAM_C");
  check_plane(file, {800, 800, 640, 400}, 1280, 800);
  REQUIRE(file.others.size() == 2);
  CHECK(file.others[0].name == "CAM_A");
  check_plane(file.others[0], {3000, 3000, 1920, 1080}, 3840, 2160);
  CHECK(std::abs(file.others[0].camera.distortion.k1 - 0.1) < 1e-3);
  CHECK(camera_names(file) == "CAM_C (1280x800), CAM_A (3840x2160), CAM_B (1280x800)");
}

TEST_CASE("DepthAI's calibration: one camera alone, none that is calibrated, and several for who takes one") {
  using namespace program_cameras_test;
  const std::string none =
      "[3, {\"intrinsicMatrix\": [[0,0,0],[0,0,0],[0,0,0]], \"width\": 0, \"height\": 0}]";
  const CameraFile file = read_as(depthai(none + "," + depthai_camera(0, 0, 3000, 3840, 2160, kStraight)));
  CHECK(file.name == "CAM_A");
  CHECK(file.others.empty());
  check_refusal(depthai(none), "this device was never calibrated");
  check_refusal(depthai("[7]"), "cameraData[0] is no pair; expected pairs of a socket and its camera");
  check_refusal(depthai(depthai_camera(0, 2, 3000, 3840, 2160, kStraight)),
                "CAM_A: cameraType is 2; expected 0 (perspective) or 1 (fisheye)");
  const testing::ScratchFolder folder;
  const auto both = folder.write("oak.json", depthai(depthai_camera(1, 0, 800, 1280, 800, kStraight) + "," +
                                                     depthai_camera(2, 0, 801, 1280, 800, kStraight)));
  CHECK(testing::error_of([&] {
          (void)read_camera_file(both);
        }).find("has several cameras: CAM_B (1280x800), CAM_C (1280x800); expected one") !=
        std::string::npos);
}

TEST_CASE("Coefficients of a thin prism and of a tilted sensor are fitted, too") {
  using namespace program_cameras_test;
  // By OpenCV's own projection of a ray.
  const std::string lens =
      "-0.1,0.05,0.001,-0.002,0.01,0.02,0.01,0.005,0.0005,-0.0002,0.0003,0.0001,0.0015,-0.001";
  const CameraFile file = read_as(depthai(depthai_camera(0, 0, 800, 1280, 800, lens)));
  REQUIRE(file.notes.size() == 1);
  const std::vector<double> k{-0.1,  0.05,   0.001,   -0.002, 0.01,   0.02,   0.01,
                              0.005, 0.0005, -0.0002, 0.0003, 0.0001, 0.0015, -0.001};
  const cv::Matx33d matrix(800, 0, 640, 0, 800, 400, 0, 0, 1);
  for (const auto& [x, y] : {std::pair{0.3, 0.2}, {-0.6, 0.3}, {0.5, -0.4}, {0.0, 0.0}}) {
    std::vector<cv::Point2d> pixel;
    cv::projectPoints(std::vector<cv::Point3d>{{x, y, 1}}, cv::Vec3d(), cv::Vec3d(), matrix, k, pixel);
    const Vec2<double> bent = file.camera.distortion.distort(Vec2<double>(x, y));
    const double off = std::hypot(800 * bent.x() + 640 - pixel[0].x, 800 * bent.y() + 400 - pixel[0].y);
    INFO(x << " " << y << " " << off);
    CHECK(off < 0.5);
  }
}

TEST_CASE("Cameras of SVO, mrcal, Gyroflow, MonoGS, a stereo pair of OpenCV and ARKitScenes") {
  using namespace program_cameras_test;
  const CameraFile svo = read_as(
      "label: rig\ncameras:\n- camera:\n    label: cam0\n    image_height: 480\n    image_width: 752\n"
      "    type: pinhole\n    intrinsics:\n      cols: 1\n      rows: 4\n      data: [461.5, 460.25, 363, "
      "248.5]\n"
      "    distortion:\n      type: radial-tangential\n      parameters:\n        cols: 1\n        rows: 4\n"
      "        data: [-0.25, 0.125, 0.001, -0.002]\n");
  check_plane(svo, kPlane, 752, 480);
  check_lens(svo, {-0.25, 0.125, 0.001, -0.002, 0});
  const CameraFile mrcal = read_as(
      "{\n    'lensmodel':  'LENSMODEL_OPENCV5',\n    # fx,fy,cx,cy,distortion0,...\n"
      "    'intrinsics': [ 461.5, 460.25, 363, 248.5, -0.25, 0.125, 0.001, -0.002, 0.5],\n"
      "    'imagersize': [ 752, 480 ],\n}\n");
  check_plane(mrcal, kPlane, 752, 480);
  check_refusal(
      "{'lensmodel': 'LENSMODEL_SPLINED_STEREOGRAPHIC_order=3', 'intrinsics': [1,2,3,4], "
      "'imagersize': [752, 480]}",
      "LENSMODEL_SPLINED_STEREOGRAPHIC");
  const CameraFile gyroflow = read_as(
      "{\"name\": \"GoPro\", \"calib_dimension\": {\"w\": 752, \"h\": 480}, \"fps\": 59.94, "
      "\"fisheye_params\": "
      "{\"camera_matrix\": [[461.5, 0, 363], [0, 460.25, 248.5], [0, 0, 1]], "
      "\"distortion_coeffs\": [0.05, 0.01, 0, 0]}}");
  check_plane(gyroflow, kPlane, 752, 480);
  CHECK(gyroflow.frame_rate == 59.94);
  check_plane(read_as("Dataset:\n  type: tum\n  Calibration:\n    fx: 461.5\n    fy: 460.25\n    cx: 363\n"
                      "    cy: 248.5\n    width: 752\n    height: 480\n"),
              kPlane, 752, 480);
  const CameraFile pair = read_as(
      "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 461.5, 0., 363., 0., 460.25, 248.5, 0., 0., 1. ]\nD1: !!opencv-matrix\n   rows: 1\n"
      "   cols: 5\n   dt: d\n   data: [ -0.25, 0.125, 0., 0., 0. ]\nM2: !!opencv-matrix\n   rows: 3\n"
      "   cols: 3\n   dt: d\n   data: [ 1., 0., 3., 0., 1., 2., 0., 0., 1. ]\n");
  check_plane(pair, kPlane, 0, 0);
  check_lens(pair, {-0.25, 0.125, 0, 0, 0});
  REQUIRE(pair.notes.size() == 1);
  CHECK(pair.notes[0].find("has two cameras; the first, M1 and D1, is taken") != std::string::npos);
  const CameraFile pincam = read_as("752 480 461.5 460.25 363 248.5\n");
  check_plane(pincam, kPlane, 752, 480);
  CHECK(pincam.notes.size() == 1);
  check_refusal("461.5 460.25 363 248.5 0.1 0.2\n", "rows of numbers that are no calibration");
}

TEST_CASE("Several cameras by ORB-SLAM3's numbers: the first is taken, and that is told") {
  using namespace program_cameras_test;
  const auto camera = [](const std::string& name, const std::string& fx) {
    return name + ".fx: " + fx + "\n" + name + ".fy: 460.25\n" + name + ".cx: 363\n" + name + ".cy: 248.5\n" +
           name + ".k1: -0.25\n" + name + ".k2: 0.125\n" + name + ".p1: 0.001\n" + name + ".p2: -0.002\n";
  };
  const std::string head = "%YAML:1.0\n---\nCamera.type: \"PinHole\"\n",
                    size = "Camera.width: 752\nCamera.height: 480\n";
  for (const char* first : {"Camera0", "Camera1"}) {
    const CameraFile file = read_as(head + camera("Camera2", "400") + camera(first, "461.5") + size);
    check_plane(file, kPlane, 752, 480);
    check_lens(file, {-0.25, 0.125, 0.001, -0.002, 0});
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes[0].find(std::string("the first, ") + first + ".fx") != std::string::npos);
  }
  CHECK(read_as(head + camera("Camera0", "461.5") + size).notes.empty());
}

TEST_CASE("Azure Kinect's raw calibration: parts of a sensor of 4:3, whose middle is the image of 16:9") {
  using namespace program_cameras_test;
  const auto kinect = [](const std::string& numbers) {
    return "{\"CalibrationInformation\":{\"Cameras\":[{\"Intrinsics\":{\"ModelParameterCount\":14,"
           "\"ModelParameters\":"
           "[0.9,0.9,0.4,0.4,0,0,0,0,0,0,0,0,0,0],\"ModelType\":\"CALIBRATION_"
           "LensDistortionModelBrownConrady\"},"
           "\"Location\":\"CALIBRATION_CameraLocationD0\",\"Purpose\":\"CALIBRATION_CameraPurposeDepth\"},"
           "{\"Intrinsics\":{\"ModelParameterCount\":14,\"ModelParameters\":[" +
           numbers +
           "],\"ModelType\":\"CALIBRATION_LensDistortionModelBrownConrady\"},"
           "\"Location\":\"CALIBRATION_CameraLocationPV0\",\"Purpose\":\"CALIBRATION_"
           "CameraPurposePhotoVideo\"}]}}";
  };
  const CameraFile file =
      read_as(kinect("0.5,0.5078125,0.4765625,0.6328125,0.125,0,0,0,0,0,0,0,-0.002,0.001"));
  CHECK(file.name == "color_4x3");
  check_plane(file, {1952, 1944, 2047.5, 1559.5}, 4096, 3072);
  CHECK(std::abs(file.camera.distortion.p1 - 0.001) < 1e-4);  // by a fit
  CHECK(std::abs(file.camera.distortion.p2 + 0.002) < 1e-4);
  REQUIRE(file.others.size() == 1);
  check_plane(file.others[0], {1830, 1822.5, 1919.5, 1102}, 3840, 2160);
  check_refusal(kinect("0.5,0.5,0.4,0.6,0,0,0,0,0,0,0.1,0,0,0"), "its centre of distortion is moved");
  check_refusal(kinect("960,540,900,900,0,0,0,0,0,0,0,0,0,0"), "the first four as parts of the sensor");
  check_refusal("{\"CalibrationInformation\":{\"Cameras\":[]}}", "has no colour camera");
}

TEST_CASE("OpenLORIS: its sensors by name, with fx cx fy cy") {
  using namespace program_cameras_test;
  const auto sensor = [](const std::string& name, const std::string& numbers, int height,
                         const std::string& model) {
    return name + ":\n   sensor_type: camera\n   sensor_name: " + name +
           "\n   fps: 30\n   width: 752\n   height: " + std::to_string(height) +
           "\n   model: pinhole\n   intrinsics: !!opencv-matrix\n      rows: 1\n      cols: 4\n"
           "      dt: d\n      data: [ " +
           numbers + " ]\n   distortion_model: " + model +
           "\n   distortion_coefficients: !!opencv-matrix\n      rows: 1\n      cols: 5\n      dt: d\n"
           "      data: [ 0., 0., 0., 0., 0. ]\n";
  };
  const std::string head = "%YAML:1.0\n",
                    imu = "d400_gyroscope:\n   sensor_type: gyroscope\n   sensor_name: d400_gyroscope\n";
  const std::string colour =
      sensor("d400_color_optical_frame", "461.5, 363., 460.25, 248.5", 480, "radial-tangential");
  const CameraFile file = read_as(
      head + imu + sensor("d400_depth_optical_frame", "400., 363., 400., 248.5", 480, "none") + colour +
      sensor("t265_fisheye1_optical_frame", "285., 420., 286., 398.", 800, "Kannala-Brandt"));
  CHECK(file.name == "d400_color_optical_frame");
  check_plane(file, kPlane, 752, 480);
  REQUIRE(file.others.size() == 1);
  CHECK(file.others[0].name == "t265_fisheye1_optical_frame");
  CHECK(file.others[0].camera.pinhole.cx == 420);
  check_plane(read_as(head + sensor("color", "461.5, 460.25, 363., 248.5", 480, "none")), kPlane, 752, 480);
  check_refusal(head + sensor("color", "461.5, 0., 363., 248.5", 480, "none"),
                "expected the four numbers fx cx fy cy");
}

TEST_CASE("A camera below the names of its numbers, with a word before them, or as cam_K") {
  using namespace program_cameras_test;
  check_plane(read_as("fx,fy,cx,cy\n461.5,460.25,363,248.5\n"), kPlane, 0, 0);
  const CameraFile named = read_as("# width height fx fy cx cy k1\n752 480 461.5 460.25 363 248.5 -0.25\n");
  check_plane(named, kPlane, 752, 480);
  CHECK(named.camera.distortion.k1 == -0.25);
  check_refusal("fx fy cx\n461.5 460.25 363\n", "cy is missing");
  check_plane(read_as("{\"cam_K\": [461.5, 0, 363, 0, 460.25, 248.5, 0, 0, 1], \"depth_scale\": 1.0}"),
              kPlane, 0, 0);
  const CameraFile prefixed = read_as(
      "rgb_fx: 461.5\nrgb_fy: 460.25\nrgb_cx: 363\nrgb_cy: 248.5\nrgb_k1: -0.25\nwidth: 752\nheight: 480\n");
  check_plane(prefixed, kPlane, 752, 480);
  CHECK(prefixed.camera.distortion.k1 == -0.25);
  CHECK(prefixed.notes.size() == 1);
  check_refusal("a_fx: 1\na_fy: 1\na_cx: 1\na_cy: 1\nb_fx: 1\nb_fy: 1\nb_cx: 1\nb_cy: 1\n",
                "has several cameras: a_fx, b_fx");
}

TEST_CASE("A list of coefficients that is cut off or may mean two things is refused") {
  using namespace program_cameras_test;
  const auto ros = [](const std::string& coefficients) {
    return "image_width: 752\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
           "  data: [461.5, 0, 363, 0, 460.25, 248.5, 0, 0, 1]\ndistortion_model: plumb_bob\n"
           "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [" +
           coefficients + "]\n";
  };
  check_lens(read_as(ros("-0.25, 0.125, 0.001, -0.002, 0.5")), {-0.25, 0.125, 0.001, -0.002, 0.5});
  check_refusal(ros("-0.25, 0.125, 0.001"), "has 3 numbers, and by its rows and cols 5");
  check_refusal(
      "{\"camera_matrix\": [[461.5, 0, 363], [0, 460.25, 248.5], [0, 0, 1]], \"dist_coeff\": [-0.25, 0.125, "
      "0.5]}",
      "the distortion has 3 coefficients, which may be k1 k2 k3 or k1 k2 p1");
}

TEST_CASE("What calibration programs write beside their camera file is refused with the file's name") {
  using program_cameras_test::check_refusal;
  check_refusal("# oST version 5.0 parameters\n\n\n[image]\n\nwidth\n640\n",
                "expected the ost.yaml beside it");
  check_refusal(
      "Calibration results\n====\ncam0 (/cam0/image_raw):\n    distortion: [-0.1 0.02] +- [0 0]\n"
      "    projection: [461 460 363 248] +- [1 1 1 1]\n",
      "expected the camchain.yaml beside it");
  check_refusal("% Camera\nfc = [ 657.3 ; 657.7 ];\ncc = [ 302 ; 242 ];\nkc = [ -0.2 ; 0.1 ; 0 ; 0 ; 0 ];\n",
                "is a script of MATLAB's calibration toolbox");
}

TEST_CASE("YAML with anchors, long texts and merged maps, as PyYAML and people write it") {
  using namespace program_cameras_test;
  const std::string kalibr =
      "base: &base\n  camera_model: pinhole\n  distortion_model: radtan\n  resolution: [752, 480]\n"
      "cam0:\n  <<: *base\n  comment: |\n    of Monday: the\n\n      left one\n  resolution: [640, 480]\n"
      "  intrinsics: &plane [461.5, 460.25, 363, 248.5]\n  distortion_coeffs: [0, 0, 0, 0]\n";
  const CameraFile file = read_as(kalibr + "cam1:\n  intrinsics: *plane\n");
  check_plane(file, kPlane, 640, 480);  // what the map has itself counts
  REQUIRE_FALSE(file.notes.empty());
  CHECK(file.notes.back().find("has 2 cameras; cam0 is taken") != std::string::npos);
  check_refusal("fx: *nowhere\n", "line 1: '*nowhere' is named nowhere before");
  std::string copies = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (char name = 'b'; name < 'k'; ++name) {
    copies += std::string(1, name) + ": &" + name + "\n";
    for (int i = 0; i < 10; ++i) copies += std::string("- *") + static_cast<char>(name - 1) + "\n";
  }
  check_refusal(copies, "repeats more than any calibration holds");
  check_refusal("fx:461.5\nfy:460.25\n", "YAML needs a blank behind the colon");
}

TEST_CASE("A camera is found below other maps, in a list, and whatever the case of its keys") {
  using namespace program_cameras_test;
  const std::string numbers = R"("fx": "461.5", "fy": 460.25, "cx": 363, "cy": 248.5)";
  check_plane(read_as("{\"sensors\": {\"rgb_left\": {\"calibration\": {" + numbers + "}}}}"), kPlane, 0, 0);
  check_plane(read_as("[{" + numbers + ", \"width\": 752, \"height\": 480}]"), kPlane, 752, 480);
  check_refusal("{\"rig\": [{\"a\": {" + numbers + "}}, {\"b\": {" + numbers + "}}]}",
                "has several cameras: rig[0].a, rig[1].b");
  check_plane(read_as("FX: 461.5\nFY: 460.25\nCX: 363\nCY: 248.5\nWidth: 752\nHeight: 480\n"), kPlane, 752,
              480);
  check_plane(read_as("cam1:\n  camera_model: pinhole\n  intrinsics: [461.5, 460.25, 363, 248.5]\n"
                      "  distortion_model: none\n  distortion_coeffs: []\n  resolution: [752, 480]\n"),
              kPlane, 752, 480);
}

TEST_CASE("Numbers of a camera in one row with their names, in NumPy's print, or below a comment") {
  using namespace program_cameras_test;
  for (const char* row :
       {"fx=461.5, fy=460.25, cx=363, cy=248.5\n", "fx: 461.5; fy: 460.25; cx: 363; cy: 248.5",
        "% fx fy cx cy\n461.5 460.25 363 248.5\n", "// fx fy cx cy\n461.5 460.25 363 248.5\n",
        "[camera]\nfx = 461.5 ; pixels\nfy = 460.25\ncx = 363\ncy = 248.5\n",
        "array([[461.5 ,   0.  , 363.  ],\n       [  0.  , 460.25, 248.5 ],\n"
        "       [  0.  ,   0.  ,   1.  ]])\n"}) {
    INFO(row);
    check_plane(read_as(row), kPlane, 0, 0);
  }
  const CameraFile square = read_as(R"({"f": 461.5, "cx": 363, "cy": 248.5, "width": 752, "height": 480})");
  check_plane(square, {461.5, 461.5, 363, 248.5}, 752, 480);
  check_plane(
      read_as("focal_length: [461.5, 460.25]\nprincipal_point: [363, 248.5]\nimage_size: [752, 480]\n"),
      kPlane, 752, 480);
  check_refusal("  Width:   640\n  PPX:   320\n  PPY:   240\n  Fx:   600\n  Fy:   600\n",
                "is what RealSense's tools print");
}

TEST_CASE("The size beside a matrix as a list, a region of ROS, and a lens under a name of its own") {
  using namespace program_cameras_test;
  const std::string matrix = "[461.5, 0, 363, 0, 460.25, 248.5, 0, 0, 1]";
  for (const char* name : {"image_size", "resolution", "imageResolution"})
    check_plane(read_as("{\"camera_matrix\": " + matrix + ", \"" + name + "\": [752, 480]}"), kPlane, 752,
                480);
  const std::string ros =
      "width: 752\nheight: 480\nK: " + matrix + "\nroi:\n  x_offset: 60\n  y_offset: 40\n";
  const CameraFile region = read_as(ros + "  width: 640\n  height: 400\n");
  check_plane(region, {461.5, 460.25, 303, 208.5}, 640, 400);
  REQUIRE(region.notes.size() == 1);
  CHECK(region.notes[0].find("region of interest (roi), 640x400") != std::string::npos);
  check_plane(read_as(ros + "  width: 0\n  height: 0\n"), kPlane, 752, 480);
  check_refusal("K: " + matrix + "\nradial_distortion: [0.1, -0.2]\n",
                "line 2: radial_distortion is not known");
}
