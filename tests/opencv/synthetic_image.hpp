// SPDX-License-Identifier: BSD-3-Clause
// Images for the tests of the front end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/core/random.hpp"
#include "support/drawn_image.hpp"

namespace sslam::test {

[[nodiscard]] inline cv::Mat copy_of(const testing::DrawnImage& drawn) {
  cv::Mat image(drawn.size.height, drawn.size.width, CV_8U);
  std::copy(drawn.pixels.begin(), drawn.pixels.end(), image.begin<std::uint8_t>());
  return image;
}

template <class Shade>
cv::Mat draw(cv::Size size, Shade shade) {
  return copy_of(testing::draw({size.width, size.height}, shade));
}

inline cv::Mat draw_box(cv::Size size, const Vec2<double>& low, const Vec2<double>& high, double angle,
                        double inside, double outside) {
  return copy_of(testing::draw_box({size.width, size.height}, low, high, angle, inside, outside));
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

// To a whole image, not a part of one.
inline void add_noise(cv::Mat& image, double sigma, std::uint64_t seed) {
  CV_Assert(image.isContinuous() && image.type() == CV_8U);
  testing::add_noise({image.data, image.total()}, sigma, seed);
}

}  // namespace sslam::test
