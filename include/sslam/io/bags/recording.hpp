// SPDX-License-Identifier: BSD-3-Clause
// What a recording holds that is of use: its topics with images, where each message lies, cameras and poses.
// A recording is a bag of ROS 1, an MCAP file, an SQLite file of ROS 2, or a folder as ROS 2 writes it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/bags/bag_database.hpp"
#include "sslam/io/bags/bag_file.hpp"
#include "sslam/io/bags/mcap.hpp"
#include "sslam/io/bags/messages.hpp"
#include "sslam/io/bags/ros1_bag.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

struct BagMessage {
  MessagePlace place;
  std::int64_t stamp = 0;   // nanoseconds, by its header; 0: it has none
  std::int64_t logged = 0;  // nanoseconds, when the recorder got it
};

enum class BagKind : std::uint8_t { kOther, kImage, kCompressedImage, kCameraInfo, kChildPose };

struct BagTopic {
  std::string name;
  std::string type;  // and how it is written, where that is not ROS's way
  BagKind kind = BagKind::kOther;
  Wire wire = Wire::kRos1;
  std::size_t unreadable = 0;  // messages whose fields end too early
  std::string problem;         // of the first of them

  // Of images: by the first message.
  std::vector<BagMessage> messages;
  std::string encoding;  // or the format of compressed ones
  std::string frame;
  std::uint32_t width = 0, height = 0;  // 0: compressed

  std::optional<CameraInfoMessage> camera;               // the first
  std::map<std::string, Trajectory, std::less<>> poses;  // by whose they are

  [[nodiscard]] bool has_images() const noexcept {
    return kind == BagKind::kImage || kind == BagKind::kCompressedImage;
  }
};

struct BagRecording {
  std::vector<std::filesystem::path> files;
  std::vector<ChunkPlace> chunks;
  std::vector<BagTopic> topics;
  Warnings warnings;
};

namespace bag_detail {

[[nodiscard]] inline BagKind kind_of(const std::string& type) {
  if (type == "sensor_msgs/Image") return BagKind::kImage;
  if (type == "sensor_msgs/CompressedImage") return BagKind::kCompressedImage;
  if (type == "sensor_msgs/CameraInfo") return BagKind::kCameraInfo;
  if (type == "geometry_msgs/TransformStamped" || type == "nav_msgs/Odometry") return BagKind::kChildPose;
  return BagKind::kOther;
}

// The sink of all files of a recording.
class Collector {
 public:
  explicit Collector(BagRecording& recording) : recording_(recording) {}

  void begin_file(const std::filesystem::path& file, bool database) {
    file_ = file;
    database_ = database;
    topic_of_.clear();
    damaged_ = 0;
    packing_.clear();
  }

  void end_file() {
    if (damaged_ > 0)
      recording_.warnings.push_back(file_.string() + ": a damaged " +
                                    (database_ ? "message, id " : "chunk at byte ") +
                                    std::to_string(first_damaged_) +
                                    (damaged_ > 1 ? " and " + std::to_string(damaged_ - 1) + " more" : "") +
                                    (database_ ? ": it is left out" : ": what is in it is left out"));
    if (!packing_.empty())
      recording_.warnings.push_back(file_.string() + ": chunks that are packed as " + packing_ +
                                    " are left out; read are lz4, zstd, bz2 and none");
  }

  std::uint32_t chunk(const ChunkPlace& chunk) {
    demand_room(recording_.chunks.size());
    recording_.chunks.push_back(chunk);
    return static_cast<std::uint32_t>(recording_.chunks.size() - 1);
  }

  void channel(std::uint32_t number, const BagChannel& channel) {
    constexpr std::size_t kMostTopics = 1U << 16U, kLongestName = 1U << 12U;
    if (channel.topic.size() > kLongestName || channel.type.size() > kLongestName) return;  // nobody's
    if (topic_of_.size() > kMostTopics) throw TooMany("has more than 65536 topics");
    const auto [known, added] =
        topics_.try_emplace({channel.topic, channel.type, channel.encoding}, recording_.topics.size());
    topic_of_[number] = known->second;
    if (!added) return;
    const bool ros = channel.encoding == "cdr" || channel.encoding == "ros1";
    BagTopic topic;
    topic.name = shown_word(channel.topic);
    topic.type = shown_word(channel.type);
    if (!ros && !channel.encoding.empty()) topic.type += " in " + shown_word(channel.encoding);
    topic.wire = channel.encoding == "cdr" ? Wire::kCdr : Wire::kRos1;
    topic.kind = ros ? kind_of(channel.type) : BagKind::kOther;
    recording_.topics.push_back(std::move(topic));
  }

  void message(const BagRecord& record) {
    const auto found = topic_of_.find(record.channel);
    if (found == topic_of_.end()) return;
    BagTopic& topic = recording_.topics[found->second];
    if (topic.kind == BagKind::kOther) return;
    try {
      take(topic, record);
    } catch (const Error& error) {
      if (topic.unreadable++ == 0) topic.problem = error.what();
    }
  }

  void damaged_chunk(std::uint64_t at) {
    if (damaged_++ == 0) first_damaged_ = at;
  }

  void unknown_packing(std::string_view name) {
    if (packing_.empty()) packing_ = name.empty() ? "nothing known" : shown_word(name);
  }

  void broken(std::uint64_t at, const std::string& what) {
    recording_.warnings.push_back(file_.string() + ": " + what +
                                  (database_ ? " after message " : " at byte ") + std::to_string(at) +
                                  ": what stands before is used");
  }

 private:
  static void demand_room(std::size_t size) {
    constexpr std::size_t kMost = 20'000'000;
    if (size >= kMost) throw TooMany("has more than 20 million messages");
  }

  // Not one that is counted and passed over.
  struct TooMany : std::runtime_error {
    using std::runtime_error::runtime_error;
  };

  void take(BagTopic& topic, const BagRecord& record) {
    const MessageFields fields(topic.wire, record.data);
    if (topic.has_images()) {
      demand_room(topic.messages.size());
      MessageFields copy = fields;
      topic.messages.push_back({record.place, read_header(copy).stamp, record.logged});
      if (topic.encoding.empty()) describe(topic, fields);
    } else if (topic.kind == BagKind::kCameraInfo) {
      if (!topic.camera) topic.camera = read_camera_info(fields);
    } else {
      const PoseMessage pose = read_child_pose(fields);
      const std::string child = shown_word(pose.child);
      constexpr std::size_t kMostFrames = 1000;
      if (topic.poses.size() >= kMostFrames && topic.poses.find(child) == topic.poses.end())
        throw Error("has the poses of more than 1000 frames");
      Trajectory& poses = topic.poses[child];
      demand_room(poses.size());
      poses.push_back({seconds_of(pose.stamp), pose.world_from_child});
    }
  }

  static void describe(BagTopic& topic, const MessageFields& fields) {
    if (topic.kind == BagKind::kCompressedImage) {
      const CompressedImageMessage image = read_compressed_image(fields);
      topic.encoding = shown_word(image.format);
      topic.frame = shown_word(image.header.frame);
      return;
    }
    const ImageMessage image = read_image_message(fields);
    topic.encoding = shown_word(image.encoding);
    topic.frame = shown_word(image.header.frame);
    topic.width = image.width;
    topic.height = image.height;
  }

  BagRecording& recording_;
  std::filesystem::path file_;
  bool database_ = false;  // with messages that have ids, rather than bytes
  std::map<std::array<std::string, 3>, std::size_t> topics_;  // by name, type and encoding
  std::map<std::uint32_t, std::size_t> topic_of_;             // by the number of a channel of this file
  std::size_t damaged_ = 0;
  std::uint64_t first_damaged_ = 0;
  std::string packing_;  // of the first chunk that nobody can unpack; empty: there is none
};

static_assert(RecordSink<Collector>);

}  // namespace bag_detail

// Throws Error, in one line, when a file is no bag, or so far from one that nothing can be read.
// `open_database`: null refuses bags in SQLite.
[[nodiscard]] inline BagRecording read_recording(const std::vector<std::filesystem::path>& files,
                                                 const ChunkCodec& codec,
                                                 OpenBagDatabase open_database = nullptr) {
  BagRecording recording;
  recording.files = files;
  bag_detail::Collector collector(recording);
  for (std::size_t i = 0; i < files.size(); ++i) {
    BagFile file(files[i]);
    std::string magic;
    const auto number = static_cast<std::uint16_t>(i);
    const auto begins = [&](std::string_view with) {
      return file.read(0, with.size(), magic) && magic == with;
    };
    const bool database = begins(kSqliteMagic);
    collector.begin_file(files[i], database);
    try {
      if (begins(kRos1Magic)) {
        read_ros1_bag(file, number, codec, collector);
      } else if (begins(kMcapMagic)) {
        read_mcap(file, number, codec, collector);
      } else if (database) {
        if (open_database == nullptr)
          throw Error("is in SQLite, which is not read here; `ros2 bag convert` makes an MCAP file of it");
        read_bag_database(*open_database(files[i]), number, codec, collector);
      } else {
        if (begins("#ROSBAG V1")) throw Error("is of format 1; convert it with `rosbag fix`");
        throw Error("is neither a ROS 1 bag (#ROSBAG V2.0) nor an MCAP file nor one in SQLite");
      }
    } catch (const std::runtime_error& error) {
      throw Error(files[i].string() + ": " + error.what());
    }
    collector.end_file();
  }
  return recording;
}

}  // namespace sslam::io
