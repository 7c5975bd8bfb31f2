// SPDX-License-Identifier: BSD-3-Clause
// What speaks against each plane in each block of a view: other views along the plane's homography, landmarks
// at another depth, normals in another direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sslam/dense/dense_view.hpp"

namespace sslam::dense {

// Costs are from 0 to 1 before they are weighted.
struct CostOptions {
  int block = 8;               // pixels of the view's image
  double noise = 4;            // of a grey value between two views, with what resampling adds
  double depth_slack = 0.015;  // of a landmark's depth from the plane's, as a part of it, beside its sigma
  double normal_angle = radians(25.0);  // from which on a normal speaks against a plane with its whole weight
  double beyond = 0.1;  // from the rectangle of a plane's samples, over the median depth, where it costs most
  double reach = 0.8;   // likewise, how far the plane is looked at
  double photo_weight = 1, mark_weight = 2, normal_weight = 0.7, beyond_weight = 0.4;
  double none = 0.5;      // photometric cost from which on no plane is better than this one
  double grazing = 0.06;  // least cosine between ray and normal
  std::size_t views = 4;  // to compare with
};

inline constexpr float kNoCost = std::numeric_limits<float>::infinity();  // the plane is not seen there

// Blocks row by row, and in each of them every plane, and behind them `none`.
struct CostGrid {
  int columns = 0, rows = 0, planes = 0;
  std::vector<float> cost;           // kNoCost: the plane is not seen there
  std::vector<float> inverse_depth;  // of each plane, at the block's centre

  [[nodiscard]] std::size_t labels() const noexcept { return static_cast<std::size_t>(planes) + 1; }
  [[nodiscard]] std::size_t at(int column, int row) const noexcept {
    return static_cast<std::size_t>(row * columns + column) * labels();
  }
};

// A patch of the view, without its mean.
struct Patch {
  static constexpr int kReach = 2, kSize = (2 * kReach + 1) * (2 * kReach + 1);
  std::array<float, kSize> value;
  float power = 0;  // sum of squares
};

namespace detail {

inline void centre_patch(Patch& patch) {
  float mean = 0;
  for (const float v : patch.value) mean += v / Patch::kSize;
  patch.power = 0;
  for (float& v : patch.value) {
    v -= mean;
    patch.power += v * v;
  }
}

// Whether there are four pixels around a place.
[[nodiscard]] inline bool holds(const ImageView<std::uint8_t>& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.width() - 1) &&
         y < static_cast<float>(image.height() - 1);
}

// Grey value between pixels, of a place that the image holds.
[[nodiscard]] inline float sample(const ImageView<std::uint8_t>& image, float x, float y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const std::uint8_t *a = image.row(y0) + x0, *b = image.row(y0 + 1) + x0;
  const float top = static_cast<float>(a[0]) + fx * static_cast<float>(a[1] - a[0]);
  const float bottom = static_cast<float>(b[0]) + fx * static_cast<float>(b[1] - b[0]);
  return top + fy * (bottom - top);
}

}  // namespace detail

// How one view's pixels are found in another along a plane, x1 ~ H x0 with H = K1 (R + t n^T / d) K0^-1
// (Hartley and Zisserman, result 13.1); the plane n . X = d stands in the frame of view 0.
[[nodiscard]] inline Mat3<double> plane_homography(const DenseView& from, const DenseView& to,
                                                   const Plane3<double>& in_from) {
  const SE3<double> to_from = to.cam_from_world * from.cam_from_world.inverse();
  const auto matrix = [](const Pinhole<double>& k) {
    Mat3<double> m;
    m << k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1;
    return m;
  };
  // n / d K0^-1 is the form of the inverse depth.
  const Vec3<double> form = inverse_depth_form(from.pinhole, in_from);
  Mat3<double> back;
  back << 1 / from.pinhole.fx, 0, -from.pinhole.cx / from.pinhole.fx, 0, 1 / from.pinhole.fy,
      -from.pinhole.cy / from.pinhole.fy, 0, 0, 1;
  return matrix(to.pinhole) * (to_from.rotation.matrix() * back + to_from.translation * form.transpose());
}

// Squared difference of the two patches over what they hold, noise and all: 0 where they agree, 1 where they
// have nothing in common, little where neither has any texture. False where the other view does not see the
// patch. The homography is taken as affine within it.
[[nodiscard]] inline bool patch_cost(const Patch& patch, const ImageView<std::uint8_t>& other,
                                     const Mat3<double>& h, const Vec2<double>& centre, double noise,
                                     float& cost) {
  const Vec3<double> x = h * Vec3<double>(centre.x(), centre.y(), 1);
  if (!(x.z() > 1e-9)) return false;
  const double w = 1 / x.z(), u = x.x() * w, v = x.y() * w;
  const auto ux = static_cast<float>((h(0, 0) - u * h(2, 0)) * w),
             uy = static_cast<float>((h(0, 1) - u * h(2, 1)) * w),
             vx = static_cast<float>((h(1, 0) - v * h(2, 0)) * w),
             vy = static_cast<float>((h(1, 1) - v * h(2, 1)) * w);
  const float scale = std::abs(ux * vy - uy * vx);
  if (!(scale > 0.15F && scale < 8)) return false;  // too far from the patch's own resolution
  const auto at = [&](int dx, int dy) {
    const auto fx = static_cast<float>(dx), fy = static_cast<float>(dy);
    return Vec2<float>(static_cast<float>(u) + ux * fx + uy * fy, static_cast<float>(v) + vx * fx + vy * fy);
  };
  for (const int dy : {-Patch::kReach, Patch::kReach})  // the rest lies between the corners
    for (const int dx : {-Patch::kReach, Patch::kReach})
      if (const Vec2<float> corner = at(dx, dy); !detail::holds(other, corner.x(), corner.y())) return false;
  Patch seen;
  std::size_t i = 0;
  for (int dy = -Patch::kReach; dy <= Patch::kReach; ++dy)
    for (int dx = -Patch::kReach; dx <= Patch::kReach; ++dx, ++i) {
      const Vec2<float> place = at(dx, dy);
      seen.value[i] = detail::sample(other, place.x(), place.y());
    }
  detail::centre_patch(seen);
  float difference = 0;
  for (std::size_t k = 0; k < seen.value.size(); ++k) {
    const float d = seen.value[k] - patch.value[k];
    difference += d * d;
  }
  const auto floor = static_cast<float>(2 * Patch::kSize * noise * noise);
  cost = std::min(1.0F, difference / (patch.power + seen.power + floor));
  return true;
}

}  // namespace sslam::dense
