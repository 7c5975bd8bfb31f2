// SPDX-License-Identifier: BSD-3-Clause
// Stamps that are dates.
#include "sslam/io/files/dated_rows.hpp"

#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace dated_rows_test {
namespace {

std::string read(const std::string& text) {
  io::Warnings warnings;
  return io::with_seconds(text, "list", warnings);
}

}  // namespace
}  // namespace dated_rows_test

TEST_CASE("A date in a row becomes its seconds since 1970, to the last digit") {
  using dated_rows_test::read;
  // date -u -d '2011-09-26 13:02:25' +%s: 1317042145.
  CHECK(read("2011-09-26 13:02:25.964389445") == "1317042145.964389445");
  CHECK(read("2011-09-26T13:02:25.96Z a.png\n") == "1317042145.96 a.png\n");
  CHECK(read("2011/09/26 13:02:25\ta.png") == "1317042145\ta.png");
  CHECK(read("2011-09-26,13:02:25.5,1,2") == "1317042145.5,1,2");
  CHECK(read("20110926T130225.25 x") == "1317042145.25 x");
  CHECK(read("\"2011-09-26 13:02:25.5\",\"a.png\"") == "\"1317042145.5\",\"a.png\"");
  CHECK(read("a.png 2011-09-26T13:02:25\r\n") == "a.png 1317042145\r\n");
  CHECK(read("2011-09-26T13:02:25 rgb/1.png 2011-09-26T13:02:26 depth/1.png") ==
        "1317042145 rgb/1.png 1317042146 depth/1.png");
}

TEST_CASE("The time zone of a date is applied") {
  using dated_rows_test::read;
  CHECK(read("2011-09-26T14:02:25.96+01:00") == "1317042145.96");
  CHECK(read("2011-09-26T14:02:25+01") == "1317042145");
  CHECK(read("2011-09-26 14:02:25.5 +0100") == "1317042145.5");
  CHECK(read("2011-09-26T08:32:25-0430 a.png") == "1317042145 a.png");
  CHECK(read("2011-09-26 13:02:25 UTC a.png") == "1317042145 a.png");
  // Positions with a sign are none.
  CHECK(read("2011-09-26 13:02:25.5 -1000 +2 +0.5 0 0 0 1") == "1317042145.5 -1000 +2 +0.5 0 0 0 1");
}

TEST_CASE("A comma before the rest of a second is told from one between cells") {
  using dated_rows_test::read;
  CHECK(read("2011-09-26 13:02:25,964 a.png") == "1317042145.964 a.png");
  CHECK(read("2011-09-26 13:02:25,1.0,2.0,3.0") == "1317042145,1.0,2.0,3.0");
  CHECK(read("2011-09-26 13:02:25,100,200,300") == "1317042145,100,200,300");
  CHECK(read("2011-09-26 13:02:25,5;0,25;0,5") == "1317042145,5;0,25;0,5");
}

TEST_CASE("Times of day count from midnight, and go on past the next") {
  using dated_rows_test::read;
  CHECK(read("13:02:25.5 a.png\n13:02:25.6 b.png\n") == "46945.5 a.png\n46945.6 b.png\n");
  CHECK(read("23:59:59.5\n0:00:00.5\n00:00:01") == "86399.5\n86400.5\n86401");
}

TEST_CASE("What is no date stays as it is") {
  using dated_rows_test::read;
  for (const char* text :
       {"1317042145.96 a:b.png", "2011-09-26 a:b", "2011-13-26 13:02:25 a.png", "2011-02-29T13:02:25 a.png",
        "26.09.2011 13:02:25 a.png", "5 13:02:25 a.png", "2011-09-26T25:02:25 a.png",
        "1 2011-09-26T13:02:25.png", "# 2011-09-26T13:02:25", "1:2 3:4", "2011-09-26 13:02 a.png", ""})
    CHECK(read(text) == text);
}

TEST_CASE("How dates are read is told once, and mixed forms are refused") {
  io::Warnings warnings;
  (void)io::with_seconds("2011-09-26 13:02:25\n2011-09-26 13:02:26\n", "list.txt", warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "list.txt: stamps such as '2011-09-26 13:02:25' are dates: read as seconds since 1970, in UTC");
  CHECK(contains(error_of([&] {
                   (void)io::with_seconds("2011-09-26T13:02:25Z\n2011-09-26T13:02:26\n", "list.txt",
                                          warnings);
                 }),
                 "list.txt: line 2: '2011-09-26T13:02:26' and '2011-09-26T13:02:25Z' are not of one form; "
                 "expected a time zone in all stamps, or in none"));
  CHECK(contains(error_of([&] { (void)io::with_seconds("13:02:25\n2011-09-26T13:02:26\n", "a", warnings); }),
                 "expected a date in all stamps, or in none"));
}

TEST_CASE("Images and their ground truth meet by dates, also in two time zones") {
  const ScratchFolder scratch;
  std::string list, poses;
  for (int i = 0; i < 3; ++i) {
    const std::string second = std::to_string(i), image = "rgb/" + second + ".png";
    scratch.write(image);
    list += "2011-09-26 13:02:2" + second + ".25 " + image + "\n";
    poses += "2011-09-26T14:02:2" + second + ".25+01:00," + second + ",0,0,0,0,0,1\n";
  }
  scratch.write("rgb.txt", list);
  scratch.write("groundtruth.txt", poses);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.frames.size() == 3);
  CHECK(dataset.frames[1].stamp == 1317042141.25);
  CHECK(dataset.warnings.size() == 2);
  REQUIRE(dataset.world_from_cam(dataset.frames[2]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 2);
}

TEST_CASE("Poses without stamps have the dates of times.txt") {
  const ScratchFolder scratch;
  scratch.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n");
  scratch.write("times.txt", "2011-09-26 13:02:25.5\n2011-09-26 13:02:26.5\n");
  io::Warnings warnings;
  const io::Trajectory poses = io::read_trajectory(scratch.path() / "poses.txt", warnings);
  REQUIRE(poses.size() == 2);
  CHECK(poses[1].stamp == 1317042146.5);
  CHECK(warnings.size() == 1);
}
