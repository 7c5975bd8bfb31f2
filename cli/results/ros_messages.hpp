// SPDX-License-Identifier: BSD-3-Clause
// A run in the messages of ROS 2, as bytes in CDR: for recordings (run.mcap) and for who looks on (Foxglove).
// Their world, `map`, has z up, as ROS has it; the frame `camera` keeps our axes, which are those of ROS's
// optical frames.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cli/results/map_colours.hpp"
#include "cli/results/textured_mesh.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

struct RosTopic {
  const char* name;
  const char* type;  // "package/Type"
};

namespace ros_topics {

inline constexpr RosTopic kTf{"/tf", "tf2_msgs/TFMessage"};
inline constexpr RosTopic kPath{"/path", "nav_msgs/Path"};
inline constexpr RosTopic kPoints{"/points", "sensor_msgs/PointCloud2"};
inline constexpr RosTopic kLines{"/lines", "visualization_msgs/Marker"};
inline constexpr RosTopic kPlanes{"/planes", "visualization_msgs/Marker"};
inline constexpr RosTopic kCamera{"/camera_info", "sensor_msgs/CameraInfo"};
inline constexpr RosTopic kImage{"/image/compressed", "sensor_msgs/CompressedImage"};
inline constexpr RosTopic kOverlay{"/overlay/compressed", "sensor_msgs/CompressedImage"};
inline constexpr RosTopic kNormals{"/normals/compressed", "sensor_msgs/CompressedImage"};
inline constexpr RosTopic kMesh{"/mesh", "visualization_msgs/Marker"};
inline constexpr RosTopic kDiagnostics{"/diagnostics", "diagnostic_msgs/DiagnosticArray"};
inline constexpr RosTopic kLog{"/rosout", "rcl_interfaces/Log"};

}  // namespace ros_topics

// The type's name in full, "package/msg/Type".
[[nodiscard]] std::string full_type(const RosTopic& topic);

// Times are nanoseconds, as io::message_time gives them.

// `map` to `camera`.
[[nodiscard]] std::string transform_message(std::int64_t time, const SE3<double>& world_from_cam);

// Throws Error for a stamp that ROS has not.
[[nodiscard]] std::string path_message(std::int64_t time, std::span<const io::StampedPose> poses,
                                       double seconds_per_stamp);

// The points that are alive, as RViz and Foxglove read them: x, y, z, rgb.
[[nodiscard]] std::string points_message(std::int64_t time, const Map<double>& map,
                                         const MapColours& colours);

// One marker, a list of lines with a colour for each end.
[[nodiscard]] std::string lines_message(std::int64_t time, const Map<double>& map, const MapColours& colours);

// One marker, two triangles for the part of each plane that its points and lines cover.
[[nodiscard]] std::string planes_message(std::int64_t time, const Map<double>& map);

[[nodiscard]] std::string camera_message(std::int64_t time, const Camera<double>& camera);

// `jpeg`: the image's file, of the frame `camera`.
[[nodiscard]] std::string image_message(std::int64_t time, std::string_view jpeg);

// One marker, the triangles of `--dense`, each in the mean colour of its texture.
[[nodiscard]] std::string mesh_message(std::int64_t time, const TexturedMesh& mesh);

// How a frame was tracked: its state, and its row of frames.csv. `cells`: one for each of `columns`.
[[nodiscard]] std::string diagnostics_message(std::int64_t time, std::span<const std::string> columns,
                                              std::span<const std::string_view> cells);

// A warning.
[[nodiscard]] std::string log_message(std::int64_t time, std::string_view text);

}  // namespace sslam::cli
