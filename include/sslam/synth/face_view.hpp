// SPDX-License-Identifier: BSD-3-Clause
// A face as one camera sees it: three linear forms of the pixel give inverse depth and surface coordinates.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

struct View {
  Pinhole<double> pinhole;
  int width, height;
  SE3<double> cam_from_world;
};

// For a pixel p = (u, v, 1) on the plane of the face: inverse . p = 1/z, and (s, t) = (s_form . p, t_form .
// p) z. From n . X = d with X = z K^-1 p: 1/z = (K^-T n / d) . p, and s = e_s . (X - O) likewise.
struct FaceView {
  Vec3<double> inverse, s_form, t_form;
  Vec3<double> normal;   // camera frame
  int face;              // index in the scene
  double width, height;  // metres
  int first_row, last_row;

  // Neighbouring faces overlap by this much (metres), so that rounding leaves no crack between them.
  static constexpr double kOverlap = 1e-4;
};

// Pixels u with low <= u <= high on one row; empty when low > high.
struct RowSpan {
  double low, high;

  // Keeps the part where constant + slope * u >= 0.
  void clip(double constant, double slope) noexcept {
    if (slope > 0.0) {
      low = std::max(low, -constant / slope);
    } else if (slope < 0.0) {
      high = std::min(high, -constant / slope);
    } else if (constant < 0.0) {
      high = -std::numeric_limits<double>::infinity();
    }
  }
};

// The part of row v that the face covers, ignoring what stands before it.
[[nodiscard]] inline RowSpan row_span(const FaceView& view, double v, int image_width) noexcept {
  constexpr double kFarthest = 200.0;
  RowSpan span{0.0, image_width - 1.0};
  const Vec3<double>&w = view.inverse, &s = view.s_form, &t = view.t_form;
  const auto clip = [&](const Vec3<double>& form) { span.clip(form.y() * v + form.z(), form.x()); };
  clip(w - Vec3<double>(0.0, 0.0, 1.0 / kFarthest));
  clip(s + FaceView::kOverlap * w);
  clip(t + FaceView::kOverlap * w);
  clip((view.width + FaceView::kOverlap) * w - s);
  clip((view.height + FaceView::kOverlap) * w - t);
  return span;
}

// False when the face shows its back, or lies outside the image.
[[nodiscard]] inline bool view_face(const Face& face, int index, const View& view, FaceView& out) noexcept {
  const Vec3<double> normal = view.cam_from_world.rotation * face.normal();
  const Vec3<double> origin = view.cam_from_world * face.origin;
  const double offset = normal.dot(origin);
  if (offset > -1e-4) return false;
  const Vec3<double> s_axis = view.cam_from_world.rotation * face.along_s;
  const Vec3<double> t_axis = view.cam_from_world.rotation * face.along_t;
  bool all_before = true;
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  int behind = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3<double> corner =
        origin + (i & 1 ? face.width : 0.0) * s_axis + (i & 2 ? face.height : 0.0) * t_axis;
    if (corner.z() < 0.02) {
      all_before = false;
      ++behind;
      continue;
    }
    const Vec2<double> p = view.pinhole.project(corner);
    left = std::min(left, p.x()), right = std::max(right, p.x());
    top = std::min(top, p.y()), bottom = std::max(bottom, p.y());
  }
  if (behind == 4) return false;
  if (all_before && (right < -1.0 || left > view.width || bottom < -1.0 || top > view.height)) return false;
  const auto form = [&](const Vec3<double>& v) {  // K^-T v
    const double x = v.x() / view.pinhole.fx, y = v.y() / view.pinhole.fy;
    return Vec3<double>(x, y, v.z() - view.pinhole.cx * x - view.pinhole.cy * y);
  };
  out.inverse = form(normal) / offset;
  out.s_form = form(s_axis) - s_axis.dot(origin) * out.inverse;
  out.t_form = form(t_axis) - t_axis.dot(origin) * out.inverse;
  out.normal = normal;
  out.face = index;
  out.width = face.width;
  out.height = face.height;
  out.first_row = all_before ? std::max(0, static_cast<int>(std::floor(top))) : 0;
  out.last_row =
      all_before ? std::min(view.height - 1, static_cast<int>(std::ceil(bottom))) : view.height - 1;
  return true;
}

}  // namespace sslam::synth
