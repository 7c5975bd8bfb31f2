// SPDX-License-Identifier: BSD-3-Clause
// `sslam run` and a camera that is wrong, or not known: what it finds, and what it says.
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "cli/room_copy.hpp"
#include "cli/run/self_calibration.hpp"
#include "sslam/opencv/camera/camera_file.hpp"

namespace self_calibration_test {
namespace {

namespace fs = std::filesystem;
using namespace sslam::testing;

constexpr double kFocal = 240;  // of the room, pixels

// A camera that walks and turns faster than that of the other tests: more keyframes in less frames.
struct Walk {
  ScratchFolder scratch;
  fs::path folder = rendered(), out = scratch.path() / "out";

  [[nodiscard]] Outcome run(const std::string& options = "") const {
    return run_program("run " + folder.string() + " --quiet --no-report --normals none --out " +
                       out.string() + " " + options);
  }
  [[nodiscard]] nlohmann::json metrics() const {
    std::ifstream file(out / "metrics.json");
    return nlohmann::json::parse(file);
  }

 private:
  static const fs::path& rendered() {
    static const ScratchFolder home;
    static const fs::path path = [] {
      const fs::path to = home.path() / "walk";
      const Outcome outcome = run_program("synth " + to.string() +
                                          " --quiet --frames 100 --speed 1.2 --seed 1 --size 320x240 "
                                          "--texture rich --no-depth --no-normals");
      if (outcome.code != 0) throw std::runtime_error(outcome.text);
      return to;
    }();
    return path;
  }
};

// A file with the room's camera and another k1.
std::string camera_with(const Walk& walk, double k1) {
  const sslam::CameraFile file = sslam::read_camera_file(walk.folder / "camera.yaml");
  const fs::path path = walk.scratch.path() / "given.yaml";
  const double focal = kFocal;
  const auto& p = file.camera.pinhole;
  write(path,
        cv::format("Camera.fx: %g\nCamera.fy: %g\nCamera.cx: %g\nCamera.cy: %g\nCamera.k1: %g\nCamera.k2: 0\n"
                   "Camera.p1: 0\nCamera.p2: 0\nCamera.width: %d\nCamera.height: %d\nDepthMapFactor: 5000\n",
                   focal, focal, p.cx, p.cy, k1, file.camera.width, file.camera.height));
  return path.string();
}

bool says(const nlohmann::json& metrics, const std::string& text) {
  for (const std::string line : metrics["warnings"])
    if (line.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("run finds the camera of images that nobody calibrated, and writes it into a file") {
  const Walk walk;
  const Outcome outcome = walk.run("--fov 75");  // a focal length of 209 pixels
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.text.find("the camera was found from the images") != std::string::npos);
  const nlohmann::json metrics = walk.metrics();
  INFO(metrics["calibration"].dump());
  CHECK(metrics["calibration"]["replaced"] == true);
  const double found = sslam::read_camera_file(walk.out / "camera_found.yaml").camera.pinhole.fx;
  CHECK(std::abs(found / kFocal - 1) < 0.01);
  CHECK(metrics["settings"]["pinhole"][0].get<double>() == Approx(found).epsilon(1e-6));
  CHECK(metrics["share_tracked"] == 1.0);
}

TEST_CASE("run says that a calibration is wrong, tracks again with its own, and leaves a fixed one alone") {
  const Walk walk;
  const std::string wrong = "--camera " + camera_with(walk, 0.15);
  REQUIRE(walk.run(wrong + " --calibration fixed").code == 0);
  const nlohmann::json fixed = walk.metrics();
  CHECK_FALSE(fixed.contains("calibration"));
  CHECK_FALSE(fs::exists(walk.out / "camera_found.yaml"));
  REQUIRE(walk.run(wrong).code == 0);
  const nlohmann::json refined = walk.metrics();
  INFO(refined["calibration"].dump());
  CHECK(says(refined, "the images contradict this calibration"));
  CHECK(refined["calibration"]["given"]["k1"] == 0.15);
  CHECK(std::abs(sslam::read_camera_file(walk.out / "camera_found.yaml").camera.distortion.k1) < 0.02);
  const auto error = [](const nlohmann::json& metrics) {
    return metrics["trajectory"]["ate_m"]["rmse"].get<double>();
  };
  CHECK(error(refined) < 0.2 * error(fixed));
  // The file goes, once the calibration is right.
  REQUIRE(walk.run().code == 0);
  CHECK(walk.metrics()["calibration"]["replaced"] == false);
  CHECK(walk.metrics()["warnings"].empty());
  CHECK_FALSE(fs::exists(walk.out / "camera_found.yaml"));
}

TEST_CASE("run tracks once where it cannot track again, and says what to do") {
  const Walk walk;
  REQUIRE(
      walk.run("--camera " + camera_with(walk, 0.15) + " --record " + (walk.scratch.path() / "kept").string())
          .code == 0);
  CHECK(says(walk.metrics(), "track them again with --camera"));
  CHECK(walk.metrics()["calibration"]["replaced"] == false);
  CHECK(fs::exists(walk.out / "camera_found.yaml"));
}

TEST_CASE("a camera that was found gives way to the given one where it has far fewer poses") {
  sslam::io::Dataset dataset;
  const sslam::cli::MaskSource masks;
  sslam::cli::CameraChoice camera;
  camera.camera.pinhole.fx = kFocal;
  camera.source = "given.yaml";
  sslam::cli::SelfCalibration calibration(dataset, masks, camera, false);
  CHECK_FALSE(calibration.refuted(248, 0));  // none was found
  sslam::cli::CheckpointHead head;
  head.used = camera.camera;
  head.used.pinhole.fx = 0.9 * kFocal;
  head.camera_replaced = true;
  head.camera_warnings = {"tracked with the camera that was found"};
  calibration.go_on(head, camera);
  CHECK_FALSE(calibration.refuted(248, 240));
  CHECK(calibration.replaced());
  REQUIRE(calibration.refuted(248, 0));
  CHECK_FALSE(calibration.replaced());
  REQUIRE(calibration.warnings().size() == 1);
  CHECK(calibration.warnings()[0].find(
            "0 frames have a pose, with the given one 248: the given one is kept") != std::string::npos);
}

}  // namespace self_calibration_test
