// SPDX-License-Identifier: BSD-3-Clause
// A run as a recording of ROS 2, run.mcap: the path of the camera, the map in colour, the camera, the
// warnings.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/input/chunk_codec.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/ros_messages.hpp"
#include "cli/results/run_camera.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/bags/cdr_writer.hpp"
#include "sslam/io/bags/definitions.hpp"
#include "sslam/io/bags/mcap_writer.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {

struct McapCounts {
  std::size_t poses = 0, points = 0, lines = 0;
};

namespace mcap_export_detail {

[[nodiscard]] inline double seconds_per_stamp(const RunFolder& run) {
  const auto settings = run.metrics.find("settings");
  return settings != run.metrics.end() && settings->is_object() ? settings->value("seconds_per_stamp", 1.0)
                                                                : 1.0;
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
  add_first(ros_topics::kPath, path_message(begin, run.trajectory, seconds));
  const std::uint16_t tf = add_topic(ros_topics::kTf);
  for (const io::StampedPose& pose : run.trajectory) {
    const std::int64_t time = io::message_time(pose.stamp * seconds);
    out.add(tf, time, transform_message(time, pose.world_from_cam));
  }
  out.commit();
  return {run.trajectory.size(), count_alive(run.map.points), count_alive(run.map.lines)};
}

}  // namespace sslam::cli
