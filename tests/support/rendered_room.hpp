// SPDX-License-Identifier: BSD-3-Clause
// A walk through a rendered house as a camera would record it, in memory: images, and where they were taken.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/synth/house.hpp"
#include "sslam/synth/render.hpp"
#include "sslam/synth/sensor.hpp"

namespace sslam::testing {

struct RenderedRoom {
  Camera<double> camera;
  double rate = 15;             // images a second
  std::vector<cv::Mat> images;  // BGR
  std::vector<cv::Mat> depth;   // float, metres; 0 where nothing is seen
  io::Trajectory truth;
};

// The first `frames` images of 320 x 240 of the house.
inline RenderedRoom render_room(const synth::HouseOptions& options, int frames) {
  RenderedRoom room;
  room.camera.pinhole = {280, 280, 159.5, 119.5};
  room.camera.width = 320;
  room.camera.height = 240;
  const synth::House house = synth::build_house(options);
  synth::Renderer renderer(house.scene);
  const synth::Sensor sensor({}, options.seed);
  synth::RenderedFrame frame;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < frames; ++i) {
    const double stamp = i / room.rate;
    const SE3<double> world_from_cam = house.path.world_from_cam(stamp);
    renderer.render({room.camera.pinhole, room.camera.width, room.camera.height, world_from_cam.inverse()},
                    frame);
    sensor.expose(frame, i, stamp, rgb);
    cv::Mat bgr(frame.height, frame.width, CV_8UC3);
    for (std::size_t k = 0; k < rgb.size(); k += 3) {
      bgr.data[k] = rgb[k + 2];
      bgr.data[k + 1] = rgb[k + 1];
      bgr.data[k + 2] = rgb[k];
    }
    room.images.push_back(std::move(bgr));
    cv::Mat depth(frame.height, frame.width, CV_32F);
    for (std::size_t k = 0; k < frame.inverse_depth.size(); ++k)
      depth.ptr<float>()[k] = frame.inverse_depth[k] > 0 ? 1 / frame.inverse_depth[k] : 0;
    room.depth.push_back(std::move(depth));
    room.truth.push_back({stamp, world_from_cam});
  }
  return room;
}

}  // namespace sslam::testing
