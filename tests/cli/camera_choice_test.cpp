// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/camera_choice.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include "cli/input/exif_focal.hpp"
#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

namespace camera_choice_test {

using namespace sslam;
using testing::contains;

namespace {

const std::string kYaml = "Camera.fx: 500\nCamera.fy: 510\nCamera.cx: 319.5\nCamera.cy: 239.5\n";

// A folder with a camera file and the camera that comes out for images of a size.
struct Room {
  testing::ScratchFolder scratch;
  io::Dataset dataset;

  Room() { dataset.root = scratch.path(); }
  [[nodiscard]] cli::CameraChoice choose(int width, int height, const cli::CameraWish& wish = {}) const {
    return cli::choose_camera(wish, dataset, width, height);
  }
  [[nodiscard]] std::string error(int width, int height) const {
    return testing::error_of([&] { (void)choose(width, height); });
  }
};

// A JPEG of nothing but the block that holds a focal length, in millimetres.
std::string exif_jpeg(bool big_endian, unsigned focal = 26) {
  const auto number = [big_endian](unsigned value, int size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) {
      const int shift = 8 * (big_endian ? size - 1 - i : i);
      bytes += static_cast<char>(value >> shift & 0xFFU);
    }
    return bytes;
  };
  const std::string tiff = (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) +       // heading
                           number(1, 2) + number(0x8769, 2) + number(4, 2) + number(1, 4) +  // where the
                           number(26, 4) + number(0, 4) +                                    // photo's is
                           number(1, 2) + number(0xA405, 2) + number(3, 2) + number(1, 4) +  // the length
                           number(focal, 2) + number(0, 2) + number(0, 4);
  return std::string("\xff\xd8\xff\xe1\x00\x40", 6) + std::string("Exif\0\0", 6) + tiff + "\xff\xd9";
}

}  // namespace

TEST_CASE("The calibration: option before file before published values") {
  Room room;
  room.dataset.layout = io::Layout::kTum;
  room.dataset.name_hint = "# file: 'rgbd_dataset_freiburg3_desk.bag'";
  CHECK(room.choose(640, 480).source == "built in: tum_fr3");
  CHECK(room.choose(640, 480, {"icl_nuim", 0, 0}).camera.pinhole.fx == 481.2);

  room.scratch.write("camera.yaml", kYaml);
  CHECK(room.choose(640, 480).camera.pinhole.fx == 500);
  CHECK(room.choose(640, 480).depth_factor == 5000);  // published with the recording, absent from the file

  const auto other = room.scratch.write("other.yaml", kYaml + "DepthMapFactor: 1000\n");
  CHECK(room.choose(640, 480, {other.string(), 0, 0}).depth_factor == 1000);
  CHECK_THROWS(room.choose(640, 480, {(room.scratch.path() / "none.yaml").string(), 0, 0}));
}

TEST_CASE("Camera files of other names are found beside the images, and told") {
  const Room room;
  room.scratch.write("camera.txt", "500 510 319.5 239.5\n");
  const cli::CameraChoice choice = room.choose(640, 480);
  CHECK(choice.camera.pinhole.fy == 510);
  REQUIRE(choice.notes.size() == 1);
  CHECK(contains(choice.notes[0], "camera.txt"));
}

TEST_CASE("Without any calibration: --focal, --fov, Exif, or a guess that is told") {
  const Room room;
  CHECK(room.choose(640, 480, {"", 700, 0}).camera.pinhole.fx == 700);
  CHECK(std::abs(room.choose(640, 480, {"", 0, 90}).camera.pinhole.fx - 320) < 1e-9);
  CHECK(room.choose(640, 480, {"", 0, 90}).warnings.empty());

  const cli::CameraChoice guess = room.choose(640, 480);
  CHECK(std::abs(guess.camera.pinhole.fx - 320 / std::tan(radians(30.0))) < 1e-9);
  CHECK(guess.camera.pinhole.cx == 319.5);
  REQUIRE(guess.warnings.size() == 1);
  CHECK(contains(guess.warnings[0], "ASSUMING a field of view of 60 degrees"));
  CHECK(room.choose(480, 640).camera.pinhole.fx == guess.camera.pinhole.fx);  // the phone is held upright

  for (const bool big_endian : {false, true}) {
    Room photos;
    io::FrameEntry entry;
    entry.image = photos.scratch.write("a.jpg", exif_jpeg(big_endian)).string();
    photos.dataset.frames.push_back(entry);
    const cli::CameraChoice written = photos.choose(4000, 3000);
    CHECK(std::abs(written.camera.pinhole.fx - 26 / 43.267 * 5000) < 1e-6);
    CHECK(written.warnings.empty());
    REQUIRE(written.notes.size() == 1);
  }
}

TEST_CASE("Exif that is cut off, or has a length of no lens, says nothing") {
  const testing::ScratchFolder scratch;
  for (const unsigned focal : {0U, 2U, 60000U})
    CHECK(cli::exif_focal(scratch.write("b.jpg", exif_jpeg(false, focal)), 4000, 3000) == 0);
  const std::string whole = exif_jpeg(true);
  for (std::size_t bytes = 0; bytes + 11 < whole.size(); ++bytes)
    REQUIRE(cli::exif_focal(scratch.write("a.jpg", whole.substr(0, bytes)), 4000, 3000) == 0);
}

TEST_CASE("A calibration of another resolution is scaled where the shape fits, and told") {
  const Room room;
  room.scratch.write("camera.yaml", kYaml + "Camera.width: 640\nCamera.height: 480\nCamera.k1: -0.1\n");
  const cli::CameraChoice half = room.choose(320, 240);
  CHECK(half.camera.width == 320);
  CHECK(half.camera.pinhole.fx == 250);
  CHECK(half.camera.pinhole.fy == 255);
  CHECK(half.camera.pinhole.cx == 159.5);
  CHECK(half.camera.distortion.k1 == -0.1);
  REQUIRE(half.notes.size() == 1);
  CHECK(contains(half.notes[0], "is for 640x480 pixels, and the images have 320x240: scaled"));
  CHECK(room.choose(640, 480).notes.empty());
}

TEST_CASE("A calibration of another shape is refused with both sizes") {
  const Room room;
  room.scratch.write("camera.yaml", kYaml + "Camera.width: 640\nCamera.height: 480\n");
  CHECK(contains(room.error(640, 360),
                 "camera.yaml: is for 640x480 pixels, and the images have 640x360: another aspect ratio"));
  CHECK(contains(room.error(480, 640), "have 480x640: they are turned by 90 degrees"));
  CHECK(contains(room.error(240, 320), "turned by 90 degrees"));
}

TEST_CASE("A calibration without a size that cannot be that of the images is refused") {
  const Room room;
  room.scratch.write("camera.yaml", kYaml);
  CHECK(contains(room.error(320, 240),
                 "camera.yaml: the principal point (319.5, 239.5) is far from the middle of 320x240"));
  CHECK(room.error(640, 480).empty());
}

TEST_CASE("A field of view without a size is that of the images") {
  Room room;
  room.scratch.write("transforms_train.json", "{\"camera_angle_x\": 1.5707963267948966, \"frames\": []}");
  room.dataset.camera_file = room.scratch.path() / "transforms_train.json";
  const cli::CameraChoice choice = room.choose(640, 480);
  CHECK(std::abs(choice.camera.pinhole.fx - 320) < 1e-9);
  CHECK(choice.camera.pinhole.cy == 239.5);
  CHECK(choice.camera.height == 480);
}

TEST_CASE("A COLMAP camera in binary form is read") {
  Room room;
  const auto bytes_of = [](auto value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string bytes = bytes_of(std::uint64_t{1}) + bytes_of(std::int32_t{1}) + bytes_of(std::int32_t{1}) +
                      bytes_of(std::uint64_t{640}) + bytes_of(std::uint64_t{480});
  for (const double number : {500.0, 510.0, 320.0, 240.0}) bytes += bytes_of(number);
  room.scratch.write("cameras.bin", bytes);
  const cli::CameraChoice choice = room.choose(640, 480, {(room.scratch.path() / "cameras.bin").string()});
  CHECK(choice.camera.pinhole.fy == 510);
  CHECK(choice.camera.pinhole.cx == 319.5);
}

TEST_CASE("Of several cameras the one whose size fits is taken with a note, else they are asked for") {
  Room room;
  const auto camera = [](int socket, int focal, int width, int height) {
    return "[" + std::to_string(socket) + ", {\"intrinsicMatrix\": [[" + std::to_string(focal) + ", 0, " +
           std::to_string(width / 2) + "], [0, " + std::to_string(focal) + ", " + std::to_string(height / 2) +
           "], [0, 0, 1]], \"width\": " + std::to_string(width) + ", \"height\": " + std::to_string(height) +
           "}]";
  };
  const std::string file =
      room.scratch
          .write("oak.json", "{\"cameraData\": [" + camera(0, 1500, 1920, 1080) + "," +
                                 camera(1, 800, 1280, 800) + "," + camera(2, 801, 1280, 800) + "]}")
          .string();
  const cli::CameraChoice colour = room.choose(1920, 1080, {file});
  CHECK(colour.camera.pinhole.fx == 1500);
  REQUIRE(colour.notes.size() == 1);
  CHECK(contains(colour.notes[0], "CAM_A is taken, the only one for images of 1920x1080"));
  CHECK(room.choose(960, 540, {file}).camera.pinhole.fx == 750);
  const std::string several = testing::error_of([&] { (void)room.choose(1280, 800, {file}); });
  CHECK(contains(several, "for images of 1280x800 these fit: CAM_B, CAM_C; name one, as in --camera " + file +
                              "#CAM_B"));
  CHECK(contains(testing::error_of([&] { (void)room.choose(640, 480, {file}); }), "none fits; name one"));
  CHECK(room.choose(1280, 800, {file + "#CAM_C"}).camera.pinhole.fx == 801);
  CHECK(contains(testing::error_of([&] { (void)room.choose(1280, 800, {file + "#CAM_D"}); }),
                 "has no camera 'CAM_D'; it has CAM_A, CAM_B, CAM_C"));
}

TEST_CASE("A dataset's wide lens is seen through a view, as one from a file is") {
  Room room;
  room.dataset.camera_text = "1 OPENCV_FISHEYE 640 480 180 180 320 240 0.01 0.001 0 0\n";
  room.dataset.camera_source = "cameras.bin";
  const cli::CameraChoice choice = room.choose(640, 480);
  CHECK(choice.wide.has_value());
  CHECK(choice.view_fov > 100);
  CHECK(contains(choice.notes.front(), "the camera is that of cameras.bin"));
}

}  // namespace camera_choice_test
