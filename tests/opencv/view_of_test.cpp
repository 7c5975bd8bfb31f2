// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/view_of.hpp"

#include <cstdint>

#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("A view of an OpenCV image, or of a part of one, shows its pixels") {
  cv::Mat image(6, 8, CV_16U);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(10 * y + x);
  const auto whole = view_of<std::uint16_t>(image);
  CHECK(whole.width() == 8);
  CHECK(whole.height() == 6);
  CHECK(whole.at(7, 5) == 57);
  const cv::Mat part = image(cv::Rect(2, 1, 4, 3));
  const auto view = view_of<std::uint16_t>(part);
  CHECK(view.size().width == 4);
  CHECK(view.size().height == 3);
  CHECK(view.at(0, 0) == 12);
  CHECK(view.at(3, 2) == 35);
}
