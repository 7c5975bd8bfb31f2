// SPDX-License-Identifier: BSD-3-Clause
// Two patches of one surface laid over each other to a fraction of a pixel: the shift that leaves the least
// squared difference, up to gain and offset of the brightness, by the inverse compositional method (Baker,
// Matthews, IJCV 2004).
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "sslam/image/feature_patch.hpp"

namespace sslam {

struct PatchAlignmentOptions {
  float max_shift = 2;           // pixels of the patch
  float min_correlation = 0.9F;  // of the patches, once they lie over each other
};

class PatchAlignment {
 public:
  PatchAlignmentOptions options;

  // By how much the feature of `current` must move, in pixels of its patch, to be where that of `reference`
  // is. current_from_reference: how pixels of the one go over into those of the other around the features.
  // Nothing where the patches do not show the same or too little, or the shift is too large.
  [[nodiscard]] std::optional<Vec2<float>> align(const FeaturePatch& reference, const FeaturePatch& current,
                                                 const Mat2<float>& current_from_reference) noexcept {
    const Mat2<float> back = current_from_reference.inverse();
    if (!warp(reference, back)) return std::nullopt;
    if (!prepare()) return std::nullopt;
    Vec2<float> shift = Vec2<float>::Zero();
    for (int step = 0; step < kSteps; ++step) {
      if (!sample(current, shift)) return std::nullopt;
      Vec2<float> slope = Vec2<float>::Zero();
      for (std::size_t i = 0; i < kArea; ++i)
        slope += (seen_[i] - template_[i]) * Vec2<float>(gradient_x_[i], gradient_y_[i]);
      const Vec2<float> update = -(inverse_hessian_ * slope);
      shift += update;
      if (!(shift.cwiseAbs().maxCoeff() <= options.max_shift)) return std::nullopt;
      if (update.squaredNorm() < kSettled * kSettled) break;
    }
    if (!sample(current, shift)) return std::nullopt;
    float correlation = 0;
    for (std::size_t i = 0; i < kArea; ++i) correlation += seen_[i] * template_[i];
    if (!(correlation >= options.min_correlation)) return std::nullopt;
    return shift;
  }

 private:
  static constexpr int kHalf = 4;  // of the window that is compared, pixels of the current patch
  static constexpr int kWidth = 2 * kHalf + 1;
  static constexpr std::size_t kArea = kWidth * kWidth;
  static constexpr int kWide = kWidth + 2;  // with the rim that its gradients need
  static constexpr int kSteps = 8;
  static constexpr float kSettled = 0.01F;  // pixels

  [[nodiscard]] static bool inside(const Vec2<float>& at) noexcept {
    constexpr auto kLast = static_cast<float>(FeaturePatch::kSide - 1);
    return at.x() >= 0 && at.y() >= 0 && at.x() < kLast && at.y() < kLast;
  }

  [[nodiscard]] static float bilinear(const FeaturePatch& patch, const Vec2<float>& at) noexcept {
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    const float u = at.x() - static_cast<float>(x), v = at.y() - static_cast<float>(y);
    const std::uint8_t* p = patch.view().row(y) + x;
    const std::uint8_t* q = p + FeaturePatch::kSide;
    return (1 - v) * ((1 - u) * p[0] + u * p[1]) + v * ((1 - u) * q[0] + u * q[1]);
  }

  // The reference as the current patch would show it, with a rim of a pixel.
  [[nodiscard]] bool warp(const FeaturePatch& reference, const Mat2<float>& back) noexcept {
    constexpr float kReach = kHalf + 1;
    for (const float x : {-kReach, kReach})
      for (const float y : {-kReach, kReach})
        if (!inside(reference.centre + back * Vec2<float>(x, y))) return false;
    for (int y = 0; y < kWide; ++y)
      for (int x = 0; x < kWide; ++x)
        wide_[static_cast<std::size_t>(y * kWide + x)] =
            bilinear(reference, reference.centre + back * Vec2<float>(static_cast<float>(x) - kReach,
                                                                      static_cast<float>(y) - kReach));
    return true;
  }

  // Template, gradients and Hessian of what was warped; false where its brightness hardly varies in a
  // direction.
  [[nodiscard]] bool prepare() noexcept {
    for (int y = 0; y < kWidth; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float* at = wide_.data() + (y + 1) * kWide + x + 1;
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        template_[i] = at[0];
        gradient_x_[i] = (at[1] - at[-1]) / 2;
        gradient_y_[i] = (at[kWide] - at[-kWide]) / 2;
      }
    const float norm = normalise(template_);
    if (!(norm > kFlat)) return false;
    Mat2<float> hessian = Mat2<float>::Zero();
    float mean_x = 0, mean_y = 0;
    for (std::size_t i = 0; i < kArea; ++i) mean_x += gradient_x_[i], mean_y += gradient_y_[i];
    mean_x /= kArea, mean_y /= kArea;
    float along_x = 0, along_y = 0;  // a change of gain looks like the template itself
    for (std::size_t i = 0; i < kArea; ++i) {
      gradient_x_[i] = (gradient_x_[i] - mean_x) / norm;
      gradient_y_[i] = (gradient_y_[i] - mean_y) / norm;
      along_x += gradient_x_[i] * template_[i];
      along_y += gradient_y_[i] * template_[i];
    }
    for (std::size_t i = 0; i < kArea; ++i) {
      gradient_x_[i] -= along_x * template_[i];
      gradient_y_[i] -= along_y * template_[i];
      hessian(0, 0) += gradient_x_[i] * gradient_x_[i];
      hessian(0, 1) += gradient_x_[i] * gradient_y_[i];
      hessian(1, 1) += gradient_y_[i] * gradient_y_[i];
    }
    hessian(1, 0) = hessian(0, 1);
    if (!(hessian.determinant() > kEdge * hessian.trace() * hessian.trace())) return false;
    inverse_hessian_ = hessian.inverse();
    return true;
  }

  // The current patch around its feature, moved by `shift`.
  [[nodiscard]] bool sample(const FeaturePatch& current, const Vec2<float>& shift) noexcept {
    const Vec2<float> first = current.centre + shift - Vec2<float>::Constant(kHalf);
    if (!inside(first) || !inside(first + Vec2<float>::Constant(2 * kHalf))) return false;
    // All pixels have the same weights.
    const int left = static_cast<int>(first.x()), top = static_cast<int>(first.y());
    const float u = first.x() - static_cast<float>(left), v = first.y() - static_cast<float>(top);
    const float a = (1 - u) * (1 - v), b = u * (1 - v), c = (1 - u) * v, d = u * v;
    for (int y = 0; y < kWidth; ++y) {
      const std::uint8_t* p = current.view().row(top + y) + left;
      const std::uint8_t* q = p + FeaturePatch::kSide;
      float* out = seen_.data() + y * kWidth;
      for (int x = 0; x < kWidth; ++x) out[x] = a * p[x] + b * p[x + 1] + c * q[x] + d * q[x + 1];
    }
    return normalise(seen_) > kFlat;
  }

  // To mean 0 and norm 1; returns the norm it had.
  static float normalise(std::array<float, kArea>& values) noexcept {
    float mean = 0, squares = 0;
    for (const float value : values) mean += value;
    mean /= kArea;
    for (float& value : values) {
      value -= mean;
      squares += value * value;
    }
    const float norm = std::sqrt(squares);
    if (norm > 0)
      for (float& value : values) value /= norm;
    return norm;
  }

  static constexpr float kFlat = 9;      // grey levels, norm over the window: one for each pixel
  static constexpr float kEdge = 0.01F;  // of det / trace^2: less is an edge, along which a shift is open

  std::array<float, kWide * kWide> wide_;
  std::array<float, kArea> template_, gradient_x_, gradient_y_, seen_;
  Mat2<float> inverse_hessian_;
};

}  // namespace sslam
