// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --scale`: results in metres, and what is said where they cannot be.
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/room_copy.hpp"
#include "sslam/core/median.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/catch.hpp"

namespace scale_test {

namespace fs = std::filesystem;
using namespace sslam;
using namespace sslam::testing;

namespace {

io::Trajectory poses_in(const fs::path& file) {
  io::Warnings warnings;
  return io::read_trajectory(file, warnings);
}

// How far the run's metres are from the truth's, as a share: the scale that an alignment would still change.
double scale_error(const nlohmann::json& metrics) {
  return std::abs(metrics["trajectory"]["alignment"]["scale"].get<double>() - 1);
}

void require_metres(const RoomCopy& copy, const Outcome& outcome, const char* method, double largest_error) {
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto metrics = copy.metrics();
  INFO(metrics["scale"].dump() << ", off by " << scale_error(metrics));
  REQUIRE(metrics["scale"]["method"] == method);
  REQUIRE(metrics["scale"]["metric"] == true);
  REQUIRE(metrics["scale"]["unit"] == "m");
  REQUIRE(metrics["scale"]["factor"].get<double>() > 0);
  CHECK(scale_error(metrics) < largest_error);
  REQUIRE(metrics["trajectory_se3"]["alignment"]["type"] == "se3");
  REQUIRE(metrics["trajectory_se3"]["ate_m"]["rmse"].get<double>() >=
          metrics["trajectory"]["ate_m"]["rmse"].get<double>());
  for (const char* file : {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply"})
    REQUIRE(text_of(copy.out / file).find(std::string("unit: metres (scale: ") + method + ")") !=
            std::string::npos);
  REQUIRE(outcome.text.find("unit             metres, from ") != std::string::npos);
  REQUIRE(outcome.text.find("metric           position (ATE) ") != std::string::npos);
}

}  // namespace

TEST_CASE("run --scale depth gives trajectories and a map in metres") {
  const RoomCopy copy;
  require_metres(copy, copy.run("--scale depth"), "depth", 0.02);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["scale"]["spread"].get<double>() < 0.05);
  REQUIRE(metrics["scale"]["keyframes"].get<int>() >= 2);
  const io::Trajectory metric = poses_in(copy.out / "trajectory.txt");
  const io::Trajectory live = poses_in(copy.out / "trajectory_live.txt");
  const Map<double> map = io::load_map(copy.out / "map.sslam");
  REQUIRE(copy.run("--scale none").code == 0);
  REQUIRE(copy.metrics()["scale"]["metric"] == false);
  REQUIRE(!copy.metrics().contains("trajectory_se3"));
  REQUIRE(text_of(copy.out / "trajectory.txt").find("unit") == std::string::npos);
  // Nothing but the unit has changed.
  const double factor = metrics["scale"]["factor"];
  const io::Trajectory plain = poses_in(copy.out / "trajectory.txt");
  const io::Trajectory plain_live = poses_in(copy.out / "trajectory_live.txt");
  const auto same = [&](const Vec3<double>& scaled, const Vec3<double>& own) {
    REQUIRE((scaled - factor * own).norm() < 1e-7 * (1 + own.norm()));
  };
  REQUIRE(metric.size() == plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
    same(metric[i].world_from_cam.translation, plain[i].world_from_cam.translation);
  REQUIRE(live.size() == plain_live.size());
  for (std::size_t i = 0; i < live.size(); ++i)
    same(live[i].world_from_cam.translation, plain_live[i].world_from_cam.translation);
  const Map<double> plain_map = io::load_map(copy.out / "map.sslam");
  REQUIRE(map.points.size() == plain_map.points.size());
  for (std::size_t i = 0; i < map.points.size(); ++i)
    same(map.points[i].position, plain_map.points[i].position);
}

TEST_CASE("run --scale height finds the floor and takes the camera's height from it") {
  const RoomCopy copy;
  std::vector<double> heights;  // the rendered world has z up and its floor at 0
  for (const io::StampedPose& pose : poses_in(copy.folder / "groundtruth.txt"))
    heights.push_back(pose.world_from_cam.translation.z());
  const std::string height = std::to_string(median<double>(heights));
  require_metres(copy, copy.run("--scale height=" + height), "height", 0.08);
  REQUIRE(copy.metrics()["scale"]["landmarks"].get<int>() >= 20);
}

TEST_CASE("run --scale known takes the distance between two frames") {
  const RoomCopy copy;
  const io::Trajectory truth = poses_in(copy.folder / "groundtruth.txt");
  const auto apart = [&](std::size_t a, std::size_t b) {
    return std::to_string((truth[a].world_from_cam.translation - truth[b].world_from_cam.translation).norm());
  };
  require_metres(copy, copy.run("--scale known=" + apart(5, 50) + "@5:50"), "known", 0.03);
  REQUIRE(copy.metrics()["scale"]["spread"].is_null());
  require_refused(copy.run("--scale baseline=1@5:600"),
                  "--scale known: frame 600 is not among those that are tracked, 0 to 59");
  // A map in metres stays one for the runs that go on in it.
  const fs::path map = copy.scratch.path() / "kept";
  fs::copy(copy.out, map);
  const Outcome later = copy.run("--map " + (map / "map.sslam").string() + " --start 20 --stride 2");
  INFO(later.text);
  REQUIRE(later.code == 0);
  REQUIRE(copy.metrics()["scale"]["method"] == "map");
  REQUIRE(copy.metrics()["scale"]["metric"] == true);
  CHECK(scale_error(copy.metrics()) < 0.05);
}

TEST_CASE("run says why a scale cannot be found, and keeps the results without it") {
  const RoomCopy copy;
  const Outcome twice = copy.run("--scale known=3@7:7");
  require_misused(twice,
                  "--scale known=3@7:7: '7:7' are no two frames such as 120:480; expected none, depth");
  for (const char* wrong : {"metres", "height", "height=", "height=-1", "height=nan", "depth=2", "known=1@2"})
    require_misused(copy.run(std::string("--scale ") + wrong), std::string("--scale ") + wrong);
  // A frame without a pose, and depth that has nothing to do with the images.
  write(copy.folder / "rgb/000050.jpg", "no image");
  const auto require_unscaled = [&](const std::string& options, const std::string& why) {
    const Outcome outcome = copy.run(options);
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
    REQUIRE(outcome.text.find(why) != std::string::npos);
    REQUIRE(outcome.text.find("; the results stay in the map's own unit") != std::string::npos);
    REQUIRE(copy.metrics()["scale"]["metric"] == false);
    REQUIRE(copy.metrics()["scale"]["factor"] == 1);
    REQUIRE(text_of(copy.out / "trajectory.txt").find("unit") == std::string::npos);
  };
  require_unscaled("--scale known=3@5:50", "--scale known: frame 50 has no pose");
  for (int image = 0; image < kFrames; ++image) {
    const fs::path file = copy.folder / cv::format("depth/%06d.png", image);
    REQUIRE(fs::remove(file));
    const int depth = image % 2 == 0 ? 2000 : 30000;
    REQUIRE(cv::imwrite(file.string(), cv::Mat(360, 480, CV_16UC1, cv::Scalar(depth))));
  }
  require_unscaled("--scale depth", "--scale depth: depth and map do not agree: their ratio differs by ");
  fs::remove(copy.folder / "depth.txt");
  require_refused(copy.run("--scale depth"), "has no depth images; use height=METRES or known=METRES");
}

}  // namespace scale_test
