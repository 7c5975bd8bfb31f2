// SPDX-License-Identifier: BSD-3-Clause
// Normals from a registered depth map. Over a plane, inverse depth is a linear function of the pixel, and the
// noise of structured light and stereo is even in inverse depth: planes are fitted there, to windows of
// blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/image/inverse_depth_blocks.hpp"
#include "sslam/image/normal_grid.hpp"
#include "sslam/opencv/camera/lens_table.hpp"
#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/opencv/view_of.hpp"

namespace sslam {

struct DepthNormalsOptions {
  double min_depth = 0.3;              // metres
  double max_depth = 8;                // metres
  double noise = 0.0025;               // of the inverse depth of a pixel, 1 / metres
  double block_noise = 0.0012;         // of the mean over a block: what is common to neighbouring pixels
  double target_error = radians(1.0);  // of a normal: the window grows until it should be reached
  int max_radius = 3;                  // of a window, blocks
  double min_fill = 0.5;               // share of the window that must lie on the plane
  PlanarMaskOptions mask;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_depth", self.min_depth, Unit::kNumber, 0.001, 1e6, "metres");
    visit("max_depth", self.max_depth, Unit::kNumber, 0.001, 1e6, "metres");
    visit("noise", self.noise, Unit::kNumber, 1e-9, 10, "of the inverse depth of a pixel, 1 / metres");
    visit("block_noise", self.block_noise, Unit::kNumber, 1e-9, 10,
          "of the mean over a block of pixels, 1 / metres");
    visit("target_error", self.target_error, Unit::kDegrees, 0.01, 45,
          "of a normal: the window grows until it should be reached");
    visit("max_radius", self.max_radius, Unit::kCount, 1, 100, "of a window, in blocks");
    visit("min_fill", self.min_fill, Unit::kShare, 0, 1, "of the window that must lie on the plane");
    visit_within("mask.", self.mask, visit);
  }
};
static_assert(Described<DepthNormalsOptions>);

class DepthNormals {
 public:
  DepthNormalsOptions options;

  // Of the last frame, before those off planes were left out.
  [[nodiscard]] const NormalGrid& grid() const noexcept { return grid_; }

  [[nodiscard]] NormalStatus fill(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    field.clear();
    const cv::Mat& depth = input.depth;
    if (depth.empty()) return NormalStatus::kNoInput;
    if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) return NormalStatus::kWrongType;
    const double scale = static_cast<double>(depth.cols) / camera.width;
    if (std::abs(scale * camera.height - depth.rows) > 1) return NormalStatus::kWrongSize;
    const double factor = depth.depth() == CV_16U ? input.depth_factor : 1;
    if (out_of_range(depth, factor)) return NormalStatus::kOutOfRange;
    if (depth.depth() == CV_16U)
      build_blocks(view_of<std::uint16_t>(depth), factor);
    else
      build_blocks(view_of<float>(depth), factor);
    lens_.prepare(camera, blocks_.columns(), blocks_.rows(), InverseDepthBlocks::kBlock, scale);
    focal_ = camera.pinhole.fx * scale;
    grid_.reset(blocks_.columns(), blocks_.rows());
    for (int r = 0; r < grid_.rows; ++r)
      for (int c = 0; c < grid_.columns; ++c) fit(r, c);
    keep_planar(grid_, options.mask, field);
    return NormalStatus::kOk;
  }

 private:
  // Whether next to nothing of what was measured can be used. An image without any measurement is no fault.
  [[nodiscard]] bool out_of_range(const cv::Mat& depth, double factor) const {
    constexpr double kLeast = 0.01;  // of the pixels with a measurement
    cv::Mat usable;
    cv::inRange(depth, options.min_depth * factor, options.max_depth * factor, usable);
    const int measured = cv::countNonZero(depth > 0);
    return measured > 0 && cv::countNonZero(usable) < kLeast * measured;
  }

  template <class Pixel>
  void build_blocks(ImageView<Pixel> depth, double factor) {
    blocks_.build(depth, factor, options.min_depth, options.max_depth, 3 * options.noise);
  }

  void fit(int r, int c) {
    const DepthBlock& centre = blocks_.at(r, c);
    if (!centre.planar) return;
    const float z = 1 / std::max(centre.mean, 1e-6F);
    const int radius = window_radius(z);
    InverseDepthPlane plane = centre.plane;
    DepthWindow window;
    // The first round trusts the centre's own small fit as far as it reaches, the second the fit of the
    // first.
    for (int round = 0; round < 2; ++round) {
      const float slack = round == 0 ? 1.0F : 0.0F;
      window = blocks_.gather(r, c, radius, plane, static_cast<float>(3 * options.block_noise), slack);
      if (window.blocks < options.min_fill * window.possible || !window.sums.solve(plane)) return;
    }
    if (window.scatter() > 2 * options.block_noise) return;
    set_normal(r, c, plane, radius, window);
  }

  // Blocks on either side of the centre: an error of block_noise in each block's inverse depth turns the
  // normal of a window of w x w blocks by about f z noise sqrt(12) / (w^2 block).
  [[nodiscard]] int window_radius(float z) const noexcept {
    const double target = options.target_error;
    const double width2 =
        focal_ * z * options.block_noise * std::sqrt(12.0) / (target * InverseDepthBlocks::kBlock);
    return std::clamp(static_cast<int>(std::ceil((std::sqrt(width2) - 1) / 2)), 1, options.max_radius);
  }

  void set_normal(int r, int c, const InverseDepthPlane& plane, int radius, const DepthWindow& window) {
    // 1 / z = m . (x, y, 1) in normalised coordinates, with m = n / (n . X) for any X on the plane.
    const LensPatch& lens = lens_.at(r, c);
    const Vec2<double> slope = lens.pixel_per_ray.transpose() * Vec2<double>(plane.du, plane.dv);
    const Vec3<double> m(slope.x(), slope.y(), plane.value - slope.dot(lens.ray));
    const double norm = m.norm();
    if (!(norm > 1e-9) || !std::isfinite(norm)) return;
    const auto i = static_cast<std::size_t>(r * grid_.columns + c);
    grid_.normal[i] = (-m / norm).cast<float>();
    const double width = 2 * radius + 1;
    const double error = focal_ * options.block_noise * std::sqrt(12.0) /
                         (plane.value * width * width * InverseDepthBlocks::kBlock);
    const double ratio = error / options.target_error;
    const double filled = static_cast<double>(window.blocks) / window.possible;
    grid_.weight[i] = static_cast<float>(std::min(1.0, 2 * filled / (1 + ratio * ratio)));
  }

  InverseDepthBlocks blocks_;
  LensTable lens_;
  NormalGrid grid_;
  double focal_ = 1;  // of the depth map, pixels
};
static_assert(NormalSource<DepthNormals>);

}  // namespace sslam
