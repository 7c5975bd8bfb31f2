// SPDX-License-Identifier: BSD-3-Clause
// transforms.json as a dataset and as a trajectory.
#include "sslam/io/trajectories/transforms.hpp"

#include <string>

#include "io/errors.hpp"
#include "sslam/io/datasets/open_dataset.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;
using testing::contains;
using testing::error_of;
using testing::ScratchFolder;

namespace transforms_test {

// A frame at (x, 2, 3); its camera looks along the world's -z with y up.
std::string frame(const std::string& file, int x, const std::string& more = {}) {
  return "{\"file_path\": \"" + file + "\"" + more + ", \"transform_matrix\": [[1, 0, 0, " +
         std::to_string(x) + "], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]}";
}

void write(const ScratchFolder& scratch, const std::vector<std::string>& frames,
           const std::string& file = "transforms.json") {
  std::string text = "{\"fl_x\": 500, \"w\": 640, \"h\": 480,\n \"frames\": [";
  for (const std::string& one : frames) text += (text.back() == '[' ? "\n" : ",\n") + one;
  scratch.write(file, text + "]}\n");
}

}  // namespace transforms_test

TEST_CASE("transforms.json: images in natural order, depth, and poses in our axes") {
  const ScratchFolder scratch;
  for (const char* name : {"images/2.png", "images/10.jpg", "images/1.png", "depth/10.png"})
    scratch.write(name);
  const std::string depth = ", \"depth_file_path\": \"depth/10.png\"";
  transforms_test::write(
      scratch, {transforms_test::frame("images/10.jpg", 10, depth), transforms_test::frame("./images/2", 2),
                transforms_test::frame("/home/somebody/images/1.png", 1)});
  const io::Dataset dataset = io::open_dataset(scratch.path(), {.frame_rate = 10});
  CHECK(dataset.layout == io::Layout::kTransforms);
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == 3);
  for (const io::FrameEntry& frame : dataset.frames) {
    CHECK(std::filesystem::is_regular_file(frame.image));
    const SE3<double>* pose = dataset.world_from_cam(frame);
    REQUIRE(pose != nullptr);
    const std::filesystem::path image = frame.image;
    CHECK(pose->translation.x() == std::stoi(image.stem().string()));
    CHECK((pose->rotation.matrix() * Vec3<double>(0, 0, 1) - Vec3<double>(0, 0, -1)).norm() < 1e-12);
    CHECK((pose->rotation.matrix() * Vec3<double>(0, 1, 0) - Vec3<double>(0, -1, 0)).norm() < 1e-12);
    CHECK(frame.depth.empty() == (image.stem() != "10"));
  }
  CHECK(dataset.frames[1].stamp == 0.1);
}

TEST_CASE("transforms.json: numbers in names count, timestamps go before them") {
  const ScratchFolder scratch;
  for (const char* name : {"a9.png", "a10.png", "a11.png"}) scratch.write(name);
  const bool stamped = GENERATE(false, true);
  const auto at = [&](int second) {
    return stamped ? ", \"timestamp\": " + std::to_string(second) + ".5" : std::string();
  };
  transforms_test::write(
      scratch, {transforms_test::frame("a11.png", 11, at(1)), transforms_test::frame("a9.png", 9, at(3)),
                transforms_test::frame("a10.png", 10, at(2))});
  const io::Dataset dataset = io::open_dataset(scratch.path());
  REQUIRE(dataset.frames.size() == 3);
  CHECK(std::filesystem::path(dataset.frames[0].image).filename() == (stamped ? "a11.png" : "a9.png"));
  CHECK(dataset.frames[0].stamp == (stamped ? 1.5 : 0));
  CHECK(dataset.world_from_cam(dataset.frames[2])->translation.x() == (stamped ? 9 : 11));

  io::Warnings warnings;
  const io::PoseFile poses = io::read_pose_file(scratch.path() / "transforms.json", warnings);
  CHECK(warnings.empty());
  CHECK(poses.counted == !stamped);
  REQUIRE(poses.trajectory.size() == 3);
  CHECK(poses.trajectory[1].stamp == (stamped ? 2.5 : 1));
  CHECK(poses.trajectory[1].world_from_cam.translation.x() == 10);
  if (stamped) return;
  scratch.write("times.txt", "7\n8\n9\n");
  CHECK(io::read_pose_file(scratch.path() / "transforms.json", warnings).trajectory[2].stamp == 9);
  scratch.write("times.txt", "7\n");
  CHECK(contains(error_of([&] { (void)io::read_pose_file(scratch.path() / "transforms.json", warnings); }),
                 "times.txt: has 1 times for the 3 frames of"));
}

TEST_CASE("transforms.json: broken and empty ones are refused in one line") {
  const ScratchFolder scratch;
  const auto error = [&] {
    const std::string text = error_of([&] { (void)io::open_dataset(scratch.path()); });
    CHECK(testing::is_one_line(text));
    return text;
  };
  SECTION("cut off") {
    scratch.write("transforms.json", "{\"frames\": [{\"file_path\": \"a.png\"");
    CHECK(contains(error(), "transforms.json: line 1"));
  }
  SECTION("no image is there") {
    transforms_test::write(scratch, {transforms_test::frame("a", 1), transforms_test::frame("b", 2)});
    CHECK(contains(error(), "which is not there"));
  }
  SECTION("matrices of another size") {
    scratch.write("a.png");
    transforms_test::write(scratch, {"{\"file_path\": \"a.png\", \"transform_matrix\": [[1, 2], [3, 4]]}"});
    const std::string why = "transform_matrix has 4 numbers; expected 4x4";
    const io::Dataset dataset = io::open_dataset(scratch.path());  // tracking needs no truth
    CHECK(dataset.frames.size() == 1);
    CHECK(dataset.ground_truth.empty());
    CHECK(contains(dataset.truth_problem, why));
    CHECK(contains(dataset.warnings.at(0), "; ground truth left out"));
    io::Warnings warnings;
    CHECK(contains(error_of([&] { (void)io::read_pose_file(scratch.path() / "transforms.json", warnings); }),
                   why));
  }
  SECTION("frames without poses") {
    scratch.write("a.png");
    transforms_test::write(scratch, {"{\"file_path\": \"a.png\"}"});
    CHECK(io::open_dataset(scratch.path()).ground_truth.empty());
    io::Warnings warnings;
    CHECK(contains(error_of([&] { (void)io::read_pose_file(scratch.path() / "transforms.json", warnings); }),
                   "transforms.json: holds no pose"));
  }
}

TEST_CASE("A transforms.json that holds a camera alone leaves its folder a folder of images") {
  const ScratchFolder scratch;
  scratch.write("1.png");
  scratch.write("transforms.json", "{\"fl_x\": 500, \"frames\": []}\n");
  CHECK(io::open_dataset(scratch.path()).layout == io::Layout::kImages);
}

TEST_CASE("transforms_train.json and its like are one sequence where there is no transforms.json") {
  using namespace transforms_test;
  const ScratchFolder scratch;
  for (const char* name : {"images/1.png", "images/2.png", "images/3.png", "images/10.png"})
    scratch.write(name);
  write(scratch, {frame("images/1", 1), frame("images/10", 10), frame("images/3", 3)},
        "transforms_train.json");
  SECTION("alone") {
    const io::Dataset dataset = io::open_dataset(scratch.path());
    CHECK(dataset.layout == io::Layout::kTransforms);
    CHECK(dataset.warnings.empty());
    CHECK(dataset.frames.size() == 3);
    CHECK(dataset.camera_file.filename() == "transforms_train.json");
  }
  SECTION("with the part for tests") {
    write(scratch, {frame("images/2", 2)}, "transforms_test.json");
    const io::Dataset dataset = io::open_dataset(scratch.path());
    REQUIRE(dataset.frames.size() == 4);
    const int numbers[] = {1, 2, 3, 10};
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(dataset.world_from_cam(dataset.frames[i])->translation.x() == numbers[i]);
    REQUIRE(dataset.warnings.size() == 1);
    CHECK(contains(
        dataset.warnings[0],
        "transforms_train.json, transforms_test.json list 3, 1 images: taken as one sequence, by the "
        "natural order of their names"));
  }
  SECTION("not beside transforms.json") {
    write(scratch, {frame("images/2", 2)});
    CHECK(io::open_dataset(scratch.path()).frames.size() == 1);
  }
}
