// SPDX-License-Identifier: BSD-3-Clause
// Where the blocks of a depth map look: the ray through the middle of each, and how pixels near it become
// normalised coordinates, with the lens's distortion.
#pragma once

#include <cstddef>
#include <vector>

#include "sslam/opencv/camera/same_camera.hpp"

namespace sslam {

struct LensPatch {
  Vec2<double> ray;            // undistorted normalised coordinates of the middle of the block
  Mat2<double> pixel_per_ray;  // derivative of the distorted pixel with respect to them
};

class LensTable {
 public:
  // For columns x rows blocks of `block` pixels of a depth map that is `scale` times as wide as the camera's
  // image.
  void prepare(const Camera<double>& camera, int columns, int rows, int block, double scale) {
    if (same_camera(camera, camera_) && columns == columns_ && scale == scale_ &&
        patches_.size() == static_cast<std::size_t>(columns * rows))
      return;
    camera_ = camera;
    columns_ = columns;
    scale_ = scale;
    patches_.clear();
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        patches_.push_back(
            patch(Vec2<double>((c + 0.5) * block / scale - 0.5, (r + 0.5) * block / scale - 0.5)));
  }

  [[nodiscard]] const LensPatch& at(int r, int c) const noexcept {
    return patches_[static_cast<std::size_t>(r * columns_ + c)];
  }

 private:
  [[nodiscard]] LensPatch patch(const Vec2<double>& pixel) const noexcept {
    const Pinhole<double>& p = camera_.pinhole;
    LensPatch patch;
    (void)camera_.distortion.undistort(p.unproject(pixel).head<2>(), patch.ray);
    const Vec2<double> focal(scale_ * p.fx, scale_ * p.fy);
    patch.pixel_per_ray = focal.asDiagonal() * camera_.distortion.distort_jacobian(patch.ray);
    return patch;
  }

  Camera<double> camera_;
  int columns_ = 0;
  double scale_ = 0;
  std::vector<LensPatch> patches_;
};

}  // namespace sslam
