// SPDX-License-Identifier: BSD-3-Clause
// Trajectories with decimal commas, of a clock that only seems to be another, with turned quaternions, and
// files that are none.
#include <cmath>
#include <string>

#include "io/errors.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/evaluation/same_clock.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/scratch_folder.hpp"

namespace odd_files_test {
namespace {

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

io::Trajectory read_rows(const std::string& text) {
  const ScratchFolder scratch;
  io::Warnings warnings;
  return io::read_trajectory(scratch.write("poses.txt", text), warnings);
}

// A walk whose camera hardly turns, looking to the side.
io::Trajectory side_walk(int count) {
  io::Trajectory path;
  for (int i = 0; i < count; ++i) {
    const double a = 0.3 * i;
    io::StampedPose pose;
    pose.stamp = 0.1 * i;
    pose.world_from_cam.translation = Vec3<double>(std::cos(a), std::sin(a), 0.2 * a);
    pose.world_from_cam.rotation = SO3<double>::exp(Vec3<double>(0.9, 0.4, 0.3 + 0.001 * i));
    path.push_back(pose);
  }
  return path;
}

}  // namespace

TEST_CASE("Poses with decimal commas, between semicolons, tabs or blanks") {
  const std::string cut = GENERATE(as<std::string>(), ";", "\t", " ");
  CAPTURE(cut);
  std::string text;
  for (int i = 0; i < 4; ++i)
    for (const std::string& cell :
         {"1," + std::to_string(i), std::string("0,5"), std::string("-0,25"), std::string("2"),
          std::string("0"), std::string("0,0"), std::string("0,6"), std::string("0,8")})
      text += cell + (cell == "0,8" ? "\n" : cut);
  const io::Trajectory poses = read_rows(text);
  REQUIRE(poses.size() == 4);
  CHECK(poses[2].stamp == 1.2);
  CHECK(poses[2].world_from_cam.translation == Vec3<double>(0.5, -0.25, 2));
}

TEST_CASE("Commas that separate are no decimal commas") {
  CHECK(read_rows("1,0,2,3,0,0,0,1\n2,0,2,3,0,0,0,1\n")[0].world_from_cam.translation ==
        Vec3<double>(0, 2, 3));
  CHECK(read_rows("1, 0, 2, 3, 0, 0, 0, 1\n")[0].world_from_cam.translation == Vec3<double>(0, 2, 3));
}

TEST_CASE("Files that are no trajectory are told by their kind") {
  using namespace std::string_literals;
  CHECK(contains(error_of([] { (void)read_rows("<!DOCTYPE html>\n<html></html>\n"); }), "is a web page"));
  CHECK(contains(error_of([] { (void)read_rows("\x1f\x8b\10"); }), "is compressed (gzip); unpack it"));
  CHECK(contains(error_of([] { (void)read_rows("PK\3\4\0\0abc"s); }), "is an archive"));
  CHECK(contains(error_of([] { (void)read_rows("version https://git-lfs.github.com/spec/v1\n"); }),
                 "git lfs pull"));
}

TEST_CASE("Poses between bars, and as Python prints lists and tuples") {
  for (const char* text :
       {"t | tx | ty | tz | qx | qy | qz | qw\n0.5 | 1 | 2 | 3 | 0 | 0 | 0 | 1\n", "0.5|1|2|3|0|0|0|1\n",
        "[0.5, 1, 2, 3, 0, 0, 0, 1]\n", "(0.5, 1., 2, 3, 0, 0, 0, 1)\n", "[[0.5 1 2 3 0 0 0 1]]\n"}) {
    CAPTURE(text);
    const io::Trajectory poses = read_rows(text);
    REQUIRE(poses.size() == 1);
    CHECK(poses[0].stamp == 0.5);
    CHECK(poses[0].world_from_cam.translation == Vec3<double>(1, 2, 3));
  }
}

TEST_CASE("Rotations as roll, pitch and yaw are refused by these names") {
  for (const char* head : {"timestamp,x,y,z,roll,pitch,yaw\n", "timestamp,x,y,z,yaw,pitch,roll,confidence\n"})
    CHECK(contains(error_of([head] { (void)read_rows(head + std::string("0.1,1,2,3,0,0,0,1\n")); }),
                   "as roll, pitch and yaw"));
}

TEST_CASE("Stamps from 0 are of another unit only if both last about as long") {
  const std::vector<double> seconds{0, 0.5, 1, 1.5, 2}, milliseconds{0, 500, 1000, 1500, 2000};
  const std::vector<double> minutes{0, 0.5 / 60, 1.0 / 60, 1.5 / 60, 2.0 / 60};
  CHECK(io::unit_on_clock(seconds, milliseconds, 0.02).per_second == 1e3);
  CHECK(io::unit_on_clock(minutes, seconds, 0.02).is_seconds());
}

TEST_CASE("Quaternions with w first are told of a camera that hardly turns, too") {
  const io::Trajectory truth = side_walk(20);
  io::Trajectory turned = truth;
  for (io::StampedPose& pose : turned) {
    const auto q = pose.world_from_cam.rotation.quaternion();
    pose.world_from_cam.rotation = SO3<double>::from_quaternion(q.z(), q.w(), q.x(), q.y());
  }
  const auto notes_of = [](const io::Trajectory& a, const io::Trajectory& b) {
    const auto notes = io::evaluate(a, b).notes;
    return notes.empty() ? std::string() : notes.front();
  };
  CHECK(contains(notes_of(truth, turned), "the estimate's quaternions seem to have w first"));
  CHECK(contains(notes_of(turned, truth), "the ground truth's quaternions seem to have w first"));
  CHECK(notes_of(truth, truth).empty());
}

TEST_CASE("Rows with a remark behind them, with zero bytes, or without a rotation") {
  CHECK(read_rows("1 0 2 3 0 0 0 1  # the door\n2 0 2 3 0 0 0 1 #\n").size() == 2);
  const std::string zero =
      error_of([] { (void)read_rows(std::string("1 0 2 3 0 0 0 1\0x\n2 0 2 3 0 0 0 1\0x\n", 36)); });
  CHECK(contains(zero, "'1?x' is not a number"));
  std::string positions;
  for (int i = 0; i < 8; ++i) positions += std::to_string(i) + " 0.5 2 3\n";
  CHECK(contains(error_of([&] { (void)read_rows(positions); }),
                 "line 1: has a stamp and a position, and no rotation"));
  // Matrices over four rows each have rows of four numbers, too.
  const ScratchFolder scratch;
  io::Warnings warnings;
  const std::string matrix = "1 0 0 5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  CHECK(io::read_pose_file(scratch.write("poses.txt", matrix + matrix), warnings).trajectory.size() == 2);
}

TEST_CASE("Where few stamps agree, the message tells from when to when both go") {
  io::Trajectory counted = side_walk(20);
  for (std::size_t i = 0; i < counted.size(); ++i) counted[i].stamp = static_cast<double>(i);
  const std::string error = error_of([&] { (void)io::evaluate(side_walk(20), counted); });
  CHECK(contains(error, "alignment needs at least 3 pairs of poses, found 2"));
  CHECK(contains(error, "those of the estimate from 0 to 19"));
}

}  // namespace odd_files_test
