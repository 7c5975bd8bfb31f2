// SPDX-License-Identifier: BSD-3-Clause
// Images for the tests of the front end, drawn with exact subpixel edges.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/core/random.hpp"
#include "sslam/core/types.hpp"

namespace sslam::test {

// Grey image of shade(x, y) in [0, 255], averaged over 64 places in each pixel, no two of them in one column
// or row.
template <class Shade>
cv::Mat draw(cv::Size size, Shade shade) {
  constexpr int kSide = 8;
  cv::Mat image(size, CV_8U);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      double sum = 0;
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
          const double x = (i + (j + 0.5) / kSide) / kSide - 0.5, y = (j + (i + 0.5) / kSide) / kSide - 0.5;
          sum += shade(u + x, v + y);
        }
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(sum / (kSide * kSide));
    }
  return image;
}

// A box with these corners, turned by `angle` about its middle.
inline cv::Mat draw_box(cv::Size size, const Vec2<double>& low, const Vec2<double>& high, double angle,
                        double inside, double outside) {
  const Vec2<double> middle = (low + high) / 2, half = (high - low) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  return draw(size, [&](double x, double y) {
    const double dx = x - middle.x(), dy = y - middle.y();
    return std::abs(c * dx + s * dy) < half.x() && std::abs(c * dy - s * dx) < half.y() ? inside : outside;
  });
}

// Smooth blobs of random brightness about 128; `contrast` is their standard deviation, grey levels.
inline cv::Mat draw_texture(cv::Size size, double contrast, std::uint64_t seed) {
  Random random(seed);
  cv::Mat noise(size, CV_32F);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) noise.at<float>(v, u) = random.uniform(-1.0F, 1.0F);
  cv::GaussianBlur(noise, noise, {}, 2.5);
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  cv::Mat image;
  noise.convertTo(image, CV_8U, contrast / deviation[0], 128 - mean[0] * contrast / deviation[0]);
  return image;
}

inline void add_noise(cv::Mat& image, double sigma, std::uint64_t seed) {
  Random random(seed);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      double sum = 0;  // twelve uniform numbers make a good enough Gaussian
      for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
      auto& pixel = image.at<std::uint8_t>(v, u);
      pixel = cv::saturate_cast<std::uint8_t>(pixel + sigma * sum);
    }
}

}  // namespace sslam::test
