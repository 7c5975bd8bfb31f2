// SPDX-License-Identifier: BSD-3-Clause
// Planes as a message, which rendered rooms of a few frames have none of. cli/bag and cli/foxglove read the
// other messages.
#include "cli/results/ros_messages.hpp"

#include <array>
#include <vector>

#include "sslam/io/bags/message_fields.hpp"
#include "support/catch.hpp"

namespace ros_messages_test {

namespace {

using namespace sslam;

// A floor one below the origin, seen where two metres by four have points; and a plane that has gone.
Map<double> map_with_floor() {
  Map<double> map;
  map.planes.resize(2);
  map.planes[0].alive = false;
  map.planes[1].plane = {Vec3<double>(0, 1, 0), 1};
  for (const auto& [x, z] : {std::array{-1.0, 3.0}, {1.0, 3.0}, {-1.0, 7.0}, {1.0, 7.0}}) {
    auto& point = map.points.emplace_back();
    point.position = Vec3<double>(x, 1.1, z);  // off the plane by a little
    point.plane = 1;
  }
  return map;
}

}  // namespace

TEST_CASE("A plane is two triangles over its points, in a world with z up") {
  const std::string message = cli::planes_message(1'500'000'000, map_with_floor());
  io::MessageFields fields(io::Wire::kCdr, message);
  CHECK(fields.number<std::int32_t>() == 1);
  CHECK(fields.number<std::uint32_t>() == 500'000'000);
  CHECK(fields.text() == "map");
  CHECK(fields.text() == "planes");
  CHECK(fields.number<std::int32_t>() == 0);
  constexpr std::int32_t kTriangleList = 11;
  CHECK(fields.number<std::int32_t>() == kTriangleList);
  CHECK(fields.number<std::int32_t>() == 0);  // add
  CHECK(fields.doubles<7>() == std::array<double, 7>{0, 0, 0, 0, 0, 0, 1});
  CHECK(fields.doubles<3>() == std::array<double, 3>{1, 1, 1});
  std::array<float, 4> colour;
  for (float& value : colour) value = fields.number<float>();
  CHECK(colour[3] < 0.5F);                    // one sees through it
  CHECK(fields.number<std::int32_t>() == 0);  // for ever
  CHECK(fields.number<std::uint32_t>() == 0);
  CHECK(fields.number<std::uint8_t>() == 0);
  REQUIRE(fields.number<std::uint32_t>() == 6);
  Vec3<double> low = Vec3<double>::Constant(100), high = -low, area = Vec3<double>::Zero();
  for (int triangle = 0; triangle < 2; ++triangle) {
    std::array<Vec3<double>, 3> corners;
    for (Vec3<double>& corner : corners) {
      const auto at = fields.doubles<3>();
      corner = {at[0], at[1], at[2]};
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    area += (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2;
  }
  CHECK((low - Vec3<double>(-1, 3, -1)).norm() < 1e-9);
  CHECK((high - Vec3<double>(1, 7, -1)).norm() < 1e-9);
  CHECK(area.norm() == Approx(8));
  CHECK(fields.number<std::uint32_t>() == 0);  // all in that colour
}

}  // namespace ros_messages_test
