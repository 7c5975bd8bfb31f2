// SPDX-License-Identifier: BSD-3-Clause
#include <sslam/system/system.hpp>

int main() {
  sslam::Settings settings;
  settings.camera.pinhole = {500, 500, 319.5, 239.5};
  settings.camera.width = 640;
  settings.camera.height = 480;
  sslam::System system(settings);
  const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(128));
  const sslam::FrameReport report = system.track(grey, 0.0);
  return report.input == sslam::InputStatus::kOk && !report.has_pose() ? 0 : 1;
}
