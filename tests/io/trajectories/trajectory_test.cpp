// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/trajectories/trajectory.hpp"

#include "io/errors.hpp"
#include "io/shared_data.hpp"
#include "sslam/io/trajectories/colmap_images.hpp"
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
  const auto bad_row = GENERATE(as<std::string>{}, "3 0 0 0 0 0 0\n", "3 0 0 x 0 0 0 1\n",
                                "3 0 0 0 0.5 0 0 0\n", "nan 0 0 0 0 0 0 1\n");
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
  CHECK(contains(kitti, "its poses have no stamps; put their times into times.txt"));
  CHECK(contains(error("1 2 3\n4 5 6\n"),
                 "line 1: has 3 columns; expected rows of 'stamp tx ty tz qx qy qz qw'"));
}

TEST_CASE("Rows that mean no pose are left out and counted, however many") {
  const testing::ScratchFolder scratch;
  const auto none = GENERATE(as<std::string>{}, " nan nan nan nan nan nan nan", " 0 0 0 0 0 0 0",
                             " -nan(ind) 0 0 0 0 0 1", " -inf -inf -inf -inf -inf -inf -inf",
                             " 1 2 3 0 0 0 0", " None None None None None None None", " lost", "");
  std::string text;
  for (int i = 0; i < 9; ++i) text += std::to_string(i) + (i % 3 == 0 ? " 1 2 3 0 0 0 1" : none) + "\n";
  const auto path = scratch.write("t.txt", text);
  io::Warnings warnings;
  const io::Trajectory trajectory = io::read_trajectory(path, warnings);
  REQUIRE(trajectory.size() == 3);
  CHECK(trajectory[1].stamp == 3);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "t.txt: 6 of 9 poses mean 'no pose here'"));
}

namespace {

// A turn that tells the parts of a quaternion apart.
const SO3<double>& some_turn() {
  static const SO3<double> turn = SO3<double>::from_quaternion(0.5, 0.1, -0.7, 0.5);
  return turn;
}

// `numbers` stands for the pose in each of three rows, which move along x.
void check_three(const std::filesystem::path& path, double first, double step) {
  io::Warnings warnings;
  const io::Trajectory trajectory = io::read_trajectory(path, warnings);
  REQUIRE(trajectory.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double n = static_cast<double>(i);
    CHECK(std::abs(trajectory[i].stamp - (first + step * n)) < 1e-6);
    CHECK((trajectory[i].world_from_cam.translation - Vec3<double>(n, 2, 3)).norm() < 1e-9);
    CHECK(angle_between(trajectory[i].world_from_cam.rotation, some_turn()) < 1e-9);
  }
}

}  // namespace

TEST_CASE("Trajectories of other programs are told by their rows") {
  const testing::ScratchFolder scratch;
  const auto number = [](double value) { return io::exact_decimal(value, 12); };
  const auto q = some_turn().quaternion();
  const Mat3<double> r = some_turn().matrix();
  const std::string x = number(q.x()), y = number(q.y()), z = number(q.z()), w = number(q.w());
  const auto matrix = [&](int i, const std::string& between, bool last) {
    std::string text;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) text += number(r(row, column)) + ' ';
      text += number(row == 0 ? i : row + 1) + (row < 2 || last ? between : "");
    }
    return text + (last ? "0 0 0 1" : "");
  };
  const auto three = [](const auto& row) { return row(0) + '\n' + row(1) + '\n' + row(2) + '\n'; };
  const auto ns = [](int i) { return "140363657" + std::to_string(i) + "763555584"; };
  const auto n = [](int i) { return std::to_string(i); };
  const std::string euroc_head =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []";
  const auto euroc = [&](int i) { return ns(i) + "," + n(i) + ",2,3," + w + "," + x + "," + y + "," + z; };
  check_three(scratch.write("a.csv", euroc_head + "\n" + three(euroc)), 1403636570.763555, 1);
  check_three(scratch.write("b.csv", three(euroc)), 1403636570.763555, 1);
  check_three(scratch.write("c.csv", euroc_head + ", v_RS_R_x [m s^-1]\n" +
                                         three([&](int i) { return euroc(i) + ",1,2,3,4,5,6,7,8,9"; })),
              1403636570.763555, 1);
  const auto tum = [&](int i) { return n(i) + " " + n(i) + " 2 3 " + x + ' ' + y + ' ' + z + ' ' + w; };
  check_three(scratch.write("d.txt", "\xEF\xBB\xBF" + three(tum)), 0, 1);
  const auto named = [&](int i) { return n(i) + ";" + n(i) + ";2;3;" + w + ';' + x + ';' + y + ';' + z; };
  check_three(scratch.write("e.txt", "t;tx;ty;tz;qw;qx;qy;qz\n" + three(named)), 0, 1);
  check_three(scratch.write("f.txt", three([&](int i) { return n(i) + ' ' + matrix(i, " ", false); })), 0, 1);
  check_three(scratch.write("g.txt", three([&](int i) { return n(i) + ' ' + matrix(i, " ", true); })), 0, 1);
  scratch.write("times.txt", "5.5\n5.6\n5.7\n");
  check_three(scratch.write("h.txt", three([&](int i) { return matrix(i, " ", false); })), 5.5, 0.1);
  check_three(scratch.write("i.txt", three([&](int i) { return matrix(i, " ", true); })), 5.5, 0.1);
  check_three(scratch.write("j.txt", three([&](int i) { return matrix(i, "\n", true); })), 5.5, 0.1);
  scratch.write("k_times.txt", "5\n6\n");
  const auto k = scratch.write("k.txt", three([&](int i) { return matrix(i, " ", false); }));
  io::Warnings warnings;
  CHECK(contains(error_of([&] { (void)io::read_trajectory(k, warnings); }),
                 "k_times.txt: has 2 times for the 3 poses"));
}

TEST_CASE("A head that names the columns tells their order") {
  const testing::ScratchFolder scratch;
  const std::string table = GENERATE(
      as<std::string>(), "qx,qy,qz,qw,tx,ty,tz,timestamp\n0,0.6,0,0.8,1,2,3,5\n0,0.6,0,0.8,1,2,3,6\n",
      "# time qx qy qz qw x y z\n5 0 0.6 0 0.8 1 2 3\n6 0 0.6 0 0.8 1 2 3\n",
      ",timestamp,tx,ty,tz,qx,qy,qz,qw\n0,5,1,2,3,0,0.6,0,0.8\n1,6,1,2,3,0,0.6,0,0.8\n",
      "\"stamp\";\"p_x\";\"p_y\";\"p_z\";\"q_w\";\"q_x\";\"q_y\";\"q_z\"\n5;1;2;3;0.8;0;0.6;0\n6;1;2;3;0.8;0;"
      "0.6;0\n",
      "#timestamp [s], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1]\n5,1,2,3,0.8,0,0.6,0,9\n6,1,2,3,0.8,0,0.6,0,9\n",
      "%time,field.seq,field.pose.position.x,field.pose.position.y,field.pose.position.z,"
      "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w\n"
      "5,1,1,2,3,0,0.6,0,0.8\n6,2,1,2,3,0,0.6,0,0.8\n");
  CAPTURE(table);
  const io::Trajectory poses = read(scratch.write("t.csv", table));
  REQUIRE(poses.size() == 2);
  CHECK(poses[1].stamp == 6);
  CHECK(poses[1].world_from_cam.translation == Vec3<double>(1, 2, 3));
  const auto expected = SO3<double>::from_quaternion(0.8, 0, 0.6, 0);
  CHECK(angle_between(poses[1].world_from_cam.rotation, expected) < 1e-12);
}

TEST_CASE("A row of a named table that has lost its end is bad, not another table's") {
  const testing::ScratchFolder scratch;
  const std::string head = "time,tx,ty,tz,qw,qx,qy,qz,speed\n", good = ",1,2,3,0.8,0,0.6,0,9\n";
  io::Warnings warnings;
  const auto poses = io::read_trajectory(
      scratch.write("t.csv", head + "1" + good + "2" + good + "3,1,2,3,0.8,0,0.6,0\n"), warnings);
  CHECK(poses.size() == 2);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "line 4: expected 9 numbers, found 8"));
}

TEST_CASE("Open3D's trajectory.log is read by the numbers of its frames") {
  const testing::ScratchFolder scratch;
  const std::string matrix = "1 0 0 2\n0 0 -1 3\n0 1 0 4\n0 0 0 1\n";
  const auto path = scratch.write("trajectory.log", "0\t0\t1\n" + matrix + "2 2 3\n" + matrix);
  io::Warnings warnings;
  const io::PoseFile file = io::read_pose_file(path, warnings);
  CHECK(warnings.empty());
  CHECK(file.counted);
  REQUIRE(file.trajectory.size() == 2);
  CHECK(file.trajectory[1].stamp == 2);
  CHECK(file.trajectory[1].world_from_cam.translation == Vec3<double>(2, 3, 4));
  scratch.write("times.txt", "10.5\n10.7\n");
  CHECK(io::read_pose_file(path, warnings).trajectory[1].stamp == 10.7);
  scratch.write("trajectory.log", "0 0 1\n" + matrix + "1 1.5 2\n" + matrix);
  CHECK(contains(error_of([&] { (void)io::read_pose_file(path, warnings); }), "has 3 columns"));
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

TEST_CASE("COLMAP's images are read from both of its forms, camera to world") {
  const testing::ScratchFolder scratch;
  // A quarter turn about z: world x is the camera's y. The camera stands at R' (-t).
  const double half = std::sqrt(0.5);
  const std::string text =
      "# comment\n3 0.70710678118654752 0 0 0.70710678118654752 1 2 3 1 a b/10.png\n\n"
      "4 1 0 0 0 0 0 -5 1 9.png\n1 2 -1\n";
  const auto rows = io::split_rows(text);
  const auto images = io::read_colmap_text("images.txt", rows);
  REQUIRE(images.size() == 2);
  CHECK(images[0].name == "a b/10.png");
  CHECK((images[0].world_from_cam.translation - Vec3<double>(-2, 1, -3)).norm() < 1e-12);
  CHECK((images[1].world_from_cam.translation - Vec3<double>(0, 0, 5)).norm() < 1e-12);
  std::string bytes;
  const auto put = [&bytes](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(std::uint64_t{1});
  put(std::int32_t{3});
  for (const double value : {half, 0.0, 0.0, half, 1.0, 2.0, 3.0}) put(value);
  put(std::int32_t{1});
  bytes += std::string("10.png") + '\0';
  put(std::uint64_t{1});
  for (const double value : {1.0, 2.0}) put(value);
  put(std::int64_t{-1});
  const auto binary = io::read_colmap_binary(scratch.write("images.bin", bytes));
  REQUIRE(binary.size() == 1);
  CHECK(binary[0].name == "10.png");
  CHECK((binary[0].world_from_cam.translation - Vec3<double>(-2, 1, -3)).norm() < 1e-12);
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    CHECK(contains(
        error_of([&] { (void)io::read_colmap_binary(scratch.write("images.bin", bytes.substr(0, cut))); }),
        "is cut off"));
}
