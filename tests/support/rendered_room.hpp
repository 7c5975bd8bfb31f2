// SPDX-License-Identifier: BSD-3-Clause
// A walk through a rendered house as a camera would record it, in memory: images, and where they were taken.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
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

// Takes images in a house that is rendered.
class HouseFilm {
 public:
  explicit HouseFilm(const synth::HouseOptions& options)
      : house_(synth::build_house(options)), renderer_(house_.scene), sensor_({}, options.seed) {}

  [[nodiscard]] SE3<double> world_from_cam(double stamp) const { return house_.path.world_from_cam(stamp); }

  // BGR, of frame `i`.
  [[nodiscard]] cv::Mat take(const synth::View& view, int i, double stamp) {
    renderer_.render(view, frame_);
    sensor_.expose(frame_, i, stamp, rgb_);
    cv::Mat bgr;
    cv::cvtColor(cv::Mat(frame_.height, frame_.width, CV_8UC3, rgb_.data()), bgr, cv::COLOR_RGB2BGR);
    return bgr;
  }
  // What the last image was rendered from.
  [[nodiscard]] const synth::RenderedFrame& frame() const { return frame_; }

 private:
  synth::House house_;
  synth::Renderer renderer_;
  synth::Sensor sensor_;
  synth::RenderedFrame frame_;
  std::vector<std::uint8_t> rgb_;
};

// The first `frames` images of 320 x 240 of the house.
inline RenderedRoom render_room(const synth::HouseOptions& options, int frames) {
  RenderedRoom room;
  room.camera.pinhole = {280, 280, 159.5, 119.5};
  room.camera.width = 320;
  room.camera.height = 240;
  HouseFilm film(options);
  for (int i = 0; i < frames; ++i) {
    const double stamp = i / room.rate;
    const SE3<double> world_from_cam = film.world_from_cam(stamp);
    room.images.push_back(film.take(
        {room.camera.pinhole, room.camera.width, room.camera.height, world_from_cam.inverse()}, i, stamp));
    const synth::RenderedFrame& frame = film.frame();
    cv::Mat depth(frame.height, frame.width, CV_32F);
    for (std::size_t k = 0; k < frame.inverse_depth.size(); ++k)
      depth.ptr<float>()[k] = frame.inverse_depth[k] > 0 ? 1 / frame.inverse_depth[k] : 0;
    room.depth.push_back(std::move(depth));
    room.truth.push_back({stamp, world_from_cam});
  }
  return room;
}

}  // namespace sslam::testing
