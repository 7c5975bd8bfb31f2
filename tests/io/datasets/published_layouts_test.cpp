// SPDX-License-Identifier: BSD-3-Clause
// The layouts of TartanAir, OpenLORIS, UZH-FPV, ARKitScenes and Stray Scanner, good and broken; lists with a
// counter.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

namespace published_layouts_test {
namespace {

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

constexpr int kImages = 4;

std::string name_of(const char* form, int i) {
  char text[80];
  std::snprintf(text, sizeof text, form, i);
  return text;
}

bool near(const Vec3<double>& a, const Vec3<double>& b) {
  return (a - b).norm() < 1e-9;
}

// Where the camera looks, and what is below it.
Vec3<double> forwards(const SE3<double>& pose) {
  return pose.rotation * Vec3<double>::UnitZ();
}
Vec3<double> down(const SE3<double>& pose) {
  return pose.rotation * Vec3<double>::UnitY();
}

bool warns(const io::Dataset& dataset, const std::string& part) {
  for (const std::string& warning : dataset.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

const SE3<double>& pose_of_frame(const io::Dataset& dataset, std::size_t i) {
  const SE3<double>* const pose = dataset.world_from_cam(dataset.frames.at(i));
  REQUIRE(pose != nullptr);
  return *pose;
}

}  // namespace

TEST_CASE("TartanAir: a pose a row, with x forwards and z down, and the published camera") {
  const ScratchFolder scratch;
  const bool second = GENERATE(false, true);
  const std::string camera = second ? "lcam_front" : "left";
  std::string poses;
  for (int i = 0; i < kImages; ++i) {
    scratch.write("image_" + camera + "/" + name_of("%06d_", i) + camera + ".png");
    scratch.write("depth_" + camera + "/" + name_of("%06d_", i) + camera + "_depth." +
                  (second ? "png" : "npy"));
    poses += std::to_string(i) + " 2 3 0 0 0 1\n";
  }
  scratch.write("pose_" + camera + ".txt", poses);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kTartanAir);
  REQUIRE(dataset.frames.size() == kImages);
  CHECK(dataset.frames[2].stamp == 2 / io::kDefaultFrameRate);
  CHECK(dataset.frames[2].depth.empty());
  CHECK(warns(dataset, "is depth in a form of TartanAir's own"));
  CHECK(near(pose_of_frame(dataset, 2).translation, {2, 2, 3}));
  CHECK(near(forwards(pose_of_frame(dataset, 2)), Vec3<double>::UnitX()));
  CHECK(near(down(pose_of_frame(dataset, 2)), Vec3<double>::UnitZ()));
  CHECK(contains(dataset.camera_text, second ? "Camera.cy: 320" : "Camera.cy: 240"));
}

TEST_CASE("OpenLORIS: aligned depth in millimetres, and the base's poses become the camera's") {
  const ScratchFolder scratch;
  std::string colour = "#Time filename\n", depth = colour, truth = "#Time px py pz qx qy qz qw\n";
  for (int i = 0; i < kImages; ++i) {
    const std::string stamp = "156000000" + std::to_string(i) + ".25";
    for (const char* folder : {"color/", "aligned_depth/", "depth/"}) scratch.write(folder + stamp + ".png");
    colour += stamp + " color/" + stamp + ".png\n";
    depth += stamp + " aligned_depth/" + stamp + ".png\n";
    truth += stamp + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  }
  scratch.write("color.txt", colour);
  scratch.write("aligned_depth.txt", depth);
  scratch.write("depth.txt", colour);  // not registered to the images
  scratch.write("groundtruth.txt", truth);
  scratch.write("sensors.yaml", "%YAML:1.0\n");
  const std::string head =
      "%YAML:1.0\n---\ntrans_matrix:\n   - parent_frame: base_link\n     child_frame: t265_fisheye1\n"
      "     matrix: !!opencv-matrix\n        rows: 4\n        cols: 4\n        dt: d\n"
      "        data: [ 1., 0., 0., 9., 0., 1., 0., 9., 0., 0., 1., 9., 0., 0., 0., 1. ]\n";
  const std::string camera =
      "   - parent_frame: base_link\n     child_frame: d400_color_optical_frame\n"
      "     matrix: !!opencv-matrix\n        rows: 4\n        cols: 4\n        dt: d\n"
      "        data: [ 0., 0., 1., 0.25, -1., 0., 0., 0.5,\n            0., -1., 0., 0.75, 0., 0., 0., 1. "
      "]\n";
  SECTION("with the place of the camera") {
    scratch.write("trans_matrix.yaml", head + camera);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kOpenLoris);
    CHECK(dataset.warnings.empty());
    CHECK(dataset.depth_factor == 1000);
    CHECK(contains(dataset.frames.at(2).depth, "aligned_depth/"));
    CHECK(dataset.camera_file.filename() == "sensors.yaml");
    CAPTURE(pose_of_frame(dataset, 2).translation.transpose());
    CHECK(near(pose_of_frame(dataset, 2).translation, {2.25, 0.5, 0.75}));
    CHECK(near(forwards(pose_of_frame(dataset, 2)), Vec3<double>::UnitX()));
  }
  SECTION("without it") {
    const bool other = GENERATE(false, true);
    if (other) scratch.write("trans_matrix.yaml", head);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == kImages);
    CHECK(dataset.ground_truth.empty());
    CHECK(contains(dataset.truth_problem, other
                                              ? "does not say where d400_color_optical_frame is on base_link"
                                              : "the camera's are not known"));
  }
}

TEST_CASE("UZH-FPV: rows of a counter, a stamp and a file, and the IMU's poses by Kalibr's camchain") {
  const ScratchFolder scratch;
  const std::string list = GENERATE("left_images.txt", "images.txt");
  std::string rows = "# id timestamp image_name\n", truth = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < kImages; ++i) {
    const std::string stamp = "15400000.0" + std::to_string(i + 1);
    scratch.write("img/image_0_" + std::to_string(i) + ".png");
    rows += std::to_string(i) + " " + stamp + " img/image_0_" + std::to_string(i) + ".png\n";
    truth += stamp + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  }
  scratch.write(list, rows);
  scratch.write("groundtruth.txt", truth);
  SECTION("with the camchain") {
    scratch.write("camchain-imucam-indoor.yaml",
                  "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, -0.5]\n  - [0.0, 1.0, 0.0, 0.0]\n"
                  "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kUzhFpv);
    CHECK(dataset.warnings.empty());
    REQUIRE(dataset.frames.size() == kImages);
    CHECK(std::abs(dataset.frames[2].stamp - 15400000.03) < 1e-6);
    CHECK(near(pose_of_frame(dataset, 2).translation, {2.5, 0, 0}));
    CHECK(contains(dataset.camera_file.string(), "camchain"));
  }
  SECTION("without") {
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.frames.size() == kImages);
    CHECK(dataset.ground_truth.empty());
    CHECK(contains(dataset.truth_problem, "holds the poses of the IMU"));
  }
}

TEST_CASE("A list with a counter in front of its stamps is read, and that is told") {
  const ScratchFolder scratch;
  for (int i = 0; i < kImages; ++i) scratch.write("rgb/" + std::to_string(i) + ".png");
  const auto open = [&](const char* a, const char* b, const char* c) {
    scratch.write("rgb.txt", std::string(a) + " rgb/0.png\n" + b + " rgb/1.png\n" + c + " rgb/2.png\n");
    return io::open_dataset(scratch.path());
  };
  const io::Dataset counted = open("1,100.5,", "2,100.75,", "3,101.0,");
  REQUIRE(counted.frames.size() == 3);
  CHECK(counted.frames[1].stamp == 100.75);
  CHECK(warns(counted, "its first column counts the rows: left out"));
  // Decimal commas look alike.
  CHECK(contains(error_of([&] { (void)open("1,0", "2,0", "3,0"); }), "has two numbers before the file"));
  CHECK(contains(error_of([&] { (void)open("1,5", "1,6", "1,7"); }), "has two numbers before the file"));
}

TEST_CASE("ARKitScenes: world to camera, an angle about an axis, and a camera an image") {
  const ScratchFolder scratch;
  const std::string place = GENERATE("", "41_frames/");
  std::string poses;
  for (int i = 0; i < kImages; ++i) {
    const std::string name = name_of("41_%d.125", 700 + i);
    scratch.write(place + "lowres_wide/" + name + ".png");
    scratch.write(place + "lowres_depth/" + name + ".png");
    scratch.write(place + "lowres_wide_intrinsics/" + name + ".pincam",
                  "256 192 " + std::to_string(200 + 4 * i) + " 200 127.5 95.5\n");
    poses += std::to_string(700 + i) + ".1275 0 0 " + std::to_string(std::numbers::pi / 2) + " " +
             std::to_string(i) + " 0 0\n";
  }
  scratch.write(place + "lowres_wide.traj", poses);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kArkitScenes);
  REQUIRE(dataset.frames.size() == kImages);
  CHECK(dataset.frames[2].stamp == 702.125);
  CHECK(contains(dataset.frames[2].depth, "lowres_depth"));
  CHECK(dataset.depth_factor == 1000);
  CHECK(dataset.camera_file.filename() == "41_702.125.pincam");
  CHECK(warns(dataset, "the focal length changes from 200 to 212 pixels"));
  // A quarter turn about z takes (0, 2, 0) of the world to (-2, 0, 0); the camera was moved by (2, 0, 0).
  CHECK((pose_of_frame(dataset, 2).translation - Vec3<double>(0, 2, 0)).norm() < 1e-5);
  io::Warnings warnings;
  CHECK(io::read_trajectory(scratch.path() / (place + "lowres_wide.traj"), warnings).size() == kImages);
}

TEST_CASE("Stray Scanner: poses and depth by the numbers of the video's frames") {
  const ScratchFolder scratch;
  scratch.write("rgb.mp4");
  for (int i = 0; i < kImages; ++i) scratch.write(name_of("depth/%06d.png", i));
  const bool fresh = GENERATE(false, true);
  std::string table = std::string("timestamp, frame, x, y, z, qx, qy, qz, qw") +
                      (fresh ? ", fx, fy, cx, cy, distortion_center_x, distortion_center_y\n" : "\n");
  for (int i = 1; i < kImages; ++i)  // without the first frame
    table += std::to_string(5000 + i) + ".5, " + name_of("%06d", i) + ", " + std::to_string(i) +
             ", 0, 0, 0, 0, 0, 1" + (fresh ? ", 1600, 1600, 959.5, 719.5, , \n" : "\n");
  scratch.write("odometry.csv", table);
  io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kVideo);
  CHECK(io::name(dataset.layout) == "video");
  io::fill_video_frames(dataset, std::vector<double>{0.5, 0.75, 1.0, 1.25});
  io::complete_stray_scan(dataset);
  CHECK(dataset.warnings.empty());
  CHECK(dataset.world_from_cam(dataset.frames[0]) == nullptr);
  CHECK(near(pose_of_frame(dataset, 2).translation, {2, 0, 0}));
  CHECK(dataset.frames[2].stamp == 0.5);
  CHECK(contains(dataset.frames[2].depth, "000002.png"));
  CHECK(dataset.depth_factor == 1000);
}

TEST_CASE("A scan's table that cannot be read costs the ground truth, not the run") {
  const ScratchFolder scratch;
  scratch.write("rgb.mp4");
  scratch.write("odometry.csv", "timestamp, frame, x\n1, 0, 5\n2, 1, 6\n");
  io::Dataset dataset = io::open_dataset(scratch.path());
  io::fill_video_frames(dataset, std::vector<double>{0, 0.5});
  io::complete_stray_scan(dataset);
  CHECK(dataset.ground_truth.empty());
  CHECK(contains(dataset.truth_problem, "odometry.csv"));
}

}  // namespace published_layouts_test
