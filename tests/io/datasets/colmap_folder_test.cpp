// SPDX-License-Identifier: BSD-3-Clause
// A COLMAP folder as a dataset.
#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace colmap_folder_test {
namespace {

// An image at (x, 0, 0), not turned, and the row of its features.
std::string image_row(int id, double x, int camera, const std::string& name) {
  return std::to_string(id) + " 1 0 0 0 " + std::to_string(-x) + " 0 0 " + std::to_string(camera) + " " +
         name + "\n10.5 20.5 -1\n";
}

template <class Value>
std::string as_bytes(Value value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string image_bytes(int id, double x, int camera, const std::string& name) {
  std::string bytes = as_bytes<std::int32_t>(id);
  for (const double number : {1.0, 0.0, 0.0, 0.0, -x, 0.0, 0.0}) bytes += as_bytes(number);
  return bytes + as_bytes<std::int32_t>(camera) + name + std::string(1, '\0') + as_bytes<std::uint64_t>(0);
}

void make_images(const ScratchFolder& scratch, int count, const std::string& folder = "images/") {
  for (int i = 1; i <= count; ++i) scratch.write(folder + "frame" + std::to_string(i) + ".jpg");
}

}  // namespace
}  // namespace colmap_folder_test

TEST_CASE("COLMAP folder: names give the order, the model gives the camera and the poses") {
  using namespace colmap_folder_test;
  const ScratchFolder scratch;
  make_images(scratch, 11);
  // In the order in which COLMAP registered them, and without the last.
  std::string rows = "# Image list\n";
  for (int i : {10, 2, 1, 9, 3, 4, 5, 6, 7, 8})
    rows += image_row(100 - i, i, 7, "frame" + std::to_string(i) + ".jpg");
  scratch.write("sparse/0/images.txt", rows);
  scratch.write("sparse/0/cameras.txt",
                "# Camera list\n3 PINHOLE 10 10 5 5 5 5\n7 SIMPLE_RADIAL 640 480 500 320 240 0.1\n");
  const io::Dataset dataset = io::open_dataset(scratch.path(), {.frame_rate = 10});
  CHECK(dataset.layout == io::Layout::kColmap);
  REQUIRE(dataset.frames.size() == 11);
  for (std::size_t i = 0; i < 10; ++i) {
    const SE3<double>* const pose = dataset.world_from_cam(dataset.frames[i]);
    REQUIRE(pose != nullptr);
    CHECK(pose->translation.x() == static_cast<double>(i + 1));
  }
  CHECK(dataset.world_from_cam(dataset.frames[10]) == nullptr);
  CHECK(dataset.frames[1].stamp == 0.1);
  CHECK(dataset.camera_text == "7 SIMPLE_RADIAL 640 480 500 320 240 0.1\n");
  REQUIRE(dataset.warnings.size() == 2);
  CHECK(contains(dataset.warnings[0], "has poses of 10 of the 11 images"));
  CHECK(contains(dataset.warnings[1], "need not be metres"));
}

TEST_CASE("COLMAP folder: binary models say the same") {
  using namespace colmap_folder_test;
  const ScratchFolder scratch;
  make_images(scratch, 3);
  std::string images = as_bytes<std::uint64_t>(3);
  for (int i : {3, 1, 2}) images += image_bytes(i, i, 4, "frame" + std::to_string(i) + ".jpg");
  scratch.write("sparse/0/images.bin", images);
  std::string cameras = as_bytes<std::uint64_t>(1) + as_bytes<std::int32_t>(4) + as_bytes<std::int32_t>(2) +
                        as_bytes<std::uint64_t>(640) + as_bytes<std::uint64_t>(480);
  for (const double number : {500.0, 320.0, 240.0, -0.125}) cameras += as_bytes(number);
  SECTION("whole") {
    scratch.write("sparse/0/cameras.bin", cameras);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.frames.size() == 3);
    REQUIRE(dataset.world_from_cam(dataset.frames[2]) != nullptr);
    CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 3);
    CHECK(dataset.camera_text == "4 SIMPLE_RADIAL 640 480 500 320 240 -0.125\n");
    CHECK(dataset.warnings.size() == 1);
  }
  SECTION("cut off") {
    scratch.write("sparse/0/cameras.bin", cameras.substr(0, 50));
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }), "cameras.bin: is cut off"));
  }
  SECTION("of a model that came later") {
    cameras[12] = 77;
    scratch.write("sparse/0/cameras.bin", cameras);
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }),
                   "camera 4 has the model number 77, which is not known"));
  }
}

TEST_CASE("COLMAP folder: several cameras and several folders are told") {
  using namespace colmap_folder_test;
  const ScratchFolder scratch;
  make_images(scratch, 2, "images/left/");
  make_images(scratch, 1, "images/right/");
  scratch.write("sparse/images.txt", image_row(1, 1, 1, "right/frame1.jpg") +
                                         image_row(2, 2, 2, "left/frame1.jpg") +
                                         image_row(3, 3, 2, "left/frame2.jpg"));
  scratch.write("sparse/cameras.txt", "1 PINHOLE 640 480 1 2 3 4\n2 PINHOLE 640 480 5 6 7 8\n");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.frames.size() == 3);
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 1);
  CHECK(dataset.camera_text == "2 PINHOLE 640 480 5 6 7 8\n");
  REQUIRE(dataset.warnings.size() == 3);
  CHECK(contains(dataset.warnings[0],
                 "the images have 2 cameras; camera 2, of 2 of 3 images, is taken for all"));
  CHECK(contains(dataset.warnings[1], "its images lie in 2 folders"));
}

TEST_CASE("COLMAP folder: a model whose images are elsewhere is refused") {
  using namespace colmap_folder_test;
  const ScratchFolder scratch;
  scratch.write("images/other.txt");
  scratch.write("sparse/0/images.txt", image_row(1, 1, 1, "a.jpg") + image_row(2, 2, 1, "b.jpg"));
  scratch.write("sparse/0/cameras.txt", "1 PINHOLE 640 480 1 2 3 4\n");
  CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }), "a.jpg, which is not there"));
}
