// SPDX-License-Identifier: BSD-3-Clause
// Folders of images whose stamps stand in a list beside them.
#include "sslam/io/datasets/times_beside.hpp"

#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::ScratchFolder;

namespace times_beside_test {
namespace {

void make_images(const ScratchFolder& scratch, const std::string& folder = "images/") {
  for (const char* name : {"00000.jpg", "00001.jpg", "00003.jpg"}) scratch.write(folder + name);
}

}  // namespace
}  // namespace times_beside_test

TEST_CASE("TUM's monocular recordings: times by the numbers of the images, poses, from either folder") {
  const ScratchFolder scratch;
  times_beside_test::make_images(scratch);
  scratch.write("times.txt", "00000 1445.25 0.01\n00001 1445.5 0.01\n00002 1445.75 0.01\n00003 1446 0.01\n");
  scratch.write("groundtruthSync.txt",
                "1445.25 0 0 0 0 0 0 1\n1445.5 NaN NaN NaN NaN NaN NaN NaN\n1446 3 0 0 0 0 0 1\n");
  for (const char* place : {"", "images", "images/"}) {
    INFO(place);
    const io::Dataset dataset = io::open_dataset(scratch.path() / place);
    REQUIRE(dataset.frames.size() == 3);
    CHECK(dataset.frames[0].stamp == 1445.25);
    CHECK(dataset.frames[2].stamp == 1446);
    REQUIRE_FALSE(dataset.warnings.empty());
    CHECK(contains(dataset.warnings[0], "times.txt: has the stamps of the images"));
  }
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kTimedImages);
  REQUIRE(dataset.world_from_cam(dataset.frames[2]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 3);
  CHECK(dataset.world_from_cam(dataset.frames[1]) == nullptr);
}

TEST_CASE("A list of times in the folder of the images, in each of its forms") {
  const ScratchFolder scratch;
  times_beside_test::make_images(scratch, "");
  const std::string list =
      GENERATE("10.0\n10.25\n10.5\n", "00000.jpg 10.0\n00001.jpg 10.25\n00003.jpg 10.5\n",
               "10.5 00003.jpg\n10.0 00000.jpg\n10.25 00001.jpg\n",
               "frame,timestamp\n00000,10\n00001,10.25\n00003,10.5\n", "00:00:10\n00:00:10.25\n00:00:10.5\n");
  scratch.write("timestamps.txt", list);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  INFO(list);
  REQUIRE(dataset.frames.size() == 3);
  CHECK(dataset.frames[0].stamp == 10);
  CHECK(dataset.frames[1].stamp == 10.25);
  CHECK(dataset.frames[2].stamp == 10.5);
}

TEST_CASE("A list of times that does not fit the images is told, and one of another folder is left alone") {
  const ScratchFolder scratch;
  times_beside_test::make_images(scratch, "left/");
  SECTION("of another number") {
    scratch.write("left/times.txt", "10.0\n10.25\n");
    const io::Dataset dataset = io::open_dataset(scratch.path() / "left");
    CHECK(dataset.frames[1].stamp == 1 / 30.0);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0],
                   "is not used for the stamps of the images: it has 2 rows for 3 images"));
  }
  SECTION("beside two folders") {
    times_beside_test::make_images(scratch, "right/");
    scratch.write("times.txt", "10.0\n10.25\n10.5\n");
    const io::Dataset dataset = io::open_dataset(scratch.path() / "left");
    CHECK(dataset.frames[1].stamp == 1 / 30.0);
    CHECK(dataset.warnings.empty());
  }
}
