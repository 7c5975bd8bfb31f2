// SPDX-License-Identifier: BSD-3-Clause
// Depth and normal images against those of the renderer.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sslam/opencv/normals/normal_picture.hpp"
#include "support/catch.hpp"
#include "support/colmap_model.hpp"

namespace sslam::testing {

// Rows of `stamp file`.
[[nodiscard]] inline std::vector<std::pair<std::string, std::filesystem::path>> rows_of(
    const std::filesystem::path& list) {
  std::vector<std::pair<std::string, std::filesystem::path>> rows;
  for (const std::string& line : lines_of(list)) {
    const auto blank = line.find(' ');
    rows.emplace_back(line.substr(0, blank), line.substr(blank + 1));
  }
  return rows;
}

[[nodiscard]] inline cv::Mat_<std::uint16_t> depth_in(const std::filesystem::path& file) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  INFO(file.string());
  REQUIRE(image.type() == CV_16UC1);
  return image;
}

[[nodiscard]] inline cv::Mat_<cv::Vec3b> normals_in(const std::filesystem::path& file) {
  return cv::imread(file.string(), cv::IMREAD_COLOR);
}

[[nodiscard]] inline Vec3<double> normal_of(const cv::Vec3b& pixel) {
  return (Vec3<double>(pixel[2], pixel[1], pixel[0]).array() / 127.5 - 1).matrix();
}

// How an estimate differs from the truth over the pixels where the truth is smooth.
struct Comparison {
  std::vector<double> errors;   // of depth, as shares
  std::vector<double> bends;    // of normals, degrees
  std::size_t true_pixels = 0;  // where the truth has depth
  Mat3<double> a = Mat3<double>::Zero();
  Vec3<double> b = Vec3<double>::Zero();

  void add(const cv::Mat_<std::uint16_t>& depth, const cv::Mat_<std::uint16_t>& truth) {
    REQUIRE(depth.size() == truth.size());
    for (int v = 2; v < truth.rows - 2; ++v)
      for (int u = 2; u < truth.cols - 2; ++u) {
        if (truth(v, u) == 0) continue;
        ++true_pixels;
        if (depth(v, u) == 0) continue;
        const auto inverse = [&](int du, int dv) { return 1.0 / truth(v + dv, u + du); };
        const double error = truth(v, u) * (1.0 / depth(v, u) - inverse(0, 0));
        errors.push_back(std::abs(error));
        if (std::abs(error) > 0.03) continue;
        const Vec3<double> slope(1, truth(v, u) * (inverse(2, 0) - inverse(-2, 0)) / 4,
                                 truth(v, u) * (inverse(0, 2) - inverse(0, -2)) / 4);
        if (!(slope.tail<2>().norm() < 0.02)) continue;
        a += slope * slope.transpose();
        b += slope * error;
      }
  }
  void add_normals(const cv::Mat_<std::uint16_t>& depth, const cv::Mat_<cv::Vec3b>& normals,
                   const cv::Mat_<cv::Vec3b>& truth) {
    REQUIRE(normals.size() == truth.size());
    REQUIRE(normals.size() == depth.size());
    for (int v = 0; v < truth.rows; v += 3)
      for (int u = 0; u < truth.cols; u += 3) {
        REQUIRE((depth(v, u) == 0) == (normals(v, u) == no_normal()));
        if (depth(v, u) == 0 || truth(v, u) == cv::Vec3b()) continue;
        const double cosine = normal_of(normals(v, u)).normalized().dot(normal_of(truth(v, u)).normalized());
        bends.push_back(degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
      }
  }
  // The scale of inverse depth, less one, and by how many pixels the estimate lies beside the truth.
  [[nodiscard]] Vec3<double> shift() const { return a.ldlt().solve(b); }
};

}  // namespace sslam::testing
