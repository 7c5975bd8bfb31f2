// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a calibration is plausible for images of its size, before the first image. A calibration of
// another camera, resolution or unit tracks badly, and nothing else would report it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/geometry/camera.hpp"

namespace sslam {

struct CameraCheck {
  std::string fault;                // not empty: the calibration cannot be right
  std::vector<std::string> doubts;  // unusual values, which are seldom right
};

// The angle in degrees that `pixels` span in the view of a pinhole.
[[nodiscard]] inline double field_of_view(double focal, double pixels) noexcept {
  return degrees(2 * std::atan(pixels / (2 * focal)));
}

// The share of pixels, of a grid over the whole image, outside the lens's valid field: there the distortion
// folds the image back.
[[nodiscard]] inline double folded_share(const Camera<double>& camera) noexcept {
  constexpr int kSteps = 20;
  int folded = 0;
  for (int r = 0; r <= kSteps; ++r)
    for (int c = 0; c <= kSteps; ++c) {
      const Vec2<double> pixel(c * (camera.width - 1.0) / kSteps, r * (camera.height - 1.0) / kSteps);
      Vec2<double> ray;
      folded += camera.distortion.undistort(camera.pinhole.unproject(pixel).head<2>(), ray) ? 0 : 1;
    }
  return folded / static_cast<double>((kSteps + 1) * (kSteps + 1));
}

// The largest factor by which the distortion moves a corner of the image away from the middle.
[[nodiscard]] inline double largest_stretch(const Camera<double>& camera) noexcept {
  double most = 1;
  for (const double x : {0.0, camera.width - 1.0})
    for (const double y : {0.0, camera.height - 1.0}) {
      const Vec2<double> seen = camera.pinhole.unproject({x, y}).head<2>();
      Vec2<double> ray;
      if (camera.distortion.undistort(seen, ray) && ray.norm() > 0)
        most = std::max(most, seen.norm() / ray.norm());
    }
  return most;
}

// Checks a camera that has its image size.
[[nodiscard]] inline CameraCheck check_camera(const Camera<double>& camera) {
  const Pinhole<double>& p = camera.pinhole;
  char text[320];
  const auto told = [&text](const char* form, auto... values) {
    std::snprintf(text, sizeof text, form, values...);
    return std::string(text);
  };
  CameraCheck check;
  const double across = field_of_view(p.fx, camera.width), down = field_of_view(p.fy, camera.height);
  constexpr double kNarrowest = 3, kWidest = 150;  // degrees; a usable image of a pinhole never shows more
  if (!(across > kNarrowest && across < kWidest && down > kNarrowest && down < kWidest)) {
    check.fault = told(
        "fx %g and fy %g give %dx%d images a field of view of %.3g by %.3g degrees; expected focal lengths "
        "in "
        "pixels of these images",
        p.fx, p.fy, camera.width, camera.height, across, down);
    constexpr double kPixels = 0.05;  // share of the width; a focal length in pixels is never smaller
    if (p.fx < kPixels * camera.width)
      check.fault += p.fx < 2 ? ": are these parts of the image's size?" : ": are these millimetres?";
    return check;
  }
  // Shares of the image's width and height, from its middle.
  const auto off_middle = [](double place, int pixels) { return std::abs((place + 0.5) / pixels - 0.5); };
  const double off = std::max(off_middle(p.cx, camera.width), off_middle(p.cy, camera.height));
  constexpr double kFarOff = 0.25, kOff = 0.12;
  if (!(off < kFarOff)) {
    check.fault = told(
        "the principal point (%g, %g) is far from the middle of %dx%d images; expected about (%g, %g): is "
        "the "
        "calibration for another resolution?",
        p.cx, p.cy, camera.width, camera.height, 0.5 * (camera.width - 1), 0.5 * (camera.height - 1));
    return check;
  }
  const double oblong = std::max(p.fx / p.fy, p.fy / p.fx);
  constexpr double kVeryOblong = 2, kOblong = 1.2;
  if (oblong > kVeryOblong) {
    check.fault =
        told("fx %g and fy %g differ by a factor of %.2g; expected nearly the same", p.fx, p.fy, oblong);
    return check;
  }
  const double folded = folded_share(camera);
  constexpr double kMuch = 0.1;
  if (folded > kMuch) {
    check.fault = told(
        "the distortion turns back within %.0f %% of the image; expected coefficients in the order k1 k2 p1 "
        "p2 k3, of "
        "this lens",
        100 * folded);
    return check;
  }
  if (folded > 0)
    check.doubts.push_back(
        told("the distortion turns back in %.1f %% of the image: these corners are of no use", 100 * folded));
  if (off > kOff) {
    check.doubts.push_back(told("the principal point (%g, %g) is off the middle of %dx%d images", p.cx, p.cy,
                                camera.width, camera.height));
    constexpr double kNear = 0.05;
    if (off_middle(p.cy, camera.width) < kNear && off_middle(p.cx, camera.height) < kNear)
      check.doubts.back() += ": are cx and cy exchanged?";
  }
  if (oblong > kOblong)
    check.doubts.push_back(told("fx %g and fy %g differ by a factor of %.2g", p.fx, p.fy, oblong));
  constexpr double kStretched = 1.3;  // pincushion distortion of real lenses is weaker
  if (const double stretch = largest_stretch(camera); stretch > kStretched)
    check.doubts.push_back(told(
        "the distortion moves corners of the image outwards by a factor of %.2g: are its coefficients those "
        "of this lens, in the order k1 k2 p1 p2 k3?",
        stretch));
  constexpr double kTangential = 0.03;
  if (std::max(std::abs(camera.distortion.p1), std::abs(camera.distortion.p2)) > kTangential)
    check.doubts.push_back(told("the tangential distortion p1 %g, p2 %g is large: is k3 in its place?",
                                camera.distortion.p1, camera.distortion.p2));
  return check;
}

}  // namespace sslam
