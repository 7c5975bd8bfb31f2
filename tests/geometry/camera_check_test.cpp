// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/camera_check.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

std::string fault_of(const Camera<double>& camera) {
  return check_camera(camera).fault;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Usual cameras raise neither fault nor doubt") {
  const Camera<double> straight{{525, 525, 319.5, 239.5}, {}, 640, 480};
  const Camera<double> bent{
      {517.3, 516.5, 318.6, 255.3}, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}, 640, 480};
  const Camera<double> wide{{458.7, 457.3, 367.2, 248.4}, {-0.2834, 0.0740, 0.0002, 0.00002, 0}, 752, 480};
  for (const Camera<double>& camera : {straight, bent, wide}) {
    CHECK(fault_of(camera).empty());
    CHECK(check_camera(camera).doubts.empty());
  }
}

TEST_CASE("A camera that cannot be that of its images has a fault") {
  CHECK(holds(fault_of({{481.2, 480, 319.5, 239.5}, {}, 320, 240}),
              "(319.5, 239.5) is far from the middle of 320x240"));
  CHECK(holds(fault_of({{0.8, 0.9, 319.5, 239.5}, {}, 640, 480}), "field of view of 180 by 180 degrees"));
  CHECK(holds(fault_of({{0.8, 0.9, 319.5, 239.5}, {}, 640, 480}), "are these parts of the image's size?"));
  CHECK(holds(fault_of({{4.2, 4.2, 319.5, 239.5}, {}, 640, 480}), "are these millimetres?"));
  CHECK(holds(fault_of({{52500, 52500, 319.5, 239.5}, {}, 640, 480}), "expected focal lengths in pixels"));
  CHECK(holds(fault_of({{525, 200, 319.5, 239.5}, {}, 640, 480}), "differ by a factor of 2.6"));
  CHECK(holds(fault_of({{525, 525, 319.5, 239.5}, {-2, 0, 0, 0, 0}, 640, 480}), "the distortion turns back"));
}

TEST_CASE("What is seldom right is a doubt") {
  const CameraCheck off = check_camera({{525, 525, 420, 239.5}, {}, 640, 480});
  REQUIRE(off.doubts.size() == 1);
  CHECK(holds(off.doubts[0], "off the middle"));
  CHECK(off.fault.empty());
  CHECK(check_camera({{525, 400, 319.5, 239.5}, {}, 640, 480}).doubts.size() == 1);
  CHECK(check_camera({{525, 525, 319.5, 239.5}, {0, 0, 0.05, 0, 0}, 640, 480}).doubts.size() == 1);
  const CameraCheck cushion = check_camera({{525, 525, 319.5, 239.5}, {5, 0, 0, 0, 0}, 640, 480});
  CHECK(cushion.fault.empty());
  REQUIRE(cushion.doubts.size() == 1);
  CHECK(holds(cushion.doubts[0], "moves corners of the image outwards by a factor of 1."));
  CHECK(check_camera({{525, 525, 319.5, 239.5}, {0.4, 0, 0, 0, 0}, 640, 480}).doubts.empty());
}
