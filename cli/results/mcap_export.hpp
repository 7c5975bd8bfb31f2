// SPDX-License-Identifier: BSD-3-Clause
// A run as a recording of ROS 2, run.mcap: the path of the camera, the map in colour, the camera, the
// frames' states and pictures, the warnings.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/input/chunk_codec.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/ros_messages.hpp"
#include "cli/results/run_camera.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/bags/cdr_writer.hpp"
#include "sslam/io/bags/definitions.hpp"
#include "sslam/io/bags/mcap_writer.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {

struct McapCounts {
  std::size_t poses = 0, points = 0, lines = 0, pictures = 0;
};

namespace mcap_export_detail {

[[nodiscard]] inline double seconds_per_stamp(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  return settings != run.metrics.end() && settings->is_object() ? settings->value("seconds_per_stamp", 1.0)
                                                                : 1.0;
}

// A message of each frame's row in frames.csv. Answers with their times.
inline std::vector<std::int64_t> add_diagnostics(io::McapWriter& out, std::uint16_t topic,
                                                 const RunFolder& run, double seconds) {
  const io::CsvTable& table = run.frames;
  const std::size_t stamp = table.column("stamp");
  std::vector<std::int64_t> times;
  std::vector<std::string_view> cells(table.columns.size());
  for (std::size_t row = 0; stamp < cells.size() && row < table.rows(); ++row) {
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = table.cell(row, i);
    times.push_back(io::message_time(io::parse_number<double>(cells[stamp]).value_or(0) * seconds));
    out.add(topic, times.back(), diagnostics_message(times.back(), table.columns, cells));
  }
  return times;
}

// The small pictures that the report shows as well, plain and with features, and the normals. Answers with
// the number of pictures.
template <class AddTopic>
std::size_t add_pictures(io::McapWriter& out, AddTopic add_topic, const RunFolder& run,
                         const std::vector<std::int64_t>& times) {
  if (run.views.empty()) return 0;
  const std::uint16_t image = add_topic(ros_topics::kImage), overlay = add_topic(ros_topics::kOverlay),
                      normals = add_topic(ros_topics::kNormals);
  std::size_t count = 0;
  for (const std::string& bytes : run.views) {
    const FrameView view = decode_frame_view(bytes);
    if (view.row >= times.size() || view.picture.empty()) continue;
    const std::int64_t time = times[view.row];
    out.add(image, time, image_message(time, view.picture));
    const std::vector<unsigned char> drawn = draw_frame_view(view);
    const std::string_view jpeg(reinterpret_cast<const char*>(drawn.data()), drawn.size());
    if (!jpeg.empty()) out.add(overlay, time, image_message(time, jpeg));
    if (!view.normals.empty()) out.add(normals, time, image_message(time, view.normals));
    ++count;
  }
  return count;
}

}  // namespace mcap_export_detail

// `run` has tracked frames. Throws Error when it cannot be written, or has times that ROS has not.
inline McapCounts write_mcap_export(const std::filesystem::path& file, const RunFolder& run) {
  const double seconds = mcap_export_detail::seconds_per_stamp(run);
  const std::int64_t begin = io::message_time(run.trajectory.front().stamp * seconds);
  io::McapWriter out(file, chunk_codec(), "sslam " SSLAM_VERSION);
  const auto add_topic = [&](const RosTopic& topic) {
    return out.add_topic(topic.name, full_type(topic), io::full_definition(topic.type));
  };
  const auto add_first = [&](const RosTopic& topic, const std::string& message) {
    out.add(add_topic(topic), begin, message);
  };
  add_first(ros_topics::kCamera, camera_message(begin, camera_of(run)));
  const std::uint16_t log = add_topic(ros_topics::kLog);
  const auto warnings = run.metrics.find("warnings");
  if (warnings != run.metrics.end() && warnings->is_array())
    for (const auto& warning : *warnings)
      if (warning.is_string()) out.add(log, begin, log_message(begin, warning.get<std::string>()));
  add_first(ros_topics::kPoints, points_message(begin, run.map, run.colours));
  add_first(ros_topics::kLines, lines_message(begin, run.map, run.colours));
  add_first(ros_topics::kPlanes, planes_message(begin, run.map));
  if (!run.surfaces.empty()) add_first(ros_topics::kMesh, mesh_message(begin, run.surfaces));
  add_first(ros_topics::kPath, path_message(begin, run.trajectory, seconds));
  const std::uint16_t tf = add_topic(ros_topics::kTf);
  for (const io::StampedPose& pose : run.trajectory) {
    const std::int64_t time = io::message_time(pose.stamp * seconds);
    out.add(tf, time, transform_message(time, pose.world_from_cam));
  }
  const std::vector<std::int64_t> times =
      mcap_export_detail::add_diagnostics(out, add_topic(ros_topics::kDiagnostics), run, seconds);
  const std::size_t pictures = mcap_export_detail::add_pictures(out, add_topic, run, times);
  out.commit();
  return {run.trajectory.size(), count_alive(run.map.points), count_alive(run.map.lines), pictures};
}

}  // namespace sslam::cli
