// SPDX-License-Identifier: BSD-3-Clause
// What the nodes for ROS 1 and ROS 2 have in common: a System that gets its camera by message, and the fields
// of messages, which have the same names in both. C++17, and nothing of sslam's: headers of ROS 1 are none of
// C++20's.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sslam_ros {

struct NodeSettings {
  std::string preset = "structure";
  std::string model;           // manifest of a network of surface normals; empty: lines alone
  std::string load, save;      // map to go on in, and to write at the end; empty: none
  bool live = true;            // mapping in a thread of its own: tracking never waits for it
  bool localise_only = false;  // the map stays as it is; wants `load`
  std::vector<std::pair<std::string, double>> set;  // such as "lines.merge.max_gap", 4
};

// As sensor_msgs has them.
struct CameraInfo {
  std::uint32_t width = 0, height = 0;  // pixels
  std::string model;
  std::vector<double> d;
  std::array<double, 9> k{};
};
struct Image {
  const std::vector<std::uint8_t>& data;
  std::uint32_t width, height, step;
  const std::string& encoding;
};

// Of the camera's optical frame in a world with z up; the map's unit.
struct Pose {
  std::array<double, 3> place{};
  std::array<double, 4> turn{0, 0, 0, 1};  // quaternion x y z w
};
struct StampedPose {
  double seconds = 0;
  Pose pose;
};

// What came of an image.
struct Tracked {
  std::optional<Pose> pose;  // none that is uncertain: the messages have no place for how far it may be off
  std::string state;         // such as "manhattan", "lost: too few matches"
  bool map_changed = false;  // and with it the path, since the last image
};

// Everything that throws, throws a std::exception whose what() is one line.
class SlamNode {
 public:
  // Throws when the preset, a parameter or the model is none.
  explicit SlamNode(NodeSettings settings);
  ~SlamNode();
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

  [[nodiscard]] bool has_camera() const;

  // Throws where it was not calibrated, or has a lens that is not taken.
  void take_camera(const CameraInfo& info);

  // `seconds`: the image's stamp. Wants a camera. Throws for an encoding that is not taken, or fewer bytes
  // than the image claims.
  [[nodiscard]] Tracked track(const Image& image, double seconds);

  [[nodiscard]] std::vector<StampedPose> path() const;
  [[nodiscard]] std::vector<std::array<float, 3>> points() const;

  // No more images come. Throws when the map cannot be written.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

[[nodiscard]] inline std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(static_cast<long double>(seconds) * 1e9L + 0.5L);
}

// Fields of geometry_msgs/Pose and geometry_msgs/Transform.
template <class Place, class Turn>
void fill_pose(const Pose& pose, Place& place, Turn& turn) {
  place.x = pose.place[0];
  place.y = pose.place[1];
  place.z = pose.place[2];
  turn.x = pose.turn[0];
  turn.y = pose.turn[1];
  turn.z = pose.turn[2];
  turn.w = pose.turn[3];
}

// sensor_msgs/PointCloud2 but for its header.
template <class Cloud>
void fill_cloud(const std::vector<std::array<float, 3>>& points, Cloud& cloud) {
  constexpr std::uint8_t kFloat = 7;
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  cloud.fields.resize(kNames.size());
  std::uint32_t offset = 0;
  for (std::size_t i = 0; i < kNames.size(); ++i, offset += sizeof(float)) {
    cloud.fields[i].name = kNames[i];
    cloud.fields[i].offset = offset;
    cloud.fields[i].datatype = kFloat;
    cloud.fields[i].count = 1;
  }
  cloud.data.resize(points.size() * offset);
  if (!points.empty()) std::memcpy(cloud.data.data(), points.data(), cloud.data.size());
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.point_step = offset;
  cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
  cloud.is_bigendian = false;
  cloud.is_dense = true;
}

}  // namespace sslam_ros
