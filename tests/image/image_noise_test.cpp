// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/image_noise.hpp"

#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("the noise of an image is found on flat and slanted brightness") {
  for (const double sigma : {2.0, 5.0, 10.0}) {
    DrawnImage image = draw({320, 240}, [](double x, double y) { return 60 + 0.2 * x + 0.1 * y; });
    add_noise(image.pixels, sigma, 1);
    CHECK(image_noise(image.view()) == Approx(sigma).epsilon(0.08));
  }
}

TEST_CASE("edges do not count as noise") {
  CHECK(image_noise(draw_box({320, 240}, {100, 80}, {220, 160}, 0.3, 200, 40).view()) < 0.1);
  CHECK(image_noise(DrawnImage({2, 2}, 3).view()) == 0);
}
