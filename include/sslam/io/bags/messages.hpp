// SPDX-License-Identifier: BSD-3-Clause
// The messages that are of use here: images, the camera of images, poses. Their fields have the same order in
// ROS 1 and ROS 2 (sensor_msgs, geometry_msgs, nav_msgs).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/geometry/se3.hpp"
#include "sslam/io/bags/message_fields.hpp"

namespace sslam::io {

// The nearest double.
[[nodiscard]] inline double seconds_of(std::int64_t nanoseconds) noexcept {
  return static_cast<double>(static_cast<long double>(nanoseconds) / 1e9L);
}

// A name of a file's own, fit to be shown: of so many letters at most, and in one line.
[[nodiscard]] inline std::string shown_word(std::string_view text) {
  constexpr std::size_t kMost = 200;
  std::string word(text.substr(0, kMost));
  for (char& c : word)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '"') c = '?';
  return word;
}

struct MessageHeader {
  std::int64_t stamp = 0;  // nanoseconds; 0: the driver sets none
  std::string_view frame;
};

[[nodiscard]] inline MessageHeader read_header(MessageFields& fields) {
  const bool ros1 = fields.wire() == Wire::kRos1;
  if (ros1) (void)fields.number<std::uint32_t>();  // a count
  MessageHeader header;
  const std::int64_t seconds = ros1 ? fields.number<std::uint32_t>() : fields.number<std::int32_t>();
  header.stamp = seconds * 1'000'000'000 + fields.number<std::uint32_t>();
  header.frame = fields.text();
  return header;
}

// sensor_msgs/Image. Views of the message.
struct ImageMessage {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::string_view encoding;
  bool big_endian = false;
  std::uint32_t step = 0;  // bytes a row
  std::string_view data;
};

[[nodiscard]] inline ImageMessage read_image_message(MessageFields fields) {
  ImageMessage image;
  image.header = read_header(fields);
  image.height = fields.number<std::uint32_t>();
  image.width = fields.number<std::uint32_t>();
  image.encoding = fields.text();
  image.big_endian = fields.number<std::uint8_t>() != 0;
  image.step = fields.number<std::uint32_t>();
  image.data = fields.bytes();
  return image;
}

// sensor_msgs/CompressedImage. Views of the message.
struct CompressedImageMessage {
  MessageHeader header;
  std::string_view format;  // such as "jpeg", "rgb8; jpeg compressed bgr8", "16UC1; compressedDepth png"
  std::string_view data;    // the image's file
};

[[nodiscard]] inline CompressedImageMessage read_compressed_image(MessageFields fields) {
  CompressedImageMessage image;
  image.header = read_header(fields);
  image.format = fields.text();
  image.data = fields.bytes();
  return image;
}

// sensor_msgs/CameraInfo, as far as it is used.
struct CameraInfoMessage {
  std::string frame;
  std::uint32_t height = 0, width = 0;
  std::string model;
  std::vector<double> d;
  std::array<double, 9> k{};
  std::array<double, 12> p{};
};

[[nodiscard]] inline CameraInfoMessage read_camera_info(MessageFields fields) {
  CameraInfoMessage info;
  info.frame = shown_word(read_header(fields).frame);
  info.height = fields.number<std::uint32_t>();
  info.width = fields.number<std::uint32_t>();
  info.model = shown_word(fields.text());
  constexpr std::size_t kMostCoefficients = 14;
  info.d = fields.doubles(kMostCoefficients);
  info.k = fields.doubles<9>();
  (void)fields.doubles<9>();  // R
  info.p = fields.doubles<12>();
  return info;
}

struct PoseMessage {
  std::int64_t stamp = 0;  // nanoseconds
  std::string_view child;  // the frame whose pose it is
  SE3<double> world_from_child;
};

// geometry_msgs/TransformStamped and nav_msgs/Odometry, which begin alike. Throws Error where it is no pose.
[[nodiscard]] inline PoseMessage read_child_pose(MessageFields fields) {
  PoseMessage pose;
  pose.stamp = read_header(fields).stamp;
  pose.child = fields.text();
  const auto t = fields.doubles<3>();
  const auto q = fields.doubles<4>();  // x, y, z, w
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!std::isfinite(t[0] + t[1] + t[2]) || !(std::abs(norm - 1) < 1e-2)) throw Error("holds no pose");
  pose.world_from_child.rotation = SO3<double>::from_quaternion(q[3], q[0], q[1], q[2]);
  pose.world_from_child.translation = {t[0], t[1], t[2]};
  return pose;
}

}  // namespace sslam::io
