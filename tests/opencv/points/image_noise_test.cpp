// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/points/image_noise.hpp"

#include "opencv/synthetic_image.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::test;

TEST_CASE("the noise of an image is found on flat and slanted brightness") {
  for (const double sigma : {2.0, 5.0, 10.0}) {
    cv::Mat image = draw({320, 240}, [](double x, double y) { return 60 + 0.2 * x + 0.1 * y; });
    add_noise(image, sigma, 1);
    CHECK(image_noise(image) == Approx(sigma).epsilon(0.08));
  }
}

TEST_CASE("edges do not count as noise") {
  CHECK(image_noise(draw_box({320, 240}, {100, 80}, {220, 160}, 0.3, 200, 40)) < 0.1);
  CHECK(image_noise(cv::Mat(2, 2, CV_8U, cv::Scalar(3))) == 0);
}
