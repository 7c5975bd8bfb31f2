// SPDX-License-Identifier: BSD-3-Clause
// The layouts of EuRoC, KITTI, Replica, ScanNet, ETH3D and depth cameras, good and broken.
#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace layouts_test {
namespace {

constexpr const char* kSensor =
    "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0, -1, 0, 0.5,\n         1, 0, 0, 0.25,\n"
    "         0, 0, 1, -0.125,\n         0, 0, 0, 1]\nrate_hz: 20\n";

std::string stamp(int i) {
  return std::to_string(1403636579763555584 + i * 50000000LL);
}

// The body goes along x, turned by half a turn about z: w first.
std::string body_poses(int count) {
  std::string text = "#timestamp [ns], p_RS_R_x [m], p_y, p_z, q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n";
  for (int i = 0; i < count; ++i) text += stamp(i) + "," + std::to_string(i) + ",2,3,0,0,0,1\n";
  return text;
}

void make_euroc(const ScratchFolder& scratch, int count = 4) {
  std::string list = "#timestamp [ns],filename\r\n";
  for (int i = 0; i < count; ++i) {
    scratch.write("mav0/cam0/data/" + stamp(i) + ".png");
    list += stamp(i) + "," + stamp(i) + ".png\r\n";
  }
  scratch.write("mav0/cam0/data.csv", list);
  scratch.write("mav0/cam0/sensor.yaml", kSensor);
  scratch.write("mav0/imu0/data.csv", "#timestamp [ns],w_x\n" + stamp(0) + ",0.1\n");
  scratch.write("mav0/state_groundtruth_estimate0/data.csv", body_poses(count));
}

// The rows of a 4x4 matrix that moves by x.
std::string moved(double x, char between) {
  const std::string cut(1, between);
  return "1 0 0 " + std::to_string(x) + cut + "0 1 0 0" + cut + "0 0 1 0" + cut + "0 0 0 1\n";
}

}  // namespace

TEST_CASE("EuRoC layout: from each of its folders, and the truth is the camera's") {
  const ScratchFolder scratch;
  make_euroc(scratch);
  for (const char* place : {"", "mav0", "mav0/cam0", "mav0/cam0/"}) {
    INFO(place);
    const io::Dataset dataset = io::open_dataset(scratch.path() / place);
    CHECK(dataset.layout == io::Layout::kEuroc);
    CHECK(dataset.warnings.empty());
    REQUIRE(dataset.frames.size() == 4);
    CHECK(std::abs(dataset.frames[2].stamp - 1403636579.863555584) < 1e-6);
    CHECK(dataset.camera_file.filename() == "sensor.yaml");
    const SE3<double>* const pose = dataset.world_from_cam(dataset.frames[2]);
    REQUIRE(pose != nullptr);
    // Half a turn about z takes (0.5, 0.25, -0.125) to (-0.5, -0.25, -0.125); a quarter more is the camera's.
    CHECK((pose->translation - Vec3<double>(1.5, 1.75, 2.875)).norm() < 1e-9);
    CHECK((pose->rotation.matrix() * Vec3<double>::UnitX() - Vec3<double>(0, -1, 0)).norm() < 1e-9);
  }
}

TEST_CASE("EuRoC layout: without its list, its truth or its camera") {
  const ScratchFolder scratch;
  make_euroc(scratch);
  SECTION("the names are stamps") {
    std::filesystem::remove(scratch.path() / "mav0/cam0/data.csv");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.frames.size() == 4);
    CHECK(std::abs(dataset.frames[2].stamp - 1403636579.863555584) < 1e-6);
    CHECK(dataset.world_from_cam(dataset.frames[2]) != nullptr);
  }
  SECTION("mocap, with the transform of Kalibr") {
    std::filesystem::remove_all(scratch.path() / "mav0/state_groundtruth_estimate0");
    std::filesystem::remove(scratch.path() / "mav0/cam0/sensor.yaml");
    scratch.write("mav0/mocap0/data.csv", body_poses(4));
    scratch.write("dso/camchain.yaml",
                  "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, -0.5]\n  - [0.0, 1.0, 0.0, 0.0]\n"
                  "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.world_from_cam(dataset.frames[2]) != nullptr);
    CHECK(std::abs(dataset.world_from_cam(dataset.frames[2])->translation.x() - 1.5) < 1e-9);
    CHECK(dataset.camera_file.filename() == "camchain.yaml");
  }
  SECTION("a body whose camera is not known gives no truth, and the images all the same") {
    for (const char* text : {"sensor_type: camera\n", "T_BS: [1, 2, 3]\n", "T_BS:\n  data: [1, 0, x\n",
                             "T_BS: [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"}) {
      scratch.write("mav0/cam0/sensor.yaml", text);
      const io::Dataset dataset = io::open_dataset(scratch.path());
      CHECK(dataset.frames.size() == 4);
      CHECK(dataset.ground_truth.empty());
      CHECK(contains(dataset.truth_problem, "sensor.yaml: T_BS"));
    }
    std::filesystem::remove(scratch.path() / "mav0/cam0/sensor.yaml");
    CHECK(contains(io::open_dataset(scratch.path()).truth_problem, "the body's poses"));
  }
  SECTION("a list without images") {
    std::filesystem::remove_all(scratch.path() / "mav0/cam0/data");
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }), "which is not there"));
  }
  SECTION("names that are no stamps") {
    std::filesystem::remove(scratch.path() / "mav0/cam0/data.csv");
    scratch.write("mav0/cam0/data/left.png");
    CHECK(contains(error_of([&] { (void)io::open_dataset(scratch.path()); }), "data.csv: is missing"));
  }
}

TEST_CASE("KITTI odometry layout: times, camera and the poses of the benchmark") {
  const ScratchFolder scratch;
  std::string times, poses;
  for (int i = 0; i < 3; ++i) {
    scratch.write("sequences/07/image_0/00000" + std::to_string(i) + ".png");
    times += std::to_string(0.1037 * i) + "\n";
    poses += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  }
  const std::filesystem::path root = scratch.path() / "sequences/07";
  SECTION("all of it") {
    scratch.write("sequences/07/times.txt", times);
    scratch.write("sequences/07/calib.txt", "P0: 700 0 600 0 0 700 180 0 0 0 1 0\n");
    scratch.write("poses/07.txt", poses);
    for (const std::filesystem::path& named : {root, root / ""}) {
      const io::Dataset dataset = io::open_dataset(named);
      CHECK(dataset.layout == io::Layout::kKitti);
      CHECK(dataset.warnings.empty());
      REQUIRE(dataset.frames.size() == 3);
      CHECK(dataset.frames[2].stamp == 0.2074);
      CHECK(dataset.camera_file.filename() == "calib.txt");
      REQUIRE(dataset.world_from_cam(dataset.frames[2]) != nullptr);
      CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 2);
    }
  }
  SECTION("no times") {
    scratch.write("poses/07.txt", poses);
    const io::Dataset dataset = io::open_dataset(root);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "times.txt: is missing"));
    CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == 2);
  }
  SECTION("too few times, too few poses") {
    scratch.write("sequences/07/times.txt", "0\n0.1\n");
    CHECK(contains(error_of([&] { (void)io::open_dataset(root); }), "has 2 times and none for 000002.png"));
    scratch.write("sequences/07/times.txt", times);
    scratch.write("poses/07.txt", poses.substr(0, poses.find('\n') + 1));
    const io::Dataset dataset = io::open_dataset(root);
    CHECK(dataset.ground_truth.size() == 1);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "its 1 rows leave 2 of 3 images without ground truth"));
  }
}

TEST_CASE("Replica layout: a row a frame") {
  const ScratchFolder scratch;
  std::string rows;
  for (int i = 0; i < 4; ++i) {
    if (i != 1) scratch.write("results/frame00000" + std::to_string(i) + ".jpg");
    scratch.write("results/depth00000" + std::to_string(i) + ".png");
    rows += moved(i, ' ');
  }
  scratch.write("traj.txt", rows);
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kReplica);
  REQUIRE(dataset.frames.size() == 3);
  CHECK(contains(dataset.frames[1].depth, "depth000002.png"));
  REQUIRE(dataset.world_from_cam(dataset.frames[1]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[1])->translation.x() == 2);  // by its number, not its place
  scratch.write("traj.txt", "nonsense here\n");
  CHECK(contains(io::open_dataset(scratch.path()).truth_problem, "traj.txt"));
}

TEST_CASE("Replica layout: the camera lies in the folder, or beside it for all rooms") {
  const ScratchFolder scratch;
  scratch.write("office0/results/frame000000.jpg");
  CHECK(io::open_dataset(scratch.path() / "office0").camera_file.empty());
  const auto beside = scratch.write("cam_params.json", "{}");
  for (const char* place : {"office0", "office0/"})
    CHECK(std::filesystem::equivalent(io::open_dataset(scratch.path() / place).camera_file, beside));
  const auto own = scratch.write("office0/cam_params.json", "{}");
  CHECK(std::filesystem::equivalent(io::open_dataset(scratch.path() / "office0").camera_file, own));
}

TEST_CASE("ScanNet layout: poses of minus infinity are none, depth is left out") {
  const ScratchFolder scratch;
  for (int i = 0; i < 12; ++i) {
    const std::string n = std::to_string(i);
    scratch.write("color/" + n + ".jpg");
    scratch.write("depth/" + n + ".png");
    scratch.write("pose/" + n + ".txt",
                  i == 6 ? "1 0 0 6\n0 1 0 0\n0 0 1 0\n"  // without the last row
                  : i == 5
                      ? "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
                      : moved(i, '\n'));
  }
  scratch.write("intrinsic/intrinsic_color.txt", "1170 0 648 0\n0 1170 484 0\n0 0 1 0\n0 0 0 1\n");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kScanNet);
  REQUIRE(dataset.frames.size() == 12);
  CHECK(dataset.frames[11].stamp == 11 / 30.0);
  CHECK(dataset.world_from_cam(dataset.frames[5]) == nullptr);
  REQUIRE(dataset.world_from_cam(dataset.frames[11]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[11])->translation.x() == 11);
  REQUIRE(dataset.world_from_cam(dataset.frames[6]) != nullptr);
  CHECK(dataset.world_from_cam(dataset.frames[6])->translation.x() == 6);
  CHECK(dataset.frames[3].depth.empty());
  REQUIRE(dataset.warnings.size() == 2);
  CHECK(contains(dataset.warnings[0], "depth left out"));
  CHECK(contains(dataset.warnings[1], "1 of 12 poses mean 'no pose here'"));
  CHECK(dataset.camera_file.filename() == "intrinsic_color.txt");
}

TEST_CASE("ScanNet layout: depth that shows the same as colour is taken, in millimetres") {
  const ScratchFolder scratch;
  scratch.write("color/0.jpg");
  scratch.write("depth/0.png");
  scratch.write("pose/0.txt", moved(0, '\n'));
  scratch.write("intrinsic/intrinsic_color.txt", "1170 0 648 0\n0 1170 484 0\n0 0 1 0\n0 0 0 1\n");
  scratch.write("intrinsic/intrinsic_depth.txt", "577.9 0 319.5 0\n0 577.9 239.5 0\n0 0 1 0\n0 0 0 1\n");
  const io::Dataset same = io::open_dataset(scratch.path());
  CHECK(contains(same.frames[0].depth, "0.png"));
  CHECK(same.depth_factor == 1000);
  CHECK(same.warnings.empty());
  scratch.write("intrinsic/intrinsic_depth.txt", "365 0 256 0\n0 365 212 0\n0 0 1 0\n0 0 0 1\n");
  const io::Dataset other = io::open_dataset(scratch.path());
  CHECK(other.frames[0].depth.empty());
  REQUIRE(other.warnings.size() == 1);
  CHECK(contains(other.warnings[0], "depth left out"));
}

TEST_CASE("Numbered colour and depth images without anything else are colour and depth folders") {
  const ScratchFolder scratch;
  for (int i = 0; i < 11; ++i) {
    scratch.write("rgb/" + std::to_string(i) + ".png");
    scratch.write("depth/" + std::to_string(i) + ".png");
  }
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kColourDepth);
  REQUIRE(dataset.frames.size() == 11);
  CHECK(dataset.frames[10].stamp == 10 / 30.0);
  CHECK(contains(dataset.frames[10].depth, "10.png"));
  CHECK(dataset.ground_truth.empty());
  scratch.write("groundtruth.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");  // counts frames
  CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kIclNuim);
}

TEST_CASE("iMAP's rooms: numbers in two kinds of names, and a matrix a row") {
  const ScratchFolder scratch;
  std::string rows;
  for (int i = 0; i < 12; ++i) {
    scratch.write("rgb/rgb_" + std::to_string(i) + ".png");
    scratch.write("depth/depth_" + std::to_string(i) + ".png");
    rows += moved(i, ' ');
  }
  for (const char* name : {"traj_w_c.txt", "traj.txt"}) {
    const auto file = scratch.write(name, rows);
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kColourDepth);
    CHECK(dataset.warnings.empty());
    REQUIRE(dataset.frames.size() == 12);
    CHECK(contains(dataset.frames[11].depth, "depth_11.png"));
    REQUIRE(dataset.world_from_cam(dataset.frames[11]) != nullptr);
    CHECK(dataset.world_from_cam(dataset.frames[11])->translation.x() == 11);
    std::filesystem::remove(file);
  }
  // Some images have gone: rows are of the numbers then.
  for (int i = 0; i < 5; ++i)
    std::filesystem::remove(scratch.path() / ("rgb/rgb_" + std::to_string(i) + ".png"));
  scratch.write("traj_w_c.txt", rows);
  const io::Dataset rest = io::open_dataset(scratch.path());
  REQUIRE(rest.frames.size() == 7);
  REQUIRE(rest.world_from_cam(rest.frames[0]) != nullptr);
  CHECK(rest.world_from_cam(rest.frames[0])->translation.x() == 5);
  scratch.write("traj_w_c.txt", "nonsense here\n");
  CHECK(contains(io::open_dataset(scratch.path()).truth_problem, "traj_w_c.txt"));
}

TEST_CASE("Colour and depth side by side are paired by name, else by time") {
  const ScratchFolder scratch;
  scratch.write("camera_intrinsic.json", "{}");
  SECTION("names") {
    for (const char* name : {"000000", "000001"}) scratch.write("color/" + std::string(name) + ".jpg");
    scratch.write("depth/000001.png");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kColourDepth);
    CHECK(dataset.depth_factor == 1000);
    CHECK(dataset.camera_file.filename() == "camera_intrinsic.json");
    REQUIRE(dataset.frames.size() == 2);
    CHECK(dataset.frames[0].depth.empty());
    CHECK(contains(dataset.frames[1].depth, "000001.png"));
  }
  SECTION("times") {
    for (const char* name : {"1700000000.10", "1700000000.20"})
      scratch.write("rgb/" + std::string(name) + ".png");
    for (const char* name : {"1700000000.15", "1700000000.21"})
      scratch.write("depth/" + std::string(name) + ".png");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kColourDepth);
    CHECK(dataset.frames[0].depth.empty());
    CHECK(contains(dataset.frames[1].depth, "1700000000.21.png"));
  }
  SECTION("neither") {
    scratch.write("color/a.png");
    scratch.write("depth/b.png");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(dataset.warnings[0], "depth left out"));
  }
}

TEST_CASE("Folders of colour and depth may have capitals") {
  const ScratchFolder scratch;
  scratch.write("Color/00001.JPG");
  scratch.write("Depth/00001.PNG");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kColourDepth);
  CHECK(contains(dataset.frames.at(0).depth, "Depth/00001.PNG"));
}

TEST_CASE("Images of several kinds in one folder are not taken for one sequence") {
  const ScratchFolder scratch;
  const std::pair<std::string, std::string> kinds =
      GENERATE(as<std::pair<std::string, std::string>>(), std::pair{"left_", ".png"},
               std::pair{"", "_depth.png"}, std::pair{"cam0_", ".jpg"}, std::pair{"", ".png"});
  const std::string other = kinds.first == "cam0_" ? "cam1_" : "";
  CAPTURE(kinds.first, kinds.second);
  for (const char* number : {"01", "02", "03"}) {
    scratch.write(kinds.first + number + kinds.second);
    scratch.write(other + number + ".jpg");
  }
  const std::string error = error_of([&] { (void)io::open_dataset(scratch.path()); });
  CHECK(testing::is_one_line(error));
  CHECK(contains(error, "holds images of several kinds side by side"));
  CHECK(contains(error, "'" + kinds.first + "??" + kinds.second + "' (3)"));
  CHECK(contains(error, "'" + other + "??.jpg' (3)"));
  const auto glob = scratch.path() / (kinds.first + "??" + kinds.second);
  CHECK(io::open_dataset(glob).frames.size() == 3);
}

TEST_CASE("Names of other forms among the images of a folder are no other kind") {
  const ScratchFolder scratch;
  for (const char* name : {"1.png", "2.png", "3.png", "4.png", "2_hdr.png", "title.png", "a7.png", "b8.png"})
    scratch.write(name);
  CHECK(io::open_dataset(scratch.path()).frames.size() == 8);
}

TEST_CASE("ETH3D has TUM's layout and a camera beside it") {
  const ScratchFolder scratch;
  scratch.write("rgb/1.png");
  scratch.write("rgb.txt", "1.5 rgb/1.png\n");
  scratch.write("calibration.txt", "726 726 354 186\n");
  const io::Dataset dataset = io::open_dataset(scratch.path());
  CHECK(dataset.layout == io::Layout::kTum);
  CHECK(dataset.camera_file.filename() == "calibration.txt");
  CHECK(dataset.depth_factor == 5000);
}

TEST_CASE("A folder that is nearly a dataset is told what it lacks") {
  const ScratchFolder scratch;
  const auto said = [&](const char* text) {
    const std::string error = error_of([&] { (void)io::open_dataset(scratch.path()); });
    CHECK(testing::is_one_line(error));
    return contains(error, text);
  };
  SECTION("EuRoC") {
    scratch.write("mav0/imu0/data.csv", "1,2\n");
    CHECK(said("looks like EuRoC: mav0/cam0/data.csv is missing; looked for"));
  }
  SECTION("TUM") {
    scratch.write("groundtruth.txt");
    CHECK(said("looks like TUM RGB-D: rgb.txt is missing"));
  }
  SECTION("Replica") {
    scratch.write("traj.txt");
    CHECK(said("looks like Replica: results/frame000000.jpg is missing"));
  }
  SECTION("a transforms.json of another name, or without its images") {
    scratch.write("transforms_train.json", "{}");
    CHECK(said(
        "looks like nerfstudio or instant-ngp: transforms.json, or transforms_train.json, with a file_path "
        "in its frames is missing"));
  }
  SECTION("folders and videos below it") {
    scratch.write("walks/one/1.png");
    CHECK(said("no dataset here; below it, and to be named themselves, are "));
    CHECK(said("walks/one; looked for"));
    scratch.write("two.mp4");
    CHECK(said("two.mp4; looked for"));
  }
  SECTION("a table of an inertial sensor") {
    scratch.write("data.csv", "1,2\n");
    CHECK(said("no dataset here; looked for"));
  }
}

}  // namespace layouts_test
