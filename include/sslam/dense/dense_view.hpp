// SPDX-License-Identifier: BSD-3-Clause
// What a keyframe knows about surfaces: its image, its normals, and where landmarks are seen at which depth.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/plane3.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam::dense {

// Surface normals on a grid of pixels of its own.
struct NormalImage {
  int columns = 0, rows = 0;
  Pinhole<double> pinhole;           // of the grid, lens distortion taken out
  std::vector<Vec3<float>> normals;  // row by row: unit, camera frame, towards the camera; zero: none
};

// A landmark, seen in a view.
struct DepthMark {
  Vec2<double> pixel;
  double depth = 0;  // z in the camera frame, units of the map
  double sigma = 0;  // of the depth
};

struct DenseView {
  SE3<double> cam_from_world;
  Pinhole<double> pinhole;        // of `grey`
  ImageView<std::uint8_t> grey;   // lens distortion taken out; its owner keeps it alive
  ImageView<std::uint8_t> seen;   // of its size: 0 where the image is no world; empty: it is everywhere
  NormalImage normals;            // empty: none
  std::vector<DepthMark> marks;   // pixels of `grey`
  std::vector<std::size_t> near;  // other views that see the same things from elsewhere

  [[nodiscard]] bool sees(int x, int y) const noexcept { return seen.width() == 0 || seen.at(x, y) != 0; }
  // At the pixel nearest to a place in the image.
  [[nodiscard]] bool sees(const Vec2<float>& place) const noexcept {
    return sees(static_cast<int>(place.x() + 0.5F), static_cast<int>(place.y() + 0.5F));
  }
  [[nodiscard]] Vec3<double> centre() const noexcept { return cam_from_world.inverse().translation; }
};

// A plane, and the rectangle of it that is known best.
struct BoundedPlane {
  Plane3<double> plane;
  Mat<double, 3, 2> basis = Mat<double, 3, 2>::Zero();  // world: of two coordinates in the plane
  Vec2<double> low = Vec2<double>::Zero(), high = Vec2<double>::Zero();

  [[nodiscard]] Vec3<double> place(const Vec2<double>& u) const {
    return plane.distance * plane.normal + basis * u;
  }
  // Of a place in the plane from the rectangle; 0 within.
  [[nodiscard]] double beyond(const Vec2<double>& u) const {
    return (low - u).cwiseMax(u - high).cwiseMax(0).norm();
  }
};

// normal . ray of a pixel, whose ray has z = 1, is linear in the pixel: row . (u, v, 1).
[[nodiscard]] inline Vec3<double> ray_form(const Pinhole<double>& k, const Vec3<double>& n) {
  const double x = n.x() / k.fx, y = n.y() / k.fy;
  return {x, y, n.z() - x * k.cx - y * k.cy};
}

// 1 / z of a plane is linear in the pixel: row . (u, v, 1), in the frame of the plane's transform. Zero where
// the plane runs through the camera.
[[nodiscard]] inline Vec3<double> inverse_depth_form(const Pinhole<double>& k, const Plane3<double>& in_cam) {
  if (!(std::abs(in_cam.distance) > 1e-12)) return Vec3<double>::Zero();
  return ray_form(k, in_cam.normal / in_cam.distance);
}

}  // namespace sslam::dense
