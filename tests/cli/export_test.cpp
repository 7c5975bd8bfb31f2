// SPDX-License-Identifier: BSD-3-Clause
// `sslam export`: what it writes, read back by the rules of the programs that it is for.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/room_copy.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "support/catch.hpp"
#include "support/colmap_model.hpp"

namespace fs = std::filesystem;
using namespace sslam::testing;

namespace {

Outcome export_run(const fs::path& run, const std::string& options) {
  return run_program("export " + run.string() + " " + options);
}

// One run for the tests that only read it.
const RoomCopy& tracked_room() {
  static const RoomCopy copy;
  static const Outcome outcome = copy.run("--normals depth");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  return copy;
}

}  // namespace

TEST_CASE("export writes a COLMAP model whose points project to its features") {
  const RoomCopy& room = tracked_room();
  const fs::path out = room.scratch.path() / "model";
  const Outcome outcome = export_run(room.out, "--format colmap --out " + out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const ColmapModel model = read_model(out);
  const auto metrics = room.metrics();
  REQUIRE(model.cameras.size() == 1);
  REQUIRE(model.cameras.begin()->second[2] == Approx(240));  // the middle of 480 pixels, from their corner
  REQUIRE(model.images.size() == metrics["keyframes"]);
  REQUIRE(model.points.size() > 100);
  std::vector<double> errors;
  std::size_t tracks = 0, referred = 0;
  for (const auto& [id, point] : model.points) {
    REQUIRE(point.track.size() >= 2);
    double sum = 0;
    for (const auto& [image_id, feature] : point.track) {
      const ColmapImage& image = model.images.at(image_id);
      REQUIRE(image.points.at(feature).id == id);  // both files say the same
      errors.push_back(reprojection_error(model, image, point, feature));
      sum += errors.back();
    }
    tracks += point.track.size();
    REQUIRE(point.error == Approx(sum / static_cast<double>(point.track.size())).margin(2e-3));
  }
  for (const auto& [id, image] : model.images) {
    REQUIRE(fs::exists(room.folder / "rgb" / image.name));
    for (const ColmapPoint2& p : image.points) referred += p.id != -1 ? 1U : 0U;
  }
  REQUIRE(referred == tracks);
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1);
  CHECK(errors[errors.size() * 9 / 10] < 3);
}

TEST_CASE("export writes trajectories as TUM's and KITTI's tools read them") {
  const RoomCopy& room = tracked_room();
  REQUIRE(export_run(room.out, "--format tum").code == 0);
  std::vector<std::string> ignored;
  const auto poses = sslam::io::read_trajectory(room.out / "trajectory.txt", ignored);
  const auto tum = lines_of(room.out / "tum/trajectory.txt");
  REQUIRE(tum.size() == poses.size());
  for (std::size_t i = 0; i < tum.size(); ++i) {
    const auto numbers = numbers_of(tum[i]);
    REQUIRE(numbers.size() == 8);
    REQUIRE(numbers[0] == poses[i].stamp);
    const auto q = poses[i].world_from_cam.rotation.quaternion();
    const auto& t = poses[i].world_from_cam.translation;
    const double wanted[] = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
    for (std::size_t j = 0; j < 7; ++j) REQUIRE(std::abs(numbers[j + 1] - wanted[j]) < 2e-9);
  }
  const Outcome outcome = export_run(room.out, "--format kitti");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto rows = lines_of(room.out / "kitti/poses.txt"), times = lines_of(room.out / "kitti/times.txt");
  REQUIRE(rows.size() == poses.size());
  REQUIRE(times.size() == poses.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto numbers = numbers_of(rows[i]);
    REQUIRE(numbers.size() == 12);
    REQUIRE(std::stod(times[i]) == poses[i].stamp);
    const sslam::SE3<double>& pose = poses[i].world_from_cam;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        REQUIRE(std::abs(numbers[static_cast<std::size_t>(4 * row + column)] -
                         pose.rotation.matrix()(row, column)) < 1e-7);
      REQUIRE(std::abs(numbers[static_cast<std::size_t>(4 * row + 3)] - pose.translation[row]) < 1e-7);
    }
  }
}

TEST_CASE("export writes the map that the run wrote") {
  const RoomCopy& room = tracked_room();
  REQUIRE(export_run(room.out, "--format ply").code == 0);
  REQUIRE(text_of(room.out / "ply/map.ply") == text_of(room.out / "map.ply"));
}

TEST_CASE("export names the frames of a video, and those of an earlier run") {
  const RoomCopy copy;
  const fs::path video = copy.scratch.path() / "walk.mp4", camera = copy.folder / "camera.yaml";
  REQUIRE(copy.run("--video " + video.string()).code == 0);
  fs::copy_file(copy.out / "map.sslam", copy.scratch.path() / "map.sslam");
  // An overlay video is no recording to measure by, but one that can be tracked.
  write(camera,
        "%YAML:1.0\n---\nCamera.fx: 360\nCamera.fy: 360\nCamera.cx: 239.5\nCamera.cy: 179.5\nCamera.k1: "
        "-0.01\n");
  Outcome outcome = run_program("run " + video.string() + " --quiet --normals none --no-report --camera " +
                                camera.string() + " --out " + copy.out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  outcome = export_run(copy.out, "--format colmap");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("sslam: note: the model's features and camera are free of lens distortion") == 0);
  REQUIRE(text_of(copy.out / "colmap/images.txt").find(" walk_0000") != std::string::npos);

  fs::remove(camera);
  const RoomCopy other;
  REQUIRE(other.run("--start 30 --map " + (copy.scratch.path() / "map.sslam").string()).code == 0);
  outcome = export_run(other.out, "--format colmap");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("keyframes are in no row of frames.csv") != std::string::npos);
  REQUIRE(text_of(other.out / "colmap/images.txt").find(" keyframe_000000.png\n") != std::string::npos);
}

TEST_CASE("export refuses what it cannot use with one line") {
  const RoomCopy copy;
  const fs::path& scratch = copy.scratch.path();
  require_refused(export_run(scratch / "nowhere", "--format tum"),
                  "nowhere: no such folder; expected the one that");
  require_refused(export_run(copy.folder, "--format tum"), "holds no run that can be read");
  REQUIRE(copy.run("--end 2").code == 1);
  for (const char* format : {"tum", "kitti", "ply", "colmap"})
    require_refused(export_run(copy.out, std::string("--format ") + format), "out: the run tracked no frame");
  REQUIRE(copy.run().code == 0);
  write(scratch / "file", "not a folder");
  require_refused(export_run(copy.out, "--format kitti --out " + (scratch / "file").string()),
                  "file: cannot make this folder");
  fs::resize_file(copy.out / "map.sslam", fs::file_size(copy.out / "map.sslam") / 2);
  require_refused(export_run(copy.out, "--format colmap"), "map.sslam: holds ");
  fs::remove(copy.out / "trajectory.txt");
  require_refused(export_run(copy.out, "--format kitti"), "trajectory.txt: is missing");
  const Outcome unknown = export_run(copy.out, "--format bundler");
  REQUIRE(unknown.code == 2);
  REQUIRE(unknown.text.find("sslam: error: --format: bundler not in {colmap,kitti,ply,tum}") == 0);
}
