// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/ros_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "cli/results/plane_sheets.hpp"
#include "sslam/io/bags/cdr_writer.hpp"
#include "sslam/io/bags/upright.hpp"
#include "sslam/track/contract/result.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kWorldFrame = "map";
constexpr const char* kCameraFrame = "camera";

struct MarkerCorners {
  std::vector<Vec3<double>> places;
  std::vector<std::array<float, 4>> colours;  // one a place, or none: all have the marker's
};

// visualization_msgs/Marker. `kind`: of that message's constants.
std::string marker_message(std::int64_t time, const char* name, std::int32_t kind, const Vec3<double>& scale,
                           const std::array<float, 4>& colour, const MarkerCorners& corners) {
  constexpr std::int32_t kAdd = 0;
  io::CdrWriter cdr;
  cdr.header(time, kWorldFrame).text(name).number(std::int32_t{0}).number(kind).number(kAdd);
  cdr.pose({}).point(scale).colour(colour[0], colour[1], colour[2], colour[3]);
  cdr.time(0).number(std::uint8_t{0});  // for ever, where it is
  cdr.length(corners.places.size());
  for (const Vec3<double>& place : corners.places) cdr.point(place);
  cdr.length(corners.colours.size());
  for (const std::array<float, 4>& c : corners.colours) cdr.colour(c[0], c[1], c[2], c[3]);
  cdr.text("").header(0, "").text("").length(0).length(0);           // no texture
  cdr.text("").text("").text("").length(0).number(std::uint8_t{0});  // no words, no mesh
  return cdr.message();
}

std::array<float, 4> float_colour(const io::Colour& c, float alpha = 1) {
  constexpr float kWhite = 255;
  return {c[0] / kWhite, c[1] / kWhite, c[2] / kWhite, alpha};
}

// Of a triangle's texture, at points that are spread over it.
std::array<float, 4> mean_colour(const TexturedMesh& mesh, const std::array<std::size_t, 3>& corners,
                                 const cv::Mat& texture) {
  if (texture.empty()) return {1, 1, 1, 1};
  constexpr int kSteps = 8;
  cv::Scalar sum;
  int count = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; i + j < kSteps; ++j, ++count) {
      const float a = (static_cast<float>(i) + 1.0F / 3) / kSteps,
                  b = (static_cast<float>(j) + 1.0F / 3) / kSteps;
      const Vec2<float> at = a * mesh.textures[corners[0]] + b * mesh.textures[corners[1]] +
                             (1 - a - b) * mesh.textures[corners[2]];
      const auto inside = [](float share, int size) {
        return std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1);
      };
      sum += cv::Scalar(texture.at<cv::Vec3b>(inside(at.y(), texture.rows), inside(at.x(), texture.cols)));
    }
  const auto mean = [&](int channel) { return static_cast<std::uint8_t>(std::lround(sum[channel] / count)); };
  return float_colour({mean(2), mean(1), mean(0)});
}

}  // namespace

std::string full_type(const RosTopic& topic) {
  const std::string type = topic.type;
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

std::string transform_message(std::int64_t time, const SE3<double>& world_from_cam) {
  io::CdrWriter cdr;
  cdr.length(1).header(time, kWorldFrame).text(kCameraFrame).pose(io::upright_from_map() * world_from_cam);
  return cdr.message();
}

std::string path_message(std::int64_t time, std::span<const io::StampedPose> poses,
                         double seconds_per_stamp) {
  const SE3<double> upright = io::upright_from_map();
  io::CdrWriter cdr;
  cdr.header(time, kWorldFrame).length(poses.size());
  for (const io::StampedPose& pose : poses)
    cdr.header(io::message_time(pose.stamp * seconds_per_stamp), kWorldFrame)
        .pose(upright * pose.world_from_cam);
  return cdr.message();
}

// Three floats, and a fourth whose bytes are blue, green, red.
std::string points_message(std::int64_t time, const Map<double>& map, const MapColours& colours) {
  constexpr std::uint32_t kStep = 16;
  constexpr std::uint8_t kFloat = 7;
  const SE3<double> upright = io::upright_from_map();
  std::string data;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!map.points[i].alive) continue;
    const Vec3<float> p = (upright * map.points[i].position).cast<float>();
    const io::Colour c = colour_at(colours.points, i).value_or(io::kNoColour);
    data.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(float));
    for (const std::uint8_t byte : {c[2], c[1], c[0], std::uint8_t{0}}) data += static_cast<char>(byte);
  }
  io::CdrWriter cdr;
  cdr.header(time, kWorldFrame).number(std::uint32_t{1});
  cdr.number(static_cast<std::uint32_t>(data.size() / kStep)).length(4);
  std::uint32_t offset = 0;
  for (const char* const name : {"x", "y", "z", "rgb"}) {
    cdr.text(name).number(offset).number(kFloat).number(std::uint32_t{1});
    offset += sizeof(float);
  }
  cdr.number(std::uint8_t{0}).number(kStep).number(static_cast<std::uint32_t>(data.size()));
  cdr.length(data.size()).raw(data).number(std::uint8_t{1});
  return cdr.message();
}

std::string lines_message(std::int64_t time, const Map<double>& map, const MapColours& colours) {
  constexpr std::int32_t kLineList = 5;
  constexpr double kWidth = 0.01;
  const SE3<double> upright = io::upright_from_map();
  MarkerCorners ends;
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    const auto& line = map.lines[i];
    if (!line.alive) continue;
    const auto colour = float_colour(colour_at(colours.lines, i).value_or(io::kNoColour));
    ends.places.insert(ends.places.end(), {upright * line.start, upright * line.end});
    ends.colours.insert(ends.colours.end(), {colour, colour});
  }
  return marker_message(time, "lines", kLineList, {kWidth, 0, 0}, {1, 1, 1, 1}, ends);
}

std::string planes_message(std::int64_t time, const Map<double>& map) {
  constexpr std::int32_t kTriangleList = 11;
  const SE3<double> upright = io::upright_from_map();
  MarkerCorners triangles;
  for (const PlaneSheet& sheet : plane_sheets(map))
    for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U}) triangles.places.push_back(upright * sheet[i]);
  return marker_message(time, "planes", kTriangleList, {1, 1, 1},
                        float_colour(kSheetColour, static_cast<float>(kSheetAlpha) / 255), triangles);
}

std::string camera_message(std::int64_t time, const Camera<double>& camera) {
  const Pinhole<double>& p = camera.pinhole;
  const RadTan<double>& lens = camera.distortion;
  io::CdrWriter cdr;
  cdr.header(time, kCameraFrame).number(static_cast<std::uint32_t>(camera.height));
  cdr.number(static_cast<std::uint32_t>(camera.width)).text("plumb_bob");
  cdr.length(5).doubles(std::array{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3});
  cdr.doubles(std::array{p.fx, 0.0, p.cx, 0.0, p.fy, p.cy, 0.0, 0.0, 1.0});
  cdr.doubles(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  cdr.doubles(std::array{p.fx, 0.0, p.cx, 0.0, 0.0, p.fy, p.cy, 0.0, 0.0, 0.0, 1.0, 0.0});
  for (int i = 0; i < 6; ++i) cdr.number(std::uint32_t{0});  // binning, region of interest
  cdr.number(std::uint8_t{0});
  return cdr.message();
}

std::string image_message(std::int64_t time, std::string_view jpeg) {
  io::CdrWriter cdr;
  cdr.header(time, kCameraFrame).text("jpeg").length(jpeg.size()).raw(jpeg);
  return cdr.message();
}

std::string mesh_message(std::int64_t time, const TexturedMesh& mesh) {
  constexpr std::int32_t kTriangleList = 11;
  const SE3<double> upright = io::upright_from_map();
  const cv::Mat texture = cv::imdecode(mesh.jpeg, cv::IMREAD_COLOR);
  MarkerCorners triangles;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<std::size_t, 3> corners{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    for (const std::size_t corner : corners)
      triangles.places.push_back(upright * mesh.places[corner].cast<double>());
    triangles.colours.insert(triangles.colours.end(), 3, mean_colour(mesh, corners, texture));
  }
  return marker_message(time, "mesh", kTriangleList, {1, 1, 1}, {1, 1, 1, 1}, triangles);
}

std::string diagnostics_message(std::int64_t time, std::span<const std::string> columns,
                                std::span<const std::string_view> cells) {
  constexpr std::uint8_t kFine = 0, kWarning = 1, kError = 2;
  std::string_view state, reason;
  std::vector<std::size_t> figures;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == "state") state = cells[i];
    if (columns[i] == "reason") reason = cells[i];
    if (columns[i] != "state" && columns[i] != "reason" && columns[i] != "stamp") figures.push_back(i);
  }
  const bool doubtful = state == name(State::kInitialising) || state == name(State::kUncertain);
  std::string message(state);
  if (!reason.empty()) message += ": " + std::string(reason);
  io::CdrWriter cdr;
  cdr.header(time, kCameraFrame).length(1);
  cdr.number(state == name(State::kLost) ? kError : doubtful ? kWarning : kFine);
  cdr.text("sslam: tracking").text(message).text("").length(figures.size());
  for (const std::size_t i : figures) cdr.text(columns[i]).text(cells[i]);
  return cdr.message();
}

std::string log_message(std::int64_t time, std::string_view text) {
  constexpr std::uint8_t kWarning = 30;
  io::CdrWriter cdr;
  cdr.time(time).number(kWarning).text("sslam").text(text).text("").text("").number(std::uint32_t{0});
  return cdr.message();
}

}  // namespace sslam::cli
