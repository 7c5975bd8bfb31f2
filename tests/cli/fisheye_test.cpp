// SPDX-License-Identifier: BSD-3-Clause
// `sslam run` on the images of a fisheye of 180 degrees: what it says, and what it cannot do with them.
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/input/camera_yaml.hpp"
#include "cli/room_copy.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "support/fisheye_room.hpp"

namespace fisheye_test {
namespace {

namespace fs = std::filesystem;
using namespace sslam;
using namespace sslam::testing;

constexpr int kImages = 40;

// A dataset in the layout of TUM RGB-D with the lens in camera.yaml.
const fs::path& walk() {
  static const ScratchFolder home;
  static const fs::path folder = [] {
    const fs::path to = home.path() / "walk";
    fs::create_directories(to / "rgb");
    const FisheyeRoom room = render_fisheye_room(half_sphere_lens(), std::numbers::pi / 2, {}, kImages);
    std::string list;
    for (std::size_t i = 0; i < room.images.size(); ++i) {
      const std::string name = "rgb/" + std::to_string(i) + ".jpg";
      cv::imwrite((to / name).string(), room.images[i]);
      list += std::to_string(room.truth[i].stamp) + " " + name + "\n";
    }
    write(to / "rgb.txt", list);
    io::write_trajectory(to / "groundtruth.txt", room.truth);
    CameraFile camera;
    camera.wide = room.lens;
    camera.camera.pinhole = room.lens.pinhole;
    camera.camera.width = room.lens.width;
    camera.camera.height = room.lens.height;
    write(to / "camera.yaml", cli::camera_yaml(camera, ""));
    return to;
  }();
  return folder;
}

struct Run {
  ScratchFolder scratch;
  fs::path out = scratch.path() / "out";

  [[nodiscard]] Outcome run(const std::string& options = "--normals none") const {
    return run_program("run " + walk().string() + " --no-report --out " + out.string() + " " + options);
  }
  [[nodiscard]] nlohmann::json metrics() const {
    std::ifstream file(out / "metrics.json");
    return nlohmann::json::parse(file);
  }
};

// Behind the note about the view.
void require_refused_later(const Outcome& outcome, const std::string& what) {
  INFO(outcome.text);
  REQUIRE(outcome.code == 1);
  const auto error = outcome.text.find("sslam: error: ");
  REQUIRE(error != std::string::npos);
  REQUIRE(outcome.text.find(what, error) != std::string::npos);
  REQUIRE(outcome.text.find('\n', error) == outcome.text.size() - 1);
}

}  // namespace

TEST_CASE("run undistorts a fisheye of 180 degrees to a pinhole's view, and says so once") {
  const Run run;
  const fs::path kept = run.scratch.path() / "kept";
  const Outcome outcome = run.run("--normals none --record " + kept.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const std::string note = "its images are undistorted to a pinhole's view of 110 degrees";
  REQUIRE(outcome.text.find(note) != std::string::npos);
  REQUIRE(outcome.text.find(note) == outcome.text.rfind(note));
  const auto metrics = run.metrics();
  CHECK(metrics["share_tracked"] == 1.0);
  CHECK(metrics["settings"]["undistorted_to_degrees"] == 110);
  CHECK(metrics["settings"]["distortion"][0] == 0);
  CHECK(!metrics.contains("calibration"));
  INFO("ATE " << metrics["trajectory"]["ate_m"]["rmse"]);
  CHECK(metrics["trajectory"]["ate_m"]["rmse"].get<double>() < 0.0024);  // twice what was measured
  CHECK(run_program("export " + run.out.string() + " --format colmap")
            .text.find("undistort the images to it") != std::string::npos);
  // The recording has the images and the lens as they came.
  const std::string first = text_of(run.out / "trajectory.txt");
  const Outcome again =
      run_program("run " + kept.string() + " --quiet --normals none --no-report --out " + run.out.string());
  INFO(again.text);
  REQUIRE(again.code == 0);
  CHECK(text_of(run.out / "trajectory.txt") == first);
}

TEST_CASE("run takes another view of a wide lens, and refuses what belongs to its own images") {
  const Run run;
  const Outcome narrow = run.run("--normals none --undistort-fov 80 --end 20");
  INFO(narrow.text);
  CHECK(run.metrics()["settings"]["undistorted_to_degrees"] == 80);
  require_refused_later(run.run("--normals files:" + walk().string()),
                        "they are those of the wide lens's images");
  const fs::path cut = run.scratch.path() / "cut.yaml";
  write(cut,
        "Camera.type: KannalaBrandt8\nCamera.fx: 300\nCamera.fy: 300\nCamera.cx: 255\nCamera.cy: 255\n"
        "Camera.k1: -0.2\nCamera.k2: 0\nCamera.k3: 0\nCamera.k4: 0\nCamera.width: 512\nCamera.height: 512\n");
  require_refused_later(run.run("--normals none --undistort-fov 139 --camera " + cut.string()),
                        "--undistort-fov asks for more");
  require_misused(run.run("--undistort-fov 170"), "--undistort-fov");
}

TEST_CASE("normals looks at a wide lens's image through a pinhole's view") {
  const ScratchFolder scratch;
  const Outcome outcome = run_program("normals " + (walk() / "rgb/0.jpg").string() + " --camera " +
                                      (walk() / "camera.yaml").string() + " --undistort-fov 80 --model " +
                                      SSLAM_FIXTURES + "/tiny_normals.onnx --out " + scratch.path().string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.text.find("a pinhole's view of 80 degrees") != std::string::npos);
  // The corner is outside the lens's circle, and inside the view.
  const cv::Rect corner(0, 0, 16, 16);
  CHECK(cv::mean(cv::imread((walk() / "rgb/0.jpg").string())(corner))[1] < 8);
  CHECK(cv::mean(cv::imread((scratch.path() / "0_overlay.jpg").string())(corner))[1] > 32);
}

}  // namespace fisheye_test
