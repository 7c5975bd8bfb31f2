// SPDX-License-Identifier: BSD-3-Clause
// Poses without stamps: rows of seven numbers, and the vertices of a pose graph.
#include <string>

#include "io/errors.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace unstamped_test {
namespace {

io::PoseFile read(const std::string& text, const std::string& times = {}) {
  const ScratchFolder scratch;
  if (!times.empty()) scratch.write("times.txt", times);
  io::Warnings warnings;
  return io::read_pose_file(scratch.write("pose_left.txt", text), warnings);
}

}  // namespace
}  // namespace unstamped_test

TEST_CASE("Seven numbers a row are a position and a quaternion, counted or with their times") {
  using unstamped_test::read;
  const std::string rows = "1 2 3 0 0 0 1\nnan nan nan nan nan nan nan\n4 5 6 0 0 1 0\n";
  const io::PoseFile counted = read(rows);
  CHECK(counted.counted);
  CHECK(counted.no_pose == 1);
  REQUIRE(counted.trajectory.size() == 2);
  CHECK(counted.trajectory[1].stamp == 2);
  CHECK(counted.trajectory[1].world_from_cam.translation.y() == 5);
  CHECK((counted.trajectory[1].world_from_cam.rotation.matrix() * Vec3<double>(1, 0, 0) -
         Vec3<double>(-1, 0, 0))
            .norm() < 1e-12);
  CHECK(read(rows, "10\n11\n12\n").trajectory[1].stamp == 12);
  // A stamp, a turn and a position are something else.
  CHECK(
      contains(error_of([] { (void)unstamped_test::read("1.5 0.1 0.2 0.3 1 2 3\n2.5 0.1 0.2 0.3 1 2 3\n"); }),
               "has 7 columns; expected rows of"));
}

TEST_CASE("The vertices of a pose graph of g2o are poses by their ids") {
  const io::PoseFile graph = unstamped_test::read(
      "VERTEX_SE3:QUAT 7 1 2 3 0 0 0 1\nVERTEX_SE3:QUAT 3 4 5 6 0 0 0 1\n"
      "EDGE_SE3:QUAT 3 7 0 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  CHECK(graph.counted);
  REQUIRE(graph.trajectory.size() == 2);
  CHECK(graph.trajectory[0].stamp == 3);
  CHECK(graph.trajectory[0].world_from_cam.translation.x() == 4);
  CHECK(graph.trajectory[1].stamp == 7);
}
