// SPDX-License-Identifier: BSD-3-Clause
// The frames of a recording of ROS, with their depth, the camera that it knows, and its own poses of the
// camera.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/bags/camera_text.hpp"
#include "sslam/io/bags/recording.hpp"
#include "sslam/io/datasets/bag_files.hpp"
#include "sslam/io/datasets/bag_topics.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// Where the messages of a dataset's frames lie.
struct BagFrames {
  struct Stream {
    BagKind kind = BagKind::kImage;
    Wire wire = Wire::kRos1;
    std::string topic;
    std::vector<MessagePlace> places;  // one a frame, by its index; of size 0: none
  };
  std::vector<std::filesystem::path> files;
  std::vector<ChunkPlace> chunks;
  Stream images, depth;
};

namespace bag_detail {

// Nanoseconds of each message. Drivers that set no stamps leave the recorder's.
[[nodiscard]] inline std::vector<double> image_stamps(const BagTopic& topic) {
  const bool stamped = std::any_of(topic.messages.begin(), topic.messages.end(),
                                   [](const BagMessage& m) { return m.stamp != 0; });
  std::vector<double> stamps;
  stamps.reserve(topic.messages.size());
  for (const BagMessage& m : topic.messages) stamps.push_back(seconds_of(stamped ? m.stamp : m.logged));
  return stamps;
}

// The frames, and their places in the order of their stamps.
inline void fill_frames(Dataset& dataset, const BagTopic& topic, BagFrames& bag) {
  const std::vector<double> stamps = image_stamps(topic);
  const std::string image = dataset.root.string();
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    FrameEntry frame;
    frame.index = static_cast<std::int64_t>(i);
    frame.stamp = stamps[i];
    frame.image = image;
    dataset.frames.push_back(std::move(frame));
  }
  if (topic.messages.front().stamp == 0 && topic.messages.back().stamp == 0)
    dataset.warnings.push_back(image + ": the images on " + topic.name +
                               " have no stamps: the times when they were recorded are taken");
  order_frames(dataset, dataset.root);
  bag.images = {topic.kind, topic.wire, topic.name, {}};
  for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
    const auto before = static_cast<std::size_t>(dataset.frames[i].index);
    bag.images.places.push_back(topic.messages[before].place);
    dataset.frames[i].index = static_cast<std::int64_t>(i);
  }
}

inline void fill_depth(Dataset& dataset, const BagTopic& topic, BagFrames& bag) {
  std::vector<std::pair<double, MessagePlace>> sorted;
  const std::vector<double> stamps = image_stamps(topic);
  for (std::size_t i = 0; i < stamps.size(); ++i) sorted.emplace_back(stamps[i], topic.messages[i].place);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> depth_stamps;
  depth_stamps.reserve(sorted.size());
  for (const auto& [stamp, place] : sorted) depth_stamps.push_back(stamp);
  bag.depth = {topic.kind, topic.wire, topic.name, std::vector<MessagePlace>(dataset.frames.size())};
  for (const StampPair& pair : associate(frame_stamps(dataset), depth_stamps, kMaxStampDifference)) {
    dataset.frames[pair.a].depth = topic.name;
    bag.depth.places[pair.a] = sorted[pair.b].second;
  }
  dataset.depth_factor = topic.encoding == "32FC1" ? 1 : 1000;  // REP 118
}

inline void fill_camera(Dataset& dataset, const BagRecording& recording, const BagTopic& images) {
  const BagTopic* const topic = camera_topic(recording, images);
  if (topic == nullptr) return;
  const std::string source = dataset.root.string() + " " + topic->name;
  if (topic->camera->k[0] == 0) {
    dataset.warnings.push_back(source + ": this camera was not calibrated");
    return;
  }
  const std::string_view base = base_of(images.name);
  const bool rectified = base.substr(base.rfind('/') + 1).starts_with("image_rect");
  dataset.camera_text = camera_text_of(*topic->camera, rectified);
  dataset.camera_source = source;
}

// Poses of the very frame that the images are of: any other one sits elsewhere, and nobody says where.
inline void fill_truth(Dataset& dataset, BagRecording& recording, const std::string& frame) {
  if (frame.empty()) return;
  const BagTopic* source = nullptr;
  Trajectory* poses = nullptr;
  for (BagTopic& topic : recording.topics) {
    const auto found = topic.poses.find(frame);
    if (found == topic.poses.end()) continue;
    if (poses != nullptr)
      return leave_truth_out(dataset, dataset.root.string() + ": has poses of " + frame + " on " +
                                          source->name + " and on " + topic.name);
    source = &topic;
    poses = &found->second;
  }
  if (poses == nullptr) return;
  sort_by_stamp(*poses);
  attach_ground_truth(dataset, std::move(*poses), dataset.root.string() + " " + source->name);
}

inline void tell_unreadable(Dataset& dataset, const BagTopic& topic) {
  if (topic.unreadable > 0)
    dataset.warnings.push_back(dataset.root.string() + ": " + std::to_string(topic.unreadable) +
                               " messages on " + topic.name + " are left out, the first " + topic.problem);
}

}  // namespace bag_detail

// Fills a dataset in that unread_bag has begun. Throws Error, in one line, where there is no bag, no images,
// or more than one topic with images and nobody says which.
// `open_database`: null refuses bags in SQLite.
inline void fill_bag_frames(Dataset& dataset, const BagTopics& wanted, const ChunkCodec& codec,
                            OpenBagDatabase open_database = nullptr) {
  namespace detail = bag_detail;
  BagRecording recording = read_recording(bag_files(dataset.root), codec, open_database);
  dataset.warnings = recording.warnings;
  if (const std::string missing = missing_parts(dataset.root); !missing.empty())
    dataset.warnings.push_back(missing);
  auto bag = std::make_shared<BagFrames>();
  const BagTopic& images = detail::image_topic(dataset, recording, wanted.images);
  detail::fill_frames(dataset, images, *bag);
  detail::tell_unreadable(dataset, images);
  if (const BagTopic* const depth = detail::depth_topic(dataset, recording, images, wanted.depth)) {
    detail::fill_depth(dataset, *depth, *bag);
    detail::tell_unreadable(dataset, *depth);
  }
  detail::fill_camera(dataset, recording, images);
  detail::fill_truth(dataset, recording, images.frame);
  bag->files = std::move(recording.files);
  bag->chunks = std::move(recording.chunks);
  dataset.bag = std::move(bag);
}

}  // namespace sslam::io
