// SPDX-License-Identifier: BSD-3-Clause
// `sslam run` and a camera that is wrong, or not known: what it finds, and what it says.
#include <cmath>
#include <string>

#include "cli/room_copy.hpp"
#include "sslam/opencv/camera/camera_file.hpp"

namespace self_calibration_test {
namespace {

namespace fs = std::filesystem;
using namespace sslam::testing;

constexpr double kFocal = 360;  // of the room, pixels

// The room's camera with another focal length and k1.
void spoil_camera(const RoomCopy& room, double focal, double k1) {
  sslam::CameraFile file = sslam::read_camera_file(room.folder / "camera.yaml");
  fs::remove(room.folder / "camera.yaml");
  const auto& p = file.camera.pinhole;
  write(room.folder / "camera.yaml",
        cv::format("Camera.fx: %g\nCamera.fy: %g\nCamera.cx: %g\nCamera.cy: %g\nCamera.k1: %g\nCamera.k2: 0\n"
                   "Camera.p1: 0\nCamera.p2: 0\nCamera.width: %d\nCamera.height: %d\nDepthMapFactor: 5000\n",
                   focal, focal, p.cx, p.cy, k1, file.camera.width, file.camera.height));
}

bool says(const nlohmann::json& metrics, const std::string& text) {
  for (const std::string line : metrics["warnings"])
    if (line.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("run finds the camera of images that nobody calibrated, and writes it into a file") {
  const RoomCopy room;
  fs::remove(room.folder / "camera.yaml");
  const Outcome outcome = room.run("--fov 75");  // a focal length of 313 pixels
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.text.find("the camera was found from the images") != std::string::npos);
  const nlohmann::json metrics = room.metrics();
  INFO(metrics["calibration"].dump());
  CHECK(metrics["calibration"]["replaced"] == true);
  const double found = sslam::read_camera_file(room.out / "camera_found.yaml").camera.pinhole.fx;
  CHECK(std::abs(found / kFocal - 1) < 0.02);
  CHECK(metrics["settings"]["pinhole"][0].get<double>() == Approx(found).epsilon(1e-6));
  CHECK(metrics["share_tracked"] == 1.0);
}

TEST_CASE("run says that a calibration is wrong, tracks again with its own, and leaves a fixed one alone") {
  const RoomCopy room;
  spoil_camera(room, kFocal, 0.2);
  REQUIRE(room.run("--calibration fixed").code == 0);
  const nlohmann::json fixed = room.metrics();
  CHECK_FALSE(fixed.contains("calibration"));
  CHECK_FALSE(fs::exists(room.out / "camera_found.yaml"));
  const Outcome outcome = room.run();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const nlohmann::json refined = room.metrics();
  INFO(refined["calibration"].dump());
  CHECK(says(refined, "the images contradict this calibration"));
  CHECK(refined["calibration"]["given"]["k1"] == 0.2);
  CHECK(std::abs(sslam::read_camera_file(room.out / "camera_found.yaml").camera.distortion.k1) < 0.03);
  const auto error = [](const nlohmann::json& metrics) {
    return metrics["trajectory"]["ate_m"]["rmse"].get<double>();
  };
  CHECK(error(refined) < 0.5 * error(fixed));
  // The file goes, once the calibration is right.
  spoil_camera(room, kFocal, 0);
  REQUIRE(room.run().code == 0);
  CHECK(room.metrics()["calibration"]["replaced"] == false);
  CHECK(room.metrics()["warnings"].empty());
  CHECK_FALSE(fs::exists(room.out / "camera_found.yaml"));
}

TEST_CASE("run tracks once where it cannot track again, and says what to do") {
  const RoomCopy room;
  spoil_camera(room, kFocal, 0.2);
  REQUIRE(room.run("--record " + (room.scratch.path() / "kept").string()).code == 0);
  CHECK(says(room.metrics(), "track them again with --camera"));
  CHECK(room.metrics()["calibration"]["replaced"] == false);
  CHECK(fs::exists(room.out / "camera_found.yaml"));
}

}  // namespace self_calibration_test
