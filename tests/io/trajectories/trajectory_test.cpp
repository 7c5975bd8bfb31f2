// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/trajectories/trajectory.hpp"

#include "io/errors.hpp"
#include "io/shared_data.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;

namespace {

io::Trajectory read(const std::filesystem::path& path) {
  io::Warnings warnings;
  io::Trajectory trajectory = io::read_trajectory(path, warnings);
  CHECK(warnings.empty());
  return trajectory;
}

}  // namespace

TEST_CASE("A trajectory survives writing and reading") {
  const testing::ScratchFolder scratch;
  io::Trajectory written;
  for (int i = 0; i < 5; ++i) {
    io::StampedPose pose;
    pose.stamp = 1341836537.655662 + i / 30.0;
    pose.world_from_cam.rotation = SO3<double>::exp(Vec3<double>(0.3 * i, -0.2, 0.7));
    pose.world_from_cam.translation = Vec3<double>(i, -0.123456789, 2.5);
    written.push_back(pose);
  }
  const auto path = scratch.path() / "trajectory.txt";
  io::write_trajectory(path, written);
  const io::Trajectory back = read(path);
  REQUIRE(back.size() == written.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    CHECK(back[i].stamp == written[i].stamp);
    CHECK((back[i].world_from_cam.translation - written[i].world_from_cam.translation).norm() < 1e-8);
    CHECK(angle_between(back[i].world_from_cam.rotation, written[i].world_from_cam.rotation) < 1e-8);
  }
  CHECK(contains(testing::text_of(path), "\n1341836537.655662 0.000000000 -0.123456789 2.500000000 "));
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.path()), {}) == 1);
}

TEST_CASE("Mirroring turns y over twice into itself") {
  SE3<double> pose;
  pose.rotation = SO3<double>::exp(Vec3<double>(0.4, -0.8, 1.1));
  pose.translation = Vec3<double>(1, 2, 3);
  const Mat3<double> s = Vec3<double>(1, -1, 1).asDiagonal();
  const SE3<double> mirrored = io::mirror_y(pose);
  CHECK((mirrored.rotation.matrix() - s * pose.rotation.matrix() * s).norm() < 1e-12);
  CHECK((mirrored.translation - s * pose.translation).norm() < 1e-12);
  const SE3<double> twice = io::mirror_y(mirrored);
  CHECK(angle_between(twice.rotation, pose.rotation) < 1e-12);
}

TEST_CASE("A flawed row is skipped with its line number") {
  const testing::ScratchFolder scratch;
  const std::string good = " 0 0 0 0 0 0 1\n";
  const auto bad_row = GENERATE(as<std::string>{}, "3 0 0 0 0 0 0\n", "3 0 nan 0 0 0 0 1\n",
                                "3 0 0 x 0 0 0 1\n", "3 0 0 0 0 0 0 0\n", "3 0 0 0 0.5 0 0 0\n");
  const auto path = scratch.write("t.txt", "# head\n1" + good + "2" + good + bad_row + "4" + good);
  io::Warnings warnings;
  const io::Trajectory trajectory = io::read_trajectory(path, warnings);
  CHECK(trajectory.size() == 3);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "t.txt: line 4: "));
}

TEST_CASE("A file that is no trajectory says what was expected") {
  const testing::ScratchFolder scratch;
  io::Warnings warnings;
  const auto error = [&](const std::string& text) {
    const auto path = scratch.write("t.txt", text);
    return error_of([&] { (void)io::read_trajectory(path, warnings); });
  };
  CHECK(contains(error(""), "holds no pose"));
  CHECK(contains(error("# only a comment\n"), "holds no pose"));
  const std::string kitti = error("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n");
  CHECK(testing::is_one_line(kitti));
  CHECK(contains(kitti, "line 1: expected 8 numbers 'stamp tx ty tz qx qy qz qw', found 12"));
}

TEST_CASE("Stamps that go backwards or repeat are put in order with a warning") {
  const testing::ScratchFolder scratch;
  const auto path = scratch.write("t.txt",
                                  "1 1 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n"
                                  "3 9 0 0 0 0 0 1\n4 4 0 0 0 0 0 1\n");
  io::Warnings warnings;
  const io::Trajectory trajectory = io::read_trajectory(path, warnings);
  REQUIRE(trajectory.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(trajectory[i].world_from_cam.translation.x() == Approx(i + 1.0));
  REQUIRE(warnings.size() == 2);
  CHECK(contains(warnings[0], "stamps go backwards at 2.000000"));
  CHECK(contains(warnings[1], "1 repeated stamps, the first at 3.000000"));
}

TEST_CASE("An unwritable place is named and nothing is left behind") {
  const testing::ScratchFolder scratch;
  scratch.write("file", "x");
  const std::string below_file = error_of([&] { io::write_trajectory(scratch.path() / "file/t.txt", {}); });
  CHECK(contains(below_file, "file/t.txt: cannot write: Not a directory"));
  const std::string folder = error_of([&] { io::write_trajectory(scratch.path(), {}); });
  CHECK(contains(folder, "cannot write: is a folder"));
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.path()), {}) == 1);
}

TEST_CASE("Published ground truth files are read whole") {
  if (!testing::has_shared_data("tum_fr3_structure_notexture_far")) return;
  CHECK(read(testing::shared_data("tum_fr3_structure_notexture_far/groundtruth.txt")).size() == 2729);
  CHECK(read(testing::shared_data("icl_nuim_of_kt0/groundtruth.txt")).size() == 1507);
  CHECK(read(testing::shared_data("icl_nuim_lr_kt2_normals/livingRoom2.gt.freiburg")).size() == 880);
}
