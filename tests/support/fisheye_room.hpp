// SPDX-License-Identifier: BSD-3-Clause
// A walk through a rendered house as a wide lens would record it: five pinhole views a frame, at right angles
// to each other, from which each of its pixels is taken.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/opencv/camera/wide_lens.hpp"
#include "support/rendered_room.hpp"

namespace sslam::testing {

struct FisheyeRoom {
  WideLens lens;
  double rate = 15;             // images a second
  std::vector<cv::Mat> images;  // BGR
  io::Trajectory truth;
};

// The direction that is seen `radius` pixels from the middle, in radians off the axis, of a lens with square
// pixels: by bisection, as far as `widest`.
[[nodiscard]] inline double angle_at(const WideLens& lens, double radius, double widest) {
  double low = 0, high = widest;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    Vec2<double> pixel;
    const bool seen = lens.project({std::sin(middle), 0, std::cos(middle)}, pixel);
    (seen && pixel.x() - lens.pinhole.cx < radius ? low : high) = middle;
  }
  return low;
}

// `lens` shows a circle of `widest` radians off its axis; beyond, the image is black.
inline FisheyeRoom render_fisheye_room(const WideLens& lens, double widest,
                                       const synth::HouseOptions& options, int frames) {
  constexpr int kFace = 400;      // pixels
  constexpr double kFocal = 190;  // a little more than 90 degrees: faces overlap
  const double middle = 0.5 * (kFace - 1), half = std::numbers::pi / 2;
  const std::array<SO3<double>, 5> turns{
      SO3<double>(), SO3<double>::exp(Vec3<double>(0, half, 0)), SO3<double>::exp(Vec3<double>(0, -half, 0)),
      SO3<double>::exp(Vec3<double>(half, 0, 0)), SO3<double>::exp(Vec3<double>(-half, 0, 0))};
  const Pinhole<double> pinhole{kFocal, kFocal, middle, middle};
  // Where each pixel of the lens is in which face.
  std::vector<cv::Mat> maps(turns.size()), chosen(turns.size());
  for (std::size_t f = 0; f < turns.size(); ++f) {
    maps[f] = cv::Mat(lens.height, lens.width, CV_32FC2, cv::Scalar(-1, -1));
    chosen[f] = cv::Mat(lens.height, lens.width, CV_8UC1, cv::Scalar(0));
  }
  for (int v = 0; v < lens.height; ++v)
    for (int u = 0; u < lens.width; ++u) {
      const Vec2<double> out(u - lens.pinhole.cx, v - lens.pinhole.cy);
      const double angle = angle_at(lens, out.norm(), widest * 1.05);
      if (angle > widest) continue;
      const Vec2<double> side = out.norm() > 0 ? Vec2<double>(out.normalized()) : Vec2<double>(1, 0);
      const Vec3<double> ray(std::sin(angle) * side.x(), std::sin(angle) * side.y(), std::cos(angle));
      std::size_t best = 0;
      for (std::size_t f = 1; f < turns.size(); ++f)
        if ((turns[f].inverse() * ray).z() > (turns[best].inverse() * ray).z()) best = f;
      const Vec2<double> at = pinhole.project(turns[best].inverse() * ray);
      maps[best].at<cv::Vec2f>(v, u) = {static_cast<float>(at.x()), static_cast<float>(at.y())};
      chosen[best].at<std::uint8_t>(v, u) = 255;
    }
  FisheyeRoom room;
  room.lens = lens;
  HouseFilm film(options);
  for (int i = 0; i < frames; ++i) {
    const double stamp = i / room.rate;
    const SE3<double> world_from_cam = film.world_from_cam(stamp);
    cv::Mat image(lens.height, lens.width, CV_8UC3, cv::Scalar(0, 0, 0));
    for (std::size_t f = 0; f < turns.size(); ++f) {
      const SE3<double> world_from_face{world_from_cam.rotation * turns[f], world_from_cam.translation};
      cv::Mat taken;
      cv::remap(film.take({pinhole, kFace, kFace, world_from_face.inverse()}, i, stamp), taken, maps[f],
                cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      taken.copyTo(image, chosen[f]);
    }
    room.images.push_back(std::move(image));
    room.truth.push_back({stamp, world_from_cam});
  }
  return room;
}

// Of TUM-VI's size: 180 degrees fill a circle in 512x512 pixels.
[[nodiscard]] inline WideLens half_sphere_lens() {
  WideLens lens;
  lens.width = lens.height = 512;
  lens.pinhole = {160, 160, 255.5, 255.5};
  lens.k = {0.004, -0.001, 0, 0, 0};
  return lens;
}

}  // namespace sslam::testing
