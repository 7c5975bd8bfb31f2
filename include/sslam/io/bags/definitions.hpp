// SPDX-License-Identifier: BSD-3-Clause
// The message types that are written, by their fields: those of ROS 2 Humble and later (common_interfaces,
// geometry2, rcl_interfaces).
#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace sslam::io {

struct MessageDefinition {
  std::string_view type;  // "std_msgs/Header"
  std::string_view fields;
};

inline constexpr std::array kDefinitions{
    MessageDefinition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    MessageDefinition{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    MessageDefinition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    MessageDefinition{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    MessageDefinition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    MessageDefinition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    MessageDefinition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    MessageDefinition{"geometry_msgs/Pose",
                      "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    MessageDefinition{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    MessageDefinition{"geometry_msgs/Transform",
                      "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    MessageDefinition{"geometry_msgs/TransformStamped",
                      "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    MessageDefinition{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    MessageDefinition{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    MessageDefinition{"sensor_msgs/PointField", "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    MessageDefinition{"sensor_msgs/PointCloud2",
                      "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
                      "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    MessageDefinition{"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    MessageDefinition{"sensor_msgs/RegionOfInterest",
                      "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    MessageDefinition{"sensor_msgs/CameraInfo",
                      "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
                      "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\n"
                      "uint32 binning_y\nsensor_msgs/RegionOfInterest roi\n"},
    MessageDefinition{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    MessageDefinition{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    MessageDefinition{
        "visualization_msgs/Marker",
        "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
        "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
        "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
        "std_msgs/ColorRGBA[] colors\nstring texture_resource\n"
        "sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\n"
        "string text\nstring mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
        "bool mesh_use_embedded_materials\n"},
    MessageDefinition{"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    MessageDefinition{"diagnostic_msgs/DiagnosticStatus",
                      "byte level\nstring name\nstring message\nstring hardware_id\n"
                      "diagnostic_msgs/KeyValue[] values\n"},
    MessageDefinition{"diagnostic_msgs/DiagnosticArray",
                      "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    MessageDefinition{"rcl_interfaces/Log",
                      "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n"
                      "string function\nuint32 line\n"},
};

namespace definition_detail {

[[nodiscard]] inline std::string_view fields_of(std::string_view type) {
  for (const MessageDefinition& known : kDefinitions)
    if (known.type == type) return known.fields;
  return {};
}

// Those that `type` is made of, each once, in the order in which they are met.
inline void add_parts(std::string_view type, std::set<std::string_view>& met, std::string& text) {
  const std::string_view fields = fields_of(type);
  for (const MessageDefinition& part : kDefinitions) {
    const std::size_t at = fields.find(part.type);
    const std::size_t end = at + part.type.size();
    const bool used = at != std::string_view::npos && (at == 0 || fields[at - 1] == '\n') &&
                      (fields[end] == ' ' || fields[end] == '[');
    if (!used || !met.insert(part.type).second) continue;
    text += std::string(80, '=') + "\nMSG: " + std::string(part.type) + "\n" + std::string(part.fields);
    add_parts(part.type, met, text);
  }
}

}  // namespace definition_detail

// The type's definition with those of its parts, as the encoding ros2msg has it.
[[nodiscard]] inline std::string full_definition(std::string_view type) {
  std::set<std::string_view> met;
  std::string text(definition_detail::fields_of(type));
  definition_detail::add_parts(type, met, text);
  return text;
}

}  // namespace sslam::io
