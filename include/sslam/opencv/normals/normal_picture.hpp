// SPDX-License-Identifier: BSD-3-Clause
// A network's dense normals brought back to the camera's image: as a picture that FileNormals reads, and over
// the image to look at.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/geometry/camera.hpp"
#include "sslam/opencv/normals/normal_evidence.hpp"

namespace sslam {

// What parse_normal_encoding makes of this are the options that read encode_normal's pixels.
inline constexpr const char* kNormalEncoding = "r=+x g=+y b=+z";

// x, y and z as red, green and blue, 0 to 255 for -1 to 1, in OpenCV's order.
[[nodiscard]] inline cv::Vec3b encode_normal(const cv::Vec3f& n) {
  const auto level = [](float x) { return static_cast<std::uint8_t>(std::lround(127.5F * (x + 1.0F))); };
  return {level(n[2]), level(n[1]), level(n[0])};
}

// Middle grey, a vector of next to no length: no reader takes it for a normal.
[[nodiscard]] inline cv::Vec3b no_normal() {
  return {128, 128, 128};
}

struct NormalPictureOptions {
  double min_planar = 0.5;     // probability from which on a pixel counts as planar
  double min_agreement = 0.9;  // length of the mean of the normals around a pixel: below, they disagree
};

namespace normal_picture_detail {

// Where each of the camera's pixels, lens distortion and all, lies on the grid of `dense`.
inline cv::Mat_<cv::Point2f> grid_positions(const DenseNormals& dense, const Camera<double>& camera) {
  cv::Mat_<cv::Point2f> position(camera.height, camera.width);
  for (int v = 0; v < position.rows; ++v) {
    for (int u = 0; u < position.cols; ++u) {
      const Vec2<double> straight = camera.undistort_pixel(Vec2<double>(u, v));
      const Vec2<double> p = dense.pinhole.project(camera.pinhole.unproject(straight));
      position(v, u) = {static_cast<float>(p.x()), static_cast<float>(p.y())};
    }
  }
  return position;
}

}  // namespace normal_picture_detail

// The normals at the camera's resolution, as encode_normal has them; no_normal() where nothing is planar,
// where the network did not look, and along edges between planes.
[[nodiscard]] inline cv::Mat_<cv::Vec3b> normal_picture(const DenseNormals& dense,
                                                        const Camera<double>& camera,
                                                        const NormalPictureOptions& options = {}) {
  // Only planar pixels lend their normals to their surroundings.
  cv::Mat_<cv::Vec3f> normal(dense.normal.size(), cv::Vec3f());
  cv::Mat_<cv::Vec2f> shares(dense.normal.size());  // planar probability, and 1 where a normal is lent
  for (int v = 0; v < normal.rows; ++v) {
    for (int u = 0; u < normal.cols; ++u) {
      const float planar = dense.planar.empty() ? 1.0F : dense.planar(v, u);
      const bool lends = planar >= options.min_planar && dense.normal(v, u) != cv::Vec3f();
      if (lends) normal(v, u) = dense.normal(v, u);
      shares(v, u) = {planar, lends ? 1.0F : 0.0F};
    }
  }
  const cv::Mat_<cv::Point2f> position = normal_picture_detail::grid_positions(dense, camera);
  cv::Mat_<cv::Vec3f> wide_normal;
  cv::Mat_<cv::Vec2f> wide_shares;
  cv::remap(normal, wide_normal, position, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(shares, wide_shares, position, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat_<cv::Vec3b> picture(position.size(), no_normal());
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const cv::Point2f& p = position(v, u);
      const bool seen = p.x > -0.5F && p.y > -0.5F && p.x < static_cast<float>(normal.cols) - 0.5F &&
                        p.y < static_cast<float>(normal.rows) - 0.5F;
      const double lent = wide_shares(v, u)[1], length = cv::norm(wide_normal(v, u));
      if (!seen || lent <= 0 || wide_shares(v, u)[0] < options.min_planar) continue;
      if (length < options.min_agreement * lent) continue;
      picture(v, u) = encode_normal(wide_normal(v, u) * (1 / length));
    }
  }
  return picture;
}

// One pixel a normal.
[[nodiscard]] inline cv::Mat_<cv::Vec3b> small_normal_picture(const NormalGrid& grid) {
  cv::Mat_<cv::Vec3b> picture(grid.rows, grid.columns, no_normal());
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const auto i = static_cast<std::size_t>(v * grid.columns + u);
      const auto& n = grid.normal[i];
      if (grid.weight[i] > 0) picture(v, u) = encode_normal({n.x(), n.y(), n.z()});
    }
  }
  return picture;
}

// Share of a picture's pixels that have a normal.
[[nodiscard]] inline double planar_share(const cv::Mat_<cv::Vec3b>& picture) {
  const auto none = std::count(picture.begin(), picture.end(), no_normal());
  const auto total = static_cast<double>(std::max<std::size_t>(picture.total(), 1));
  return 1 - static_cast<double>(none) / total;
}

// `image` (8 bit BGR, of the picture's size) with the normals' colours laid over it; pixels without a normal
// stay as they are.
[[nodiscard]] inline cv::Mat_<cv::Vec3b> overlay_normals(const cv::Mat_<cv::Vec3b>& image,
                                                         const cv::Mat_<cv::Vec3b>& picture,
                                                         double opacity = 0.55) {
  cv::Mat_<cv::Vec3b> blended;
  cv::addWeighted(image, 1 - opacity, picture, opacity, 0, blended);
  cv::Mat_<cv::Vec3b> overlay = image.clone();
  for (int v = 0; v < overlay.rows; ++v)
    for (int u = 0; u < overlay.cols; ++u)
      if (picture(v, u) != no_normal()) overlay(v, u) = blended(v, u);
  return overlay;
}

}  // namespace sslam
