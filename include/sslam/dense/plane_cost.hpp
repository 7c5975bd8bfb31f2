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

// A patch of the view, without its mean. The arrays are longer than the patch, by zeros, so that whole
// vectors of floats are computed.
struct Patch {
  static constexpr int kReach = 2, kSide = 2 * kReach + 1, kSize = kSide * kSide, kRoom = (kSize + 7) / 8 * 8;
  std::array<float, kRoom> value{};
  float power = 0;  // sum of squares
};

namespace detail {

// Whether there are four pixels around a place.
[[nodiscard]] inline bool holds(const ImageView<std::uint8_t>& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.width() - 1) &&
         y < static_cast<float>(image.height() - 1);
}

// The places of a patch: its centre, and how the image moves with each of its two coordinates.
struct PatchPlaces {
  Vec2<float> centre, along_x, along_y;

  [[nodiscard]] Vec2<float> corner(int dx, int dy) const {
    return centre + static_cast<float>(dx * Patch::kReach) * along_x +
           static_cast<float>(dy * Patch::kReach) * along_y;
  }
  // Whether the image holds all of them: they lie between the corners.
  [[nodiscard]] bool in(const ImageView<std::uint8_t>& image) const {
    for (const int dy : {-1, 1})
      for (const int dx : {-1, 1})
        if (const Vec2<float> place = corner(dx, dy); !holds(image, place.x(), place.y())) return false;
    return true;
  }
};

// Offsets of a patch's pixels, row by row; 0 in the room behind them.
inline constexpr auto kPatchX = [] {
  std::array<float, Patch::kRoom> x{};
  for (int i = 0; i < Patch::kSize; ++i)
    x[static_cast<std::size_t>(i)] = static_cast<float>(i % Patch::kSide - Patch::kReach);
  return x;
}();
inline constexpr auto kPatchY = [] {
  std::array<float, Patch::kRoom> y{};
  for (int i = 0; i < Patch::kSize; ++i)
    y[static_cast<std::size_t>(i)] = static_cast<float>(i / Patch::kSide - Patch::kReach);
  return y;
}();

// Grey values between pixels, of places that the image holds; 0 in the room behind them.
inline void sample(const ImageView<std::uint8_t>& image, const PatchPlaces& places,
                   std::array<float, Patch::kRoom>& value) {
  std::array<float, Patch::kRoom> fx, fy;
  std::array<std::int32_t, Patch::kRoom> column, row, upper, lower;
  for (std::size_t i = 0; i < Patch::kRoom; ++i) {
    const float x = places.centre.x() + places.along_x.x() * kPatchX[i] + places.along_y.x() * kPatchY[i],
                y = places.centre.y() + places.along_x.y() * kPatchX[i] + places.along_y.y() * kPatchY[i];
    column[i] = static_cast<std::int32_t>(x);
    row[i] = static_cast<std::int32_t>(y);
    fx[i] = x - static_cast<float>(column[i]);
    fy[i] = y - static_cast<float>(row[i]);
  }
  for (std::size_t i = 0; i < Patch::kRoom; ++i) {  // two neighbours in one number
    const std::uint8_t *const a = image.row(row[i]) + column[i], *const b = a + image.stride();
    upper[i] = a[0] | a[1] << 8;
    lower[i] = b[0] | b[1] << 8;
  }
  for (std::size_t i = 0; i < Patch::kRoom; ++i) {
    const auto a0 = static_cast<float>(upper[i] & 255), a1 = static_cast<float>(upper[i] >> 8),
               b0 = static_cast<float>(lower[i] & 255), b1 = static_cast<float>(lower[i] >> 8);
    const float top = a0 + fx[i] * (a1 - a0), bottom = b0 + fx[i] * (b1 - b0);
    value[i] = top + fy[i] * (bottom - top);
  }
  for (std::size_t i = Patch::kSize; i < Patch::kRoom; ++i) value[i] = 0;
}

// In four parts at once, whose order does not depend on the compiler.
template <class Term>
[[nodiscard]] float sum_of_terms(const Term& term) {
  constexpr std::size_t kLanes = 4;
  std::array<float, kLanes> sums{};
  for (std::size_t i = 0; i < Patch::kRoom; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += term(i + k);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

inline void centre_patch(Patch& patch) {
  const float mean = sum_of_terms([&](std::size_t i) { return patch.value[i]; }) / Patch::kSize;
  for (std::size_t i = 0; i < Patch::kSize; ++i) patch.value[i] -= mean;
  patch.power = sum_of_terms([&](std::size_t i) { return patch.value[i] * patch.value[i]; });
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
[[nodiscard]] inline bool patch_cost(const Patch& patch, const DenseView& other, const Mat3<double>& h,
                                     const Vec2<double>& centre, double noise, float& cost) {
  const Vec3<double> x = h * Vec3<double>(centre.x(), centre.y(), 1);
  if (!(x.z() > 1e-9)) return false;
  const double w = 1 / x.z(), u = x.x() * w, v = x.y() * w;
  const auto ux = static_cast<float>((h(0, 0) - u * h(2, 0)) * w),
             uy = static_cast<float>((h(0, 1) - u * h(2, 1)) * w),
             vx = static_cast<float>((h(1, 0) - v * h(2, 0)) * w),
             vy = static_cast<float>((h(1, 1) - v * h(2, 1)) * w);
  const float scale = std::abs(ux * vy - uy * vx);
  if (!(scale > 0.15F && scale < 8)) return false;  // too far from the patch's own resolution
  const detail::PatchPlaces places{{static_cast<float>(u), static_cast<float>(v)}, {ux, vx}, {uy, vy}};
  if (!places.in(other.grey) || !other.sees(places.centre)) return false;
  std::array<float, Patch::kRoom> seen;
  detail::sample(other.grey, places, seen);
  // Of the values less their mean, by sums of the values: the patch's own have no mean.
  const float sum = detail::sum_of_terms([&](std::size_t i) { return seen[i]; });
  const float square = detail::sum_of_terms([&](std::size_t i) { return seen[i] * seen[i]; });
  const float common = detail::sum_of_terms([&](std::size_t i) { return seen[i] * patch.value[i]; });
  const float power = std::max(0.0F, square - sum * sum / Patch::kSize);
  const float difference = std::max(0.0F, power + patch.power - 2 * common);
  const auto floor = static_cast<float>(2 * Patch::kSize * noise * noise);
  cost = std::min(1.0F, difference / (patch.power + power + floor));
  return true;
}

}  // namespace sslam::dense
