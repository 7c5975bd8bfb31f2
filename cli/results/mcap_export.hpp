// SPDX-License-Identifier: BSD-3-Clause
// A run as a recording of ROS 2, run.mcap: the path of the camera, the map in colour, the camera, the
// warnings. Its world has z up, as ROS has it; the camera keeps our axes, which are those of ROS's optical
// frames.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/input/chunk_codec.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/bags/cdr_writer.hpp"
#include "sslam/io/bags/definitions.hpp"
#include "sslam/io/bags/mcap_writer.hpp"
#include "sslam/io/maps/map_writer.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {

struct McapCounts {
  std::size_t poses = 0, points = 0, lines = 0;
};

namespace mcap_export_detail {

inline constexpr const char* kWorld = "map";
inline constexpr const char* kCamera = "camera";

// ROS's world from the map's: x stays, z is up (the map's -y).
[[nodiscard]] inline SE3<double> upright() {
  SE3<double> turn;
  turn.rotation = SO3<double>::from_quaternion(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);
  return turn;
}

class Exporter {
 public:
  Exporter(const RunFolder& run, io::McapWriter& out) : run_(run), out_(out) {
    const auto settings = run.metrics.find("settings");
    if (settings != run.metrics.end() && settings->is_object())
      seconds_per_stamp_ = settings->value("seconds_per_stamp", 1.0);
    begin_ = time_of(run.trajectory.front().stamp);
  }

  McapCounts write() {
    McapCounts counts;
    write_camera();
    write_warnings();
    counts.points = write_points();
    counts.lines = write_lines();
    write_path();
    const std::uint16_t tf = topic("/tf", "tf2_msgs/TFMessage");
    for (const io::StampedPose& pose : run_.trajectory) {
      const std::int64_t time = time_of(pose.stamp);
      io::CdrWriter cdr;
      cdr.length(1).header(time, kWorld).text(kCamera).pose(world_ * pose.world_from_cam);
      out_.add(tf, time, cdr.message());
    }
    counts.poses = run_.trajectory.size();
    return counts;
  }

 private:
  std::uint16_t topic(std::string_view name, const std::string& type) {
    const std::size_t slash = type.find('/');
    return out_.add_topic(name, type.substr(0, slash) + "/msg" + type.substr(slash),
                          io::full_definition(type));
  }

  [[nodiscard]] std::int64_t time_of(double stamp) const {
    return io::message_time(stamp * seconds_per_stamp_);
  }

  void write_path() {
    io::CdrWriter cdr;
    cdr.header(begin_, kWorld).length(run_.trajectory.size());
    for (const io::StampedPose& pose : run_.trajectory)
      cdr.header(time_of(pose.stamp), kWorld).pose(world_ * pose.world_from_cam);
    out_.add(topic("/path", "nav_msgs/Path"), begin_, cdr.message());
  }

  // Points as RViz and Foxglove read them: three floats, and a fourth whose bytes are blue, green, red.
  std::size_t write_points() {
    constexpr std::uint32_t kStep = 16;
    constexpr std::uint8_t kFloat = 7;
    std::string data;
    for (std::size_t i = 0; i < run_.map.points.size(); ++i) {
      if (!run_.map.points[i].alive) continue;
      const Vec3<float> p = (world_ * run_.map.points[i].position).cast<float>();
      const io::Colour c = colour_at(run_.colours.points, i).value_or(io::kNoColour);
      data.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(float));
      for (const std::uint8_t byte : {c[2], c[1], c[0], std::uint8_t{0}}) data += static_cast<char>(byte);
    }
    const std::size_t count = data.size() / kStep;
    io::CdrWriter cdr;
    cdr.header(begin_, kWorld).number(std::uint32_t{1}).number(static_cast<std::uint32_t>(count));
    cdr.length(4);
    std::uint32_t offset = 0;
    for (const char* const name : {"x", "y", "z", "rgb"}) {
      cdr.text(name).number(offset).number(kFloat).number(std::uint32_t{1});
      offset += sizeof(float);
    }
    cdr.number(std::uint8_t{0}).number(kStep).number(static_cast<std::uint32_t>(data.size()));
    cdr.length(data.size()).raw(data).number(std::uint8_t{1});
    out_.add(topic("/points", "sensor_msgs/PointCloud2"), begin_, cdr.message());
    return count;
  }

  // One marker, a list of lines with a colour for each end.
  std::size_t write_lines() {
    constexpr std::int32_t kLineList = 5, kAdd = 0;
    std::vector<Vec3<double>> ends;
    std::vector<io::Colour> colours;
    for (std::size_t i = 0; i < run_.map.lines.size(); ++i) {
      const auto& line = run_.map.lines[i];
      if (!line.alive) continue;
      const io::Colour colour = colour_at(run_.colours.lines, i).value_or(io::kNoColour);
      ends.insert(ends.end(), {world_ * line.start, world_ * line.end});
      colours.insert(colours.end(), {colour, colour});
    }
    io::CdrWriter cdr;
    cdr.header(begin_, kWorld).text("lines").number(std::int32_t{0}).number(kLineList).number(kAdd);
    cdr.pose({}).point({0.01, 0, 0}).colour(1, 1, 1).time(0).number(std::uint8_t{0});
    cdr.length(ends.size());
    for (const Vec3<double>& end : ends) cdr.point(end);
    cdr.length(colours.size());
    constexpr float kWhite = 255;
    for (const io::Colour& c : colours) cdr.colour(c[0] / kWhite, c[1] / kWhite, c[2] / kWhite);
    cdr.text("").header(0, "").text("").length(0).length(0);           // no texture
    cdr.text("").text("").text("").length(0).number(std::uint8_t{0});  // no words, no mesh
    out_.add(topic("/lines", "visualization_msgs/Marker"), begin_, cdr.message());
    return ends.size() / 2;
  }

  // Throws Error when the settings do not tell the camera.
  void write_camera() {
    std::array<double, 4> p{};
    std::array<double, 5> lens{};
    std::array<std::uint32_t, 2> size{};
    try {
      const auto& settings = run_.metrics.at("settings");
      p = settings.at("pinhole").get<std::array<double, 4>>();
      lens = settings.at("distortion").get<std::array<double, 5>>();
      size = settings.at("image_size").get<std::array<std::uint32_t, 2>>();
    } catch (const nlohmann::json::exception&) {
      throw Error(
          "metrics.json: does not tell the camera of the run (settings: pinhole, distortion, image_size)");
    }
    io::CdrWriter cdr;
    cdr.header(begin_, kCamera).number(size[1]).number(size[0]).text("plumb_bob");
    cdr.length(lens.size()).doubles(lens);
    cdr.doubles(std::array{p[0], 0.0, p[2], 0.0, p[1], p[3], 0.0, 0.0, 1.0});
    cdr.doubles(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    cdr.doubles(std::array{p[0], 0.0, p[2], 0.0, 0.0, p[1], p[3], 0.0, 0.0, 0.0, 1.0, 0.0});
    for (int i = 0; i < 6; ++i) cdr.number(std::uint32_t{0});  // binning, region of interest
    cdr.number(std::uint8_t{0});
    out_.add(topic("/camera_info", "sensor_msgs/CameraInfo"), begin_, cdr.message());
  }

  // What the run said.
  void write_warnings() {
    constexpr std::uint8_t kWarning = 30;
    const std::uint16_t log = topic("/rosout", "rcl_interfaces/Log");
    const auto warnings = run_.metrics.find("warnings");
    if (warnings == run_.metrics.end() || !warnings->is_array()) return;
    for (const auto& warning : *warnings) {
      if (!warning.is_string()) continue;
      io::CdrWriter cdr;
      cdr.time(begin_).number(kWarning).text("sslam").text(warning.get<std::string>());
      cdr.text("").text("").number(std::uint32_t{0});
      out_.add(log, begin_, cdr.message());
    }
  }

  const RunFolder& run_;
  io::McapWriter& out_;
  SE3<double> world_ = upright();
  double seconds_per_stamp_ = 1;
  std::int64_t begin_ = 0;
};

}  // namespace mcap_export_detail

// `run` has tracked frames. Throws Error when it cannot be written, or has times that ROS has not.
inline McapCounts write_mcap_export(const std::filesystem::path& file, const RunFolder& run) {
  io::McapWriter out(file, chunk_codec(), "sslam " SSLAM_VERSION);
  const McapCounts counts = mcap_export_detail::Exporter(run, out).write();
  out.commit();
  return counts;
}

}  // namespace sslam::cli
