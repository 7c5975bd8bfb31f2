// SPDX-License-Identifier: BSD-3-Clause
// Images in, poses and a map out: images_to_poses CAMERA.yaml IMAGE...
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/system/system.hpp"

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  sslam::Settings settings;
  settings.camera = sslam::read_camera_file(argv[1]).camera;
  sslam::System system(settings);
  for (int i = 2; i < argc; ++i) {
    const sslam::FrameReport frame = system.track(cv::imread(argv[i]), i / 30.0);  // 30 images a second
    std::cerr << argv[i] << ": " << name(frame.state) << ' ' << name(frame.reason) << '\n';
  }
  system.finish();
  for (const auto& [stamp, world_from_cam] : system.trajectory())
    std::cout << stamp << ' ' << world_from_cam.translation.transpose() << '\n';
  system.save("map.sslam");
  return system.trajectory().empty() ? 1 : 0;
}
