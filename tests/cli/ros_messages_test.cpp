// SPDX-License-Identifier: BSD-3-Clause
// Planes and dense models as messages, which rendered rooms of a few frames have none of, and what is drawn
// into pictures. cli/bag and cli/foxglove read the other messages.
#include "cli/results/ros_messages.hpp"

#include <array>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/results/frame_view.hpp"
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

struct Marker {
  std::string name;
  std::vector<Vec3<double>> places;
  std::vector<std::array<float, 4>> colours;
};

Marker read_marker(std::string_view message) {
  io::MessageFields fields(io::Wire::kCdr, message);
  (void)fields.number<std::int32_t>();
  (void)fields.number<std::uint32_t>();
  (void)fields.text();
  Marker marker;
  marker.name = fields.text();
  for (int i = 0; i < 3; ++i) (void)fields.number<std::int32_t>();
  (void)fields.doubles<7>();
  (void)fields.doubles<3>();
  for (int i = 0; i < 4; ++i) (void)fields.number<float>();
  (void)fields.number<std::int32_t>();
  (void)fields.number<std::uint32_t>();
  (void)fields.number<std::uint8_t>();
  marker.places.resize(fields.number<std::uint32_t>());
  for (Vec3<double>& place : marker.places) {
    const auto at = fields.doubles<3>();
    place = {at[0], at[1], at[2]};
  }
  marker.colours.resize(fields.number<std::uint32_t>());
  for (std::array<float, 4>& colour : marker.colours)
    for (float& value : colour) value = fields.number<float>();
  return marker;
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

TEST_CASE("A dense model is triangles in the colours of its texture") {
  cli::TexturedMesh mesh;
  mesh.places = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  mesh.textures = {{0.1F, 0.1F}, {0.4F, 0.1F}, {0.1F, 0.9F}};  // in the left half
  mesh.indices = {0, 1, 2};
  cv::Mat texture(32, 64, CV_8UC3, cv::Scalar(10, 20, 30));
  texture(cv::Rect(0, 0, 32, 32)) = cv::Scalar(40, 120, 200);
  cv::imencode(".jpg", texture, mesh.jpeg);
  const std::string message = cli::mesh_message(0, mesh);
  const Marker marker = read_marker(message);
  CHECK(marker.name == "mesh");
  REQUIRE(marker.places.size() == 3);
  CHECK((marker.places[2] - Vec3<double>(0, 0, -2)).norm() < 1e-6);
  REQUIRE(marker.colours.size() == 3);
  for (const auto& colour : marker.colours) {
    CHECK(colour[0] == Approx(200.0 / 255).margin(0.03));
    CHECK(colour[1] == Approx(120.0 / 255).margin(0.03));
    CHECK(colour[2] == Approx(40.0 / 255).margin(0.03));
  }
}

TEST_CASE("The state of a frame has its level, and its row") {
  const std::vector<std::string> columns{"index", "stamp", "state", "reason", "points"};
  const auto level = [&](std::string_view state, std::string_view reason, std::string_view words) {
    const std::vector<std::string_view> cells{"7", "1.5", state, reason, "80"};
    const std::string message = cli::diagnostics_message(1'500'000'000, columns, cells);
    io::MessageFields fields(io::Wire::kCdr, message);
    CHECK(fields.number<std::int32_t>() == 1);
    CHECK(fields.number<std::uint32_t>() == 500'000'000);
    CHECK(fields.text() == "camera");
    CHECK(fields.number<std::uint32_t>() == 1);
    const auto found = fields.number<std::uint8_t>();
    CHECK(fields.text() == "sslam: tracking");
    CHECK(fields.text() == words);
    CHECK(fields.text().empty());
    CHECK(fields.number<std::uint32_t>() == 2);
    for (const char* const word : {"index", "7", "points", "80"}) CHECK(fields.text() == word);
    return int{found};
  };
  CHECK(level("manhattan", "", "manhattan") == 0);
  CHECK(level("uncertain", "", "uncertain") == 1);
  CHECK(level("lost", "too few matches", "lost: too few matches") == 2);
}

TEST_CASE("The view of a frame is read back and drawn") {
  TrackedFrame<double> frame;
  frame.frame.points.resize(1);
  frame.frame.points[0].pixel = Vec2<double>(20, 10);
  frame.point_landmarks = {LandmarkId{3}};
  frame.frame.lines.resize(1);
  frame.frame.lines[0].segment = {Vec2<double>(40, 5), Vec2<double>(40, 45)};
  frame.line_landmarks = {LandmarkId{1}};
  frame.line_axes = {std::int8_t{1}};
  const cv::Mat picture(50, 80, CV_8UC3, cv::Scalar::all(60));
  const Camera<double> camera{{50, 50, 40, 25}, {}, 80, 50};
  const std::string bytes = cli::encode_frame_view({7, picture, {}, camera, {}}, frame);
  const cli::FrameView view = cli::decode_frame_view(bytes);
  CHECK(view.row == 7);
  CHECK(view.normals.empty());
  REQUIRE(view.points.size() == 1);
  CHECK(view.mapped == 1);
  CHECK((view.points[0] - Vec2<double>(20.5 / 80, 10.5 / 50)).norm() < 1e-4);
  REQUIRE(view.lines.size() == 1);
  CHECK(view.lines[0].axis == 1);
  CHECK(view.lines[0].mapped);
  CHECK((view.lines[0].end - Vec2<double>(40.5 / 80, 45.5 / 50)).norm() < 1e-4);
  const cv::Mat drawn = cv::imdecode(cli::draw_frame_view(view), cv::IMREAD_COLOR);
  REQUIRE(drawn.size() == picture.size());
  const cv::Vec3b point = drawn.at<cv::Vec3b>(10, 20), line = drawn.at<cv::Vec3b>(25, 40),
                  far = drawn.at<cv::Vec3b>(40, 70);
  CHECK(point[2] > 150);            // yellow
  CHECK(point[0] + 60 < point[2]);  // less blue: JPEG blurs colours
  CHECK(line[1] > line[2] + 60);    // green
  CHECK(std::abs(far[1] - 60) < 8);
  for (const std::size_t size : {std::size_t{0}, std::size_t{9}, bytes.size() / 2})
    CHECK_THROWS_AS(cli::decode_frame_view(std::string_view(bytes).substr(0, size)), Error);
}

}  // namespace ros_messages_test
