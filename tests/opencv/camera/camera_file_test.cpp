// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/camera/camera_file.hpp"

#include <filesystem>
#include <string>

#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace sslam;

namespace {

// A camera file for one test.
class Yaml {
 public:
  explicit Yaml(const std::string& lines) : path_(folder_.write("camera.yaml", "%YAML:1.0\n---\n" + lines)) {}
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  testing::ScratchFolder folder_;
  std::filesystem::path path_;
};

std::string error_of(const std::filesystem::path& path) {
  try {
    (void)read_camera_file(path);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

void check_error(const std::string& lines, const std::string& part) {
  const Yaml yaml(lines);
  const std::string text = error_of(yaml.path());
  INFO(text);
  CHECK(text.find(yaml.path().string()) == 0);
  CHECK(text.find(part) != std::string::npos);
  CHECK(text.find('\n') == std::string::npos);
}

constexpr const char* kPinhole = "Camera.fx: 535.4\nCamera.fy: 539\nCamera.cx: 320.1\nCamera.cy: 247.6\n";

}  // namespace

TEST_CASE("A camera file in ORB-SLAM form is read whole") {
  const Yaml yaml(std::string("Camera.type: \"PinHole\"\n") + kPinhole +
                  "Camera.k1: 0.26\nCamera.k2: -0.95\nCamera.p1: -0.005\nCamera.p2: 0.003\nCamera.k3: 1.16\n"
                  "Camera.width: 640\nCamera.height: 480\nCamera.fps: 30.0\nDepthMapFactor: 5000.0\n");
  const CameraFile file = read_camera_file(yaml.path());
  CHECK(file.camera.pinhole.fx == 535.4);
  CHECK(file.camera.pinhole.fy == 539);
  CHECK(file.camera.pinhole.cx == 320.1);
  CHECK(file.camera.pinhole.cy == 247.6);
  CHECK(file.camera.distortion.k1 == 0.26);
  CHECK(file.camera.distortion.k2 == -0.95);
  CHECK(file.camera.distortion.p1 == -0.005);
  CHECK(file.camera.distortion.p2 == 0.003);
  CHECK(file.camera.distortion.k3 == 1.16);
  CHECK(file.camera.width == 640);
  CHECK(file.camera.height == 480);
  CHECK(file.frame_rate == 30);
  CHECK(file.depth_factor == 5000);
}

TEST_CASE("What a camera file may leave out") {
  const Yaml yaml(kPinhole);
  const CameraFile file = read_camera_file(yaml.path());
  CHECK(file.camera.width == 0);
  CHECK(file.camera.distortion.is_identity());
  CHECK(file.depth_factor == 0);
}

TEST_CASE("The keys of ORB-SLAM3 are read too") {
  const Yaml yaml(
      "Camera1.fx: 500\nCamera1.fy: 501\nCamera1.cx: 320\nCamera1.cy: 240\nRGBD.DepthMapFactor: 1000\n");
  const CameraFile file = read_camera_file(yaml.path());
  CHECK(file.camera.pinhole.fy == 501);
  CHECK(file.depth_factor == 1000);
}

TEST_CASE("A wrong camera file names file and key and says what would be right") {
  check_error("Camera.fx: 535\nCamera.fy: 539\nCamera.cx: 320\n",
              ": Camera.cy is missing; expected the principal point in pixels");
  check_error("Camera.fx: .nan\nCamera.fy: 539\nCamera.cx: 320\nCamera.cy: 247\n",
              ": Camera.fx is not finite; expected the focal length in pixels");
  check_error("Camera.fx: .Inf\nCamera.fy: 539\nCamera.cx: 320\nCamera.cy: 247\n",
              ": Camera.fx is not finite");
  check_error("Camera.fx: wide\nCamera.fy: 539\nCamera.cx: 320\nCamera.cy: 247\n",
              ": line 3: Camera.fx is 'wide', not a number; expected the focal length in pixels");
  check_error("Camera.fx: 240,6\nCamera.fy: 539\nCamera.cx: 320\nCamera.cy: 247\n",
              ": line 3: Camera.fx is '240,6', not a number; expected a decimal point: 240.6");
  check_error("Camera.fx: 481.2\nCamera.fy: -480\nCamera.cx: 320\nCamera.cy: 247\n",
              ": Camera.fy is -480; expected the focal length in pixels, greater than 0");
  check_error(std::string(kPinhole) + "Camera.k2: .nan\n",
              ": Camera.k2 is not finite; expected a distortion coefficient");
  check_error(std::string(kPinhole) + "DepthMapFactor: 0\n",
              ": DepthMapFactor is 0; expected depth image units a metre");
  check_error(std::string(kPinhole) + "Camera.width: 640.5\n",
              ": Camera.width is 640.5; expected a whole number of pixels");
  check_error(std::string(kPinhole) + "Camera.height: -480\n", ": Camera.height is -480; expected");
  check_error(std::string(kPinhole) + "Camera.height: 240.7\n",
              ": line 7: Camera.height is 240.7; expected a whole number of pixels");
  check_error("Camera.fx: 535\nCamera.fx: 539\n", ": line 4: Camera.fx is given a second time, after line 3");
  check_error(std::string("Camera.type: \"KannalaBrandt8\"\n") + kPinhole,
              ": the lens model 'KannalaBrandt8' is fitted within the image; expected its width and height");
}

TEST_CASE("What is no camera file at all") {
  CHECK(error_of("/nowhere/camera.yaml") == "/nowhere/camera.yaml: no such camera file");
  CHECK(error_of("/") == "/: is not a file; expected a camera file");
  check_error("Camera.fx: [1, 2\n  - {broken\n", "expected ',' or ']'");
  check_error("hello: world\n", ": no calibration of a known kind; expected Camera.fx, ");
}
