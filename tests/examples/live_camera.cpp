// SPDX-License-Identifier: BSD-3-Clause
// A camera in a thread of its own: it tracks each image when it comes, mapping goes on beside it, and the
// main thread asks for the newest pose whenever it wants one. Here the camera plays images at the pace of a
// camera: live_camera CAMERA.yaml IMAGE...
#include <atomic>
#include <chrono>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/system/system.hpp"

namespace {

using namespace std::chrono_literals;

// Counts what a robot would want to hear of.
class Events : public sslam::Observer {
 public:
  void keyframe_made(const sslam::FrameEvent&) override { ++keyframes; }
  void loop_closed(const sslam::FrameEvent&) override { ++loops; }

  std::atomic<int> keyframes = 0, loops = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  sslam::Settings settings;
  settings.camera = sslam::read_camera_file(argv[1]).camera;
  settings.live = true;
  sslam::System system(settings);
  Events events;
  system.add_observer(events);

  std::atomic<bool> done = false;
  std::jthread camera([&] {
    constexpr auto kPeriod = 33ms;
    auto due = std::chrono::steady_clock::now();
    for (int i = 2; i < argc; ++i, due += kPeriod) {
      std::this_thread::sleep_until(due);
      system.track(cv::imread(argv[i]), std::chrono::duration<double>(kPeriod * i).count());
    }
    system.finish();
    done = true;
  });
  while (!done) {
    std::this_thread::sleep_for(100ms);
    const sslam::LatestPose latest = system.latest();
    std::cout << latest.stamp << " s: " << name(latest.state);
    if (latest.world_from_cam) std::cout << " at " << latest.world_from_cam->translation.transpose();
    std::cout << '\n';
  }
  std::cout << events.keyframes << " keyframes, " << events.loops << " loops closed\n";
  return system.trajectory().empty() ? 1 : 0;
}
