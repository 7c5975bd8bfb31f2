// SPDX-License-Identifier: BSD-3-Clause
// Camera files of other programs, in the form that their documentation gives.
#include <cmath>
#include <string>

#include "io/errors.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;

namespace {

CameraFile read_written(const std::string& text, const std::string& name = "camera.yaml") {
  const testing::ScratchFolder folder;
  return read_camera_file(folder.write(name, text));
}

void check_camera_values(const CameraFile& file, const Pinhole<double>& pinhole, const RadTan<double>& lens,
                         int width, int height) {
  const Pinhole<double>& p = file.camera.pinhole;
  const RadTan<double>& d = file.camera.distortion;
  CHECK(p.fx == pinhole.fx);
  CHECK(p.fy == pinhole.fy);
  CHECK(p.cx == pinhole.cx);
  CHECK(p.cy == pinhole.cy);
  CHECK(d.k1 == lens.k1);
  CHECK(d.k2 == lens.k2);
  CHECK(d.p1 == lens.p1);
  CHECK(d.p2 == lens.p2);
  CHECK(d.k3 == lens.k3);
  CHECK(file.camera.width == width);
  CHECK(file.camera.height == height);
}

void check_refused(const std::string& text, const std::string& part) {
  const std::string complaint = testing::error_of([&] { (void)read_written(text); });
  INFO(complaint);
  CHECK(complaint.find(part) != std::string::npos);
  CHECK(complaint.find('\n') == std::string::npos);
}

constexpr Pinhole<double> kWritten{500.5, 501.25, 320.5, 240.75};
constexpr RadTan<double> kWrittenLens{0.125, -0.25, 0.001, 0.002, 0.0625};

}  // namespace

TEST_CASE("OpenCV's FileStorage, as YAML and as XML") {
  check_camera_values(
      read_written(
          "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
          "   cols: 3\n   dt: d\n   data: [ 500.5, 0., 320.5, 0., 501.25,\n       240.75, 0., 0., 1. ]\n"
          "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
          "   data: [ 0.125, -0.25, 1.0e-03, 2e-3, 0.0625 ]\n"),
      kWritten, kWrittenLens, 640, 480);
  check_camera_values(
      read_written(
          "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n"
          "<image_height>480</image_height>\n<camera_matrix type_id=\"opencv-matrix\"><rows>3</rows>"
          "<cols>3</cols><dt>d</dt>\n<data>500.5 0. 320.5 0. 501.25 240.75 0. 0. 1.</data></camera_matrix>\n"
          "<distortion_coefficients type_id=\"opencv-matrix\"><rows>5</rows><cols>1</cols><dt>d</dt>\n"
          "<data>0.125 -0.25 0.001 0.002 0.0625</data></distortion_coefficients>\n</opencv_storage>\n"),
      kWritten, kWrittenLens, 640, 480);
}

TEST_CASE(
    "XML with elements in elements without end is refused before it is parsed, whatever hides their ends") {
  const std::string head = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
  // Closing tags that are none: OpenCV takes the last comment to end at the second -->.
  for (const char* part : {"<a>", "<a><!-- </a> -->", "<a b='</a>'>", "<a><!--></a>-->"}) {
    std::string text = head;
    for (int i = 0; i < 100'000; ++i) text += part;
    check_refused(text, "has more than 4000 XML elements");
  }
}

TEST_CASE("A key in quotes that spans lines gives a message of one line") {
  check_refused("\"one\ntwo\": pu\n", "one");
}

TEST_CASE("ROS camera_info: the calibrator's file, and messages of ROS 1 and 2") {
  check_camera_values(
      read_written(
          "image_width: 640\nimage_height: 480\ncamera_name: cam\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
          "  data: [500.5, 0, 320.5, 0, 501.25, 240.75, 0, 0, 1]\ndistortion_model: plumb_bob\n"
          "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.125, -0.25, 0.001, 0.002, 0.0625]\n"),
      kWritten, kWrittenLens, 640, 480);
  check_camera_values(
      read_written(
          "header: \n  seq: 0\n  stamp: \n    secs: 0\n  frame_id: \"cam\"\nheight: 480\nwidth: 640\n"
          "distortion_model: \"plumb_bob\"\nD: [0.125, -0.25, 0.001, 0.002, 0.0625]\n"
          "K: [500.5, 0.0, 320.5, 0.0, 501.25, 240.75, 0.0, 0.0, 1.0]\nroi: \n  do_rectify: "
          "False\n---\nx: 1\n"),
      kWritten, kWrittenLens, 640, 480);
  check_camera_values(
      read_written("height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd:\n- 0.125\n- -0.25\n- 0.001\n"
                   "- 0.002\n- 0.0625\nk:\n- 500.5\n- 0.0\n- 320.5\n- 0.0\n- 501.25\n- 240.75\n- 0.0\n"
                   "- 0.0\n- 1.0\n---\n"),
      kWritten, kWrittenLens, 640, 480);
}

TEST_CASE("Kalibr's camchain and the sensor.yaml of EuRoC") {
  const RadTan<double> lens{0.125, -0.25, 0.001, 0.002, 0};
  check_camera_values(
      read_written("cam0:\n  T_cam_imu:\n  - [0.01, 0.02, 0.03, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n"
                   "  cam_overlaps: [1]\n  camera_model: pinhole\n"
                   "  distortion_coeffs: [0.125, -0.25, 0.001, 0.002]\n  distortion_model: radtan\n"
                   "  intrinsics: [500.5, 501.25, 320.5, 240.75]\n  resolution: [640, 480]\ncam1: {}\n"),
      kWritten, lens, 640, 480);
  const CameraFile euroc = read_written(
      "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0 (MT9M034)\n\nT_BS:\n  "
      "cols: 4\n"
      "  rows: 4\n  data: [0.01, -0.99, 0.0,\n         0.99, 0.01]\nrate_hz: 20\nresolution: [640, 480]\n"
      "camera_model: pinhole\nintrinsics: [500.5, 501.25, 320.5, 240.75] #fu, fv, cu, cv\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: [0.125, -0.25, 0.001, 0.002]\n");
  check_camera_values(euroc, kWritten, lens, 640, 480);
  CHECK(euroc.frame_rate == 20);
}

TEST_CASE("stella_vslam, flat and nested, and ORB-SLAM3 with tabs and a byte order mark") {
  const std::string lens = "k1: 0.125\n  k2: -0.25\n  p1: 0.001\n  p2: 0.002\n  k3: 0.0625\n";
  const CameraFile nested = read_written(
      "Camera:\n  name: \"x\"\n  setup: monocular\n  model: \"perspective\"\n  fx: 500.5\n  fy: 501.25\n"
      "  cx: 320.5\n  cy: 240.75\n  " +
      lens + "  fps: 20.0\n  cols: 640\n  rows: 480\nPreprocessing:\n  mask:\n    - [0.0, 1.0]\n");
  check_camera_values(nested, kWritten, kWrittenLens, 640, 480);
  CHECK(nested.frame_rate == 20);
  check_camera_values(
      read_written("Camera.model: \"perspective\"\nCamera.fx: 500.5\nCamera.fy: 501.25\nCamera.cx: 320.5\n"
                   "Camera.cy: 240.75\nCamera.cols: 640\nCamera.rows: 480\n"),
      kWritten, {}, 640, 480);
  check_camera_values(
      read_written("\xef\xbb\xbf%YAML:1.0\r\n---\r\nCamera1.fx:\t500.5\r\nCamera1.fy:\t501.25\r\n"
                   "Camera1.cx:\t320.5\r\nCamera1.cy:\t240.75\r\nCamera.width: 640\r\n"
                   "Camera.height: 480\r\nCamera.newWidth: 320\r\n"),
      kWritten, {}, 640, 480);
}

TEST_CASE("COLMAP and nerfstudio count the first pixel's centre as a half") {
  const Pinhole<double> moved{500.5, 501.25, 320, 240.25};
  const RadTan<double> lens{0.125, -0.25, 0.001, 0.002, 0};
  check_camera_values(
      read_written("# Camera list\n1 OPENCV 640 480 500.5 501.25 320.5 240.75 0.125 -0.25 0.001 0.002\n",
                   "cameras.txt"),
      moved, lens, 640, 480);
  check_camera_values(
      read_written("1 SIMPLE_RADIAL 640 480 500.5 320.5 240.75 0.125\n2 PINHOLE 640 480 1 1 1 1\n"),
      {500.5, 500.5, 320, 240.25}, {0.125, 0, 0, 0, 0}, 640, 480);
  check_camera_values(
      read_written(
          "{\n\t\"fl_x\": 500.5, \"fl_y\":501.25, \"cx\":320.5, \"cy\":240.75, \"w\":640, \"h\":480,\n"
          "\t\"k1\":0.125, \"k2\":-0.25, \"p1\":0.001, \"p2\":0.002, \"camera_model\":\"OPENCV\",\n"
          "\t\"frames\":[{\"file_path\":\"a\", \"transform_matrix\":[[1,0],[0,1]]}]}"),
      moved, lens, 640, 480);
  const CameraFile angle =
      read_written("{\"camera_angle_x\": 1.5707963267948966, \"w\": 640, \"h\": 480, \"frames\": []}");
  CHECK(std::abs(angle.camera.pinhole.fy - 320) < 1e-9);
  CHECK(angle.camera.pinhole.cx == 319.5);
  check_refused("{\"camera_angle_x\": 1.0, \"frames\": []}",
                "camera_angle_x without w and h; give --fov 57.2958");
}

TEST_CASE("A COLMAP camera with more or fewer numbers than its model has is refused") {
  check_refused("1 PINHOLE 640 480 500 500 320 240 0.125\n",
                "PINHOLE has 7 numbers; expected 6: the width, the height, and 4 of the model");
  check_refused("1 OPENCV 640 480 500 500 320 240 0.125\n", "OPENCV has 7 numbers; expected 10");
  check_refused("1 THIN_PRISM_FISHEYE 640 480 500 500 320 240 0 0 0 0 0 0 0 0\n",
                "the lens model 'THIN_PRISM_FISHEYE' is not known here");
}

TEST_CASE("Distortion is read under all its names, and one that is not known is refused") {
  const std::string k = "\"K\": [[500.5, 0, 320.5], [0, 501.25, 240.75], [0, 0, 1]], ";
  const RadTan<double> lens{0.125, -0.25, 0.001, 0.002, 0.0625};
  for (const char* name : {"dist_coeff", "dist_coefs", "distortion_coef", "D"}) {
    CAPTURE(name);
    const std::string list = std::string("\"") + name + "\": [[0.125, -0.25, 0.001, 0.002, 0.0625]]}";
    check_camera_values(read_written("{" + k + list), kWritten, lens, 0, 0);
    check_camera_values(
        read_written("{\"fx\": 500.5, \"fy\": 501.25, \"cx\": 320.5, \"cy\": 240.75, " + list), kWritten,
        lens, 0, 0);
  }
  check_camera_values(
      read_written("{" + k + "\"k1\": 0.125, \"k2\": -0.25, \"p1\": 0.001, \"p2\": 0.002, \"k3\": 0.0625}"),
      kWritten, lens, 0, 0);
  check_refused("{" + k + "\"distortionVector\": [0.125, -0.25, 0.001, 0.002]}",
                "distortionVector is not known here; expected distortion_coefficients");
}

TEST_CASE("A matrix as programs print it, and under the names of Open3D and ARKit") {
  const std::string text = GENERATE(
      as<std::string>(), "500.5, 0, 320.5\n0, 501.25, 240.75\n0, 0, 1\n",
      "[[500.5 0. 320.5]\n [0. 501.25 240.75]\n [0. 0. 1.]]\n", "500.5;0;320.5\n0;501.25;240.75\n0;0;1\n",
      "[[500.5, 0, 320.5], [0, 501.25, 240.75], [0, 0, 1]]", "500.5 0 320.5 0 501.25 240.75 0 0 1\n",
      "{\"intrinsics\": [500.5, 0, 0, 0, 501.25, 0, 320.5, 240.75, 1]}",
      "{\"intrinsic\": {\"intrinsic_matrix\": [500.5, 0, 0, 0, 501.25, 0, 320.5, 240.75, 1]}}",
      "Camera:\n  fx: 500.5\n  fy: 501.25\n  cx: 320.5\n  cy: 240.75\n", "500.5, 501.25, 320.5, 240.75\n");
  CAPTURE(text);
  check_camera_values(read_written(text), kWritten, {}, 0, 0);
}

TEST_CASE("Frames with focal lengths of their own are told, with how far they go") {
  const auto notes = [](const std::string& second) {
    const std::string rest = ", \"fl_y\": 500, \"cx\": 320, \"cy\": 240, \"w\": 640, \"h\": 480}";
    const CameraFile file =
        read_written("{\"frames\": [{\"fl_x\": 500" + rest + ", {\"fl_x\": " + second + rest + "]}");
    CHECK(file.camera.pinhole.fx == 500);
    return file.notes.at(0);
  };
  CHECK(notes("501").ends_with("the camera is that of the first of its frames"));
  CHECK(notes("620").ends_with("of its frames; their focal lengths go from 500 to 620 pixels"));
}

TEST_CASE("An angle of view in degrees is told") {
  check_refused(
      "{\"camera_angle_x\": 67.4, \"w\": 640, \"h\": 480, \"frames\": []}",
      "camera_angle_x is 67.4; expected the horizontal field of view in radians; are these degrees, "
      "give --fov 67.4");
}

TEST_CASE("DSO's camera.txt in pixels and in shares of the image") {
  check_camera_values(
      read_written("RadTan 500.5 501.25 320.5 240.75 0.125 -0.25 0.001 0.002\n640 480\ncrop\n640 480\n"),
      kWritten, {0.125, -0.25, 0.001, 0.002, 0}, 640, 480);
  check_camera_values(read_written("0.5 0.75 0.5 0.5 0\n640 480\nfull\n640 480\n"), {320, 360, 319.5, 239.5},
                      {}, 640, 480);
}

TEST_CASE("RealSense, Open3D, KITTI and rows of numbers") {
  check_camera_values(
      read_written("{\"width\":640,\"height\":480,\"fx\":500.5,\"fy\":501.25,\"ppx\":320.5,\"ppy\":240.75,"
                   "\"model\":\"Brown Conrady\",\"coeffs\":[0.125,-0.25,0.001,0.002,0.0625]}"),
      kWritten, kWrittenLens, 640, 480);
  check_camera_values(read_written("{\"width\":640,\"height\":480,"
                                   "\"intrinsic_matrix\":[500.5,0,0,0,501.25,0,320.5,240.75,1]}"),
                      kWritten, {}, 640, 480);
  check_camera_values(read_written("P0: 500.5 0 320.5 0 0 501.25 240.75 0 0 0 1 0\n"), kWritten, {}, 0, 0);
  check_camera_values(read_written("500.5 0 320.5\n0 501.25 240.75\n0 0 1\n"), kWritten, {}, 0, 0);
  check_camera_values(read_written("500.5 501.25 320.5 240.75 0.125 -0.25 0.001 0.002 0.0625\n"), kWritten,
                      kWrittenLens, 0, 0);
}

TEST_CASE("Replica's camera is nested, and its scale is that of the depth images") {
  const std::string numbers = "\"fx\": 600.0, \"fy\": 601.0, \"cx\": 599.5, \"cy\": 339.5, ";
  const CameraFile file =
      read_written("{\"camera\": {\"w\": 1200, \"h\": 680, " + numbers + "\"scale\": 6553.5}}");
  CHECK(file.camera.width == 1200);
  CHECK(file.camera.height == 680);
  CHECK(file.camera.pinhole.fy == 601);
  CHECK(file.depth_factor == 6553.5);
  const CameraFile config = read_written(
      "cam:\n  H: 680\n  W: 1200\n  fx: 600\n  fy: 600\n  cx: 599.5\n  cy: 339.5\n  png_depth_scale: "
      "6553.5\n");
  CHECK(config.camera.height == 680);
  CHECK(config.depth_factor == 6553.5);
}

TEST_CASE("Lenses of other models are fitted where they can be, and refused with the way out where not") {
  const std::string size = "Camera.width: 640\nCamera.height: 480\n";
  const std::string pinhole = "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 319.5\nCamera.cy: 239.5\n";
  const CameraFile fisheye =
      read_written("Camera.type: \"KannalaBrandt8\"\n" + pinhole + size +
                   "Camera.k1: 0.01\nCamera.k2: -0.003\nCamera.k3: 0.001\nCamera.k4: 0.0\n");
  REQUIRE(fisheye.notes.size() == 1);
  CHECK(fisheye.notes[0].find("'KannalaBrandt8' is taken as radial-tangential") != std::string::npos);
  const Vec2<double> seen = fisheye.camera.distortion.distort({0.5, 0});
  const double angle = std::atan(0.5), a2 = angle * angle;
  CHECK(std::abs(seen.x() - angle * (1 + a2 * (0.01 + a2 * (-0.003 + a2 * 0.001)))) < 1e-3);

  const std::string wide =
      "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0, 0, 0, 0]\n"
      "  intrinsics: [190, 190, 255, 256]\n  resolution: [512, 512]\n  distortion_model: ";
  check_refused(wide + "equidistant\n", "'equidistant' sees more than a pinhole can; undistort");
  check_refused("Camera.model: \"equirectangular\"\n" + pinhole, "'equirectangular' is not known here");
  check_refused(pinhole + size + "Camera.k1: 0.01\nCamera.k2: 0.1\nCamera.k3: 0.1\nCamera.k4: 0.1\n",
                "Camera.k4 without Camera.p1 belongs to a fisheye");
  check_refused(pinhole + size + "Camera.model: fisheye\nCamera.k1: 0.1\nCamera.p1: 0.01\n",
                "Camera.p1 belongs to a pinhole's lens");
  check_refused("cam0:\n  camera_model: omni\n  intrinsics: [1, 500, 500, 320, 240]\n",
                "'omni' is no pinhole's; undistort");
  check_refused("0.5 0.66 0.5 0.5 2.8\n1280 1024\ncrop\n640 480\n", "'FOV' sees more than a pinhole can");
}

TEST_CASE("Keys of a known format that are not known are named") {
  const CameraFile file = read_written(
      "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\nCamera.widht: "
      "640\nORBextractor.nLevels: 8\n");
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].find("Camera.widht (meant: Camera.width?)") != std::string::npos);
  CHECK(file.notes[0].find("ORBextractor") == std::string::npos);
}

TEST_CASE("Texts that are no YAML are told with the line") {
  check_refused("Camera.fx: 500\n\tCamera.fy: 500\n", ": line 2: is indented by a tab");
  check_refused("camera_matrix:\n  data: [1, 2\n", ": line 2: the '[' that opens here is not closed");
  check_refused("{\"fx\": 500, \"fy\" 500}", "expected 'key: value' within the braces");
  check_refused("Camera.fx: \"500\nCamera.fy: 500\n", ": line 1: the quotes that open here are not closed");
  check_refused("", ": is empty; expected a calibration");
  check_refused(std::string("C\0\0\0a", 5), "is no text");
  check_refused(std::string(5000, '['), "nested too deep");
  check_refused("1 0 0\n0 1 0\n0 0 0\n", "is no camera matrix");
}
