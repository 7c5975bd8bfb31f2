// SPDX-License-Identifier: BSD-3-Clause
// The raw recordings of KITTI and KITTI-360.
#include <cmath>
#include <cstdio>
#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace kitti_raw_test {
namespace {

constexpr const char* kDrive = "2011_09_26/2011_09_26_drive_0001_sync";

std::string number(int i) {
  char text[24];
  std::snprintf(text, sizeof text, "%010d", i);
  return text;
}

// Tenths of a second from 13:02:25.9 on.
std::string stamps(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += "2011-09-26 13:02:" + std::to_string(25 + (9 + i) / 10) + "." + std::to_string((9 + i) % 10) +
            "64389445\n";
  return text;
}

void make_camera(const ScratchFolder& scratch, const std::string& folder, int count,
                 const std::string& data = "data") {
  for (int i = 0; i < count; ++i) scratch.write(folder + "/" + data + "/" + number(i) + ".png");
  scratch.write(folder + "/timestamps.txt", stamps(count));
}

// Looks along the car: x of the camera is right, so the body's -y; y is down, z forward.
void make_calibration(const ScratchFolder& scratch) {
  scratch.write("2011_09_26/calib_cam_to_cam.txt",
                "calib_time: 09-Jan-2012 13:57:47\n"
                "S_00: 1392 512\nK_00: 980 0 690 0 975 240 0 0 1\nD_00: -0.37 0.2 0.001 0.002 -0.07\n"
                "R_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\nS_rect_00: 1242 375\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
                "P_rect_00: 720 0 610 0 0 720 173 0 0 0 1 0\nS_rect_02: 1242 375\n"
                "P_rect_02: 720 0 610 -36 0 720 173 0 0 0 1 0\n");
  scratch.write("2011_09_26/calib_velo_to_cam.txt",
                "calib_time: x\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\ndelta_f: 0 0\n");
  scratch.write("2011_09_26/calib_imu_to_velo.txt", "calib_time: x\nR: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
}

// Goes north, a thousandth of a degree a frame: about 111 m.
void make_oxts(const ScratchFolder& scratch, int count) {
  scratch.write(std::string(kDrive) + "/oxts/timestamps.txt", stamps(count));
  for (int i = 0; i < count; ++i)
    scratch.write(std::string(kDrive) + "/oxts/data/" + number(i) + ".txt",
                  std::to_string(49 + 0.001 * i) + " 8 110 0 0 1.5707963267948966 1 2 3\n");
}

}  // namespace
}  // namespace kitti_raw_test

TEST_CASE("KITTI raw: dates as stamps, the camera of a folder above, from the drive or its camera") {
  using namespace kitti_raw_test;
  const ScratchFolder scratch;
  const std::string drive = kDrive;
  make_camera(scratch, drive + "/image_02", 3);
  make_calibration(scratch);
  for (const char* place : {"", "/", "/image_02", "/image_02/data"}) {
    INFO(place);
    const io::Dataset dataset = io::open_dataset(scratch.path() / (drive + place));
    CHECK(dataset.layout == io::Layout::kKittiRaw);
    CHECK(dataset.warnings.empty());
    REQUIRE(dataset.frames.size() == 3);
    CHECK(std::abs(dataset.frames[0].stamp - 1317042145.964389445) < 1e-6);
    CHECK(std::abs(dataset.frames[2].stamp - 1317042146.164389445) < 1e-6);
    CHECK(contains(dataset.camera_text, "720.000000, 0.000000, 610.000000, 0.000000, 720.000000"));
    CHECK(contains(dataset.camera_text, "image_width: 1242.000000"));
    CHECK(contains(dataset.camera_source, "calib_cam_to_cam.txt (camera 02, rectified images)"));
  }
}

TEST_CASE("KITTI raw: the left grey camera first, and images that are not rectified have their lens") {
  using namespace kitti_raw_test;
  const ScratchFolder scratch;
  const std::string drive = "2011_09_26/2011_09_26_drive_0001_extract";
  make_camera(scratch, drive + "/image_00", 3);
  make_camera(scratch, drive + "/image_02", 2);
  make_calibration(scratch);
  const io::Dataset dataset = io::open_dataset(scratch.path() / drive);
  CHECK(dataset.frames.size() == 3);
  CHECK(contains(dataset.camera_text, "distortion_coefficients: [-0.370000, 0.200000"));
  CHECK(contains(dataset.camera_text, "980.000000"));
}

TEST_CASE("KITTI raw: the poses of oxts are those of the camera") {
  using namespace kitti_raw_test;
  const ScratchFolder scratch;
  make_camera(scratch, std::string(kDrive) + "/image_02", 3);
  make_calibration(scratch);
  make_oxts(scratch, 3);
  SECTION("in metres from the first") {
    const io::Dataset dataset = io::open_dataset(scratch.path() / kDrive);
    CHECK(dataset.warnings.empty());
    const SE3<double>* const first = dataset.world_from_cam(dataset.frames[0]);
    const SE3<double>* const last = dataset.world_from_cam(dataset.frames[2]);
    REQUIRE(first != nullptr);
    REQUIRE(last != nullptr);
    // The car looks north, and so does the camera: its z is the world's y, its x the world's x, east.
    CHECK((first->rotation.matrix() * Vec3<double>(0, 0, 1) - Vec3<double>(0, 1, 0)).norm() < 1e-9);
    CHECK((first->rotation.matrix() * Vec3<double>(1, 0, 0) - Vec3<double>(1, 0, 0)).norm() < 1e-9);
    // Camera 02 is 5 cm to the right of camera 00, which is at the body.
    CHECK((first->translation - Vec3<double>(0.05, 0, 0)).norm() < 1e-9);
    const Vec3<double> way = last->translation - first->translation;
    CHECK(std::abs(way.y() - 2 * 0.001 * 6378137 * 3.14159265358979 / 180) < 0.01);
    CHECK(std::abs(way.x()) + std::abs(way.z()) < 1e-6);
  }
  SECTION("without the calibration they are left out, and the run goes on") {
    std::filesystem::remove(scratch.path() / "2011_09_26/calib_cam_to_cam.txt");
    const io::Dataset dataset = io::open_dataset(scratch.path() / kDrive);
    CHECK(dataset.ground_truth.empty());
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "without calib_cam_to_cam.txt"));
  }
}

TEST_CASE("KITTI raw: what is missing is told") {
  using namespace kitti_raw_test;
  const ScratchFolder scratch;
  const std::string drive = kDrive;
  make_camera(scratch, drive + "/image_02", 3);
  SECTION("the stamps") {
    std::filesystem::remove(scratch.path() / drive / "image_02/timestamps.txt");
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path() / drive); }),
                   "looks like KITTI raw: image_00/timestamps.txt or image_02/timestamps.txt is missing"));
  }
  SECTION("a stamp") {
    scratch.write(drive + "/image_02/timestamps.txt", stamps(2));
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path() / drive); }),
                   "has 2 times and none for 0000000002.png"));
  }
}

TEST_CASE("KITTI-360: rectified images, and poses by the number of the frame") {
  using namespace kitti_raw_test;
  const ScratchFolder scratch;
  const std::string drive = "data_2d_raw/2013_05_28_drive_0000_sync";
  make_camera(scratch, drive + "/image_00", 4, "data_rect");
  scratch.write("calibration/perspective.txt",
                "S_rect_00: 1408.0 376.0\nP_rect_00: 552 0 682 0 0 552 238 0 0 0 1 0\n");
  std::string rows;
  for (int i : {1, 3})
    rows += std::to_string(i) + " 1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0 0 0 0 1\n";
  scratch.write("data_poses/2013_05_28_drive_0000_sync/cam0_to_world.txt", rows);
  const io::Dataset dataset = io::open_dataset(scratch.path() / drive);
  CHECK(dataset.layout == io::Layout::kKittiRaw);
  REQUIRE(dataset.frames.size() == 4);
  CHECK(contains(dataset.camera_text, "552.000000"));
  CHECK(dataset.world_from_cam(dataset.frames[0]) == nullptr);
  REQUIRE(dataset.world_from_cam(dataset.frames[3]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[3])->translation.x() == 3);
}
