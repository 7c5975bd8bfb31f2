// SPDX-License-Identifier: BSD-3-Clause
// `sslam eval` where stamps of two clocks are compared, or no stamps but names of images.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/room_copy.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace eval_clock_test {
namespace {

namespace fs = std::filesystem;
using namespace sslam;
using namespace sslam::testing;

// One pose every `step` seconds of a walk that never repeats itself, on a clock that is `late`.
io::Trajectory walk(double from, double to, double step, double late) {
  io::Trajectory poses;
  for (double t = from; t < to; t += step) {
    SE3<double> pose;
    pose.rotation = SO3<double>::exp(Vec3<double>(0, 0.8 * std::sin(0.5 * t) + 0.3 * std::sin(1.7 * t), 0));
    pose.translation =
        Vec3<double>(std::sin(0.3 * t) + 0.2 * std::sin(1.3 * t), 0.1 * std::sin(0.7 * t), 0.4 * t);
    poses.push_back({t + late, pose});
  }
  return poses;
}

}  // namespace

TEST_CASE("eval --find-offset brings clocks together that differ by any time") {
  const ScratchFolder scratch;
  const fs::path truth = scratch.path() / "truth.txt", estimate = scratch.path() / "estimate.txt",
                 json = scratch.path() / "figures.json";
  io::write_trajectory(truth, walk(0, 30, 0.01, 1.7e9));
  io::write_trajectory(estimate, walk(4, 26, 1 / 30.0, 0));
  const std::string both = truth.string() + " " + estimate.string();
  CHECK(run_program("eval " + both).code == 1);  // no overlap
  const Outcome outcome = run_program("eval " + both + " --find-offset --json " + json.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.text.find("time offset      +1700000000.00") == 0);
  std::ifstream file(json);
  const auto figures = nlohmann::json::parse(file);
  CHECK(std::abs(figures["time_offset"]["offset"].get<double>() - 1.7e9) < 0.003);
  CHECK(figures["ate_m"]["rmse"].get<double>() < 0.01);
  CHECK(figures["pairs"].get<int>() > 600);
  io::write_trajectory(estimate, io::Trajectory(walk(4, 4.5, 1 / 30.0, 0)));
  require_refused(run_program("eval " + both + " --find-offset"), "--find-offset: fewer than 20 poses");
}

TEST_CASE("eval takes a model of COLMAP as ground truth or estimate, by the names of its images") {
  const ScratchFolder scratch;
  const fs::path run = scratch.path() / "run", model = scratch.path() / "sparse";
  fs::create_directories(run);
  fs::create_directories(model);
  const io::Trajectory poses = walk(0, 10, 0.5, 100);
  io::write_trajectory(run / "trajectory.txt", poses);
  std::string frames = "index,stamp,image\n", images = "# Image list with two lines of data per image:\n";
  for (std::size_t i = poses.size(); i-- > 0;) {  // COLMAP's order is its own
    const SE3<double> cam_from_world = poses[i].world_from_cam.inverse();
    const auto q = cam_from_world.rotation.quaternion();
    const auto& t = cam_from_world.translation;
    const std::string name = "shot " + std::to_string(i) + ".jpg";
    char row[256];
    std::snprintf(row, sizeof row, "%zu %.12g %.12g %.12g %.12g %.12g %.12g %.12g 1 left/%s\n", i + 1, q.w(),
                  q.x(), q.y(), q.z(), t.x(), t.y(), t.z(), name.c_str());
    images += row + std::string(i % 2 == 0 ? "\n" : "10.5 20.5 -1 11.5 21.5 7 12.5 22.5 8\n");
    frames += std::to_string(i) + "," + std::to_string(poses[i].stamp) + "," + name + "\n";
  }
  write(run / "frames.csv", frames);
  write(run / "metrics.json", "{}");
  write(model / "images.txt", images);
  const std::string a = model.string() + " ", b = run.string();
  for (const std::string& files : {a + b, b + "/trajectory.txt " + a, a + (model / "images.txt").string()}) {
    const Outcome outcome = run_program("eval " + files + " --align none");
    INFO(files << "\n" << outcome.text);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.text.find("compared         20,") != std::string::npos);
    CHECK(outcome.text.find("position (ATE)                0.0000    0.0000    0.0000    0.0000") !=
          std::string::npos);
    CHECK(outcome.text.find("rotation                      0.0000    0.0000    0.0000    0.0000") !=
          std::string::npos);
  }
  fs::copy(run / "trajectory.txt", scratch.path() / "alone.txt");
  require_refused(run_program("eval " + (scratch.path() / "alone.txt").string() + " " + a),
                  "its images have names that are no stamps, such as left/shot 19.jpg");
  write(run / "frames.csv", "index,stamp,image\n0,1,other.png\n");
  require_refused(run_program("eval " + a + b), "none of its images is among those that it is compared with");
  write(model / "images.bin", "\x05");
  fs::remove(model / "images.txt");
  require_refused(run_program("eval " + a + b), "images.bin: is cut off, or no images.bin of COLMAP");
}

}  // namespace eval_clock_test
