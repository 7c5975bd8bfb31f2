// SPDX-License-Identifier: BSD-3-Clause
// Which of a recording's topics belong to one camera: its images, their depth, its calibration. Nothing is
// guessed: where two would do, the user says which.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/bags/recording.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace bag_detail {

[[nodiscard]] inline bool is_compressed_depth(const BagTopic& topic) {
  return topic.encoding.find("compressedDepth") != std::string::npos;
}

// By what the drivers call them: images of 16 bit may as well be grey.
[[nodiscard]] inline bool is_depth(const BagTopic& topic) {
  const bool named = lower_case(topic.name).find("depth") != std::string::npos;
  const bool values = topic.encoding == "16UC1" || topic.encoding == "mono16";
  return is_compressed_depth(topic) || topic.encoding == "32FC1" ||
         (named && (values || topic.encoding.empty()));
}

[[nodiscard]] inline std::string described(const BagTopic& topic) {
  std::string text = topic.name + " (";
  if (topic.width > 0) text += std::to_string(topic.width) + "x" + std::to_string(topic.height) + " ";
  return text + topic.encoding.substr(0, 40) + ", " + std::to_string(topic.messages.size()) + " images)";
}

// The topic without what image_transport appends for another way to send the same images.
[[nodiscard]] inline std::string_view base_of(std::string_view topic) {
  for (const std::string_view transport : {"/compressed", "/compressedDepth"})
    if (topic.ends_with(transport)) return topic.substr(0, topic.size() - transport.size());
  return topic;
}

[[nodiscard]] inline std::string_view parent_of(std::string_view topic) {
  const std::size_t slash = base_of(topic).rfind('/');
  return slash == std::string_view::npos ? std::string_view() : topic.substr(0, slash);
}

[[nodiscard]] inline const BagTopic& topic_named(const std::string& root, const BagRecording& recording,
                                                 const std::string& name, const char* option) {
  std::string others;
  for (const BagTopic& topic : recording.topics) {
    if (!topic.has_images() || topic.messages.empty()) continue;
    if (topic.name == name) return topic;
    add_to_list(others, described(topic));
  }
  std::string own;
  for (const BagTopic& topic : recording.topics)
    if (topic.name == name) own = topic.has_images() ? ", it has no messages" : ", it has " + topic.type;
  throw Error(root + ": " + option + " " + name +
              " names no topic with images (sensor_msgs/Image, CompressedImage)" + own + "; there are " +
              (others.empty() ? "none" : others));
}

[[nodiscard]] inline std::string topic_list(const BagRecording& recording) {
  constexpr std::size_t kMost = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMost, recording.topics.size()); ++i)
    add_to_list(list, recording.topics[i].name + " (" + recording.topics[i].type + ")");
  return recording.topics.empty()          ? "it has no topics"
         : recording.topics.size() > kMost ? "its first topics are " + list
                                           : "its topics are " + list;
}

// The one camera in it. Where there are more, the user says which: nobody knows which of two eyes is meant.
[[nodiscard]] inline const BagTopic& image_topic(Dataset& dataset, const BagRecording& recording,
                                                 const std::string& wanted) {
  const std::string root = dataset.root.string();
  if (!wanted.empty()) return topic_named(root, recording, wanted, "--topic");
  std::vector<const BagTopic*> found;
  const BagTopic* depth = nullptr;
  for (const BagTopic& topic : recording.topics) {
    if (!topic.has_images() || topic.messages.empty()) continue;
    if (is_depth(topic))
      depth = &topic;
    else
      found.push_back(&topic);
  }
  // The same images in two ways: what was not packed has lost nothing.
  const auto sent_raw = [&](const BagTopic* topic) {
    return topic->kind == BagKind::kCompressedImage &&
           std::any_of(found.begin(), found.end(), [&](const BagTopic* other) {
             return other->kind == BagKind::kImage && other->name == base_of(topic->name);
           });
  };
  std::vector<const BagTopic*> cameras;
  std::copy_if(found.begin(), found.end(), std::back_inserter(cameras),
               [&](const BagTopic* topic) { return !sent_raw(topic); });
  if (cameras.empty())
    throw Error(root + ": holds no images" + (depth != nullptr ? " but depth" : "") +
                " (sensor_msgs/Image, CompressedImage); " + topic_list(recording) +
                (recording.warnings.empty() ? "" : "; " + recording.warnings.front()));
  if (cameras.size() > 1) {
    std::string list;
    for (const BagTopic* topic : cameras) add_to_list(list, described(*topic));
    throw Error(root + ": has " + std::to_string(cameras.size()) +
                " topics with images, say which with --topic: " + list);
  }
  return *cameras.front();
}

// Depth that belongs to the pixels of the images; null: none. Drivers call it aligned or registered where
// there is another one beside it.
[[nodiscard]] inline const BagTopic* depth_topic(Dataset& dataset, const BagRecording& recording,
                                                 const BagTopic& images, const std::string& wanted) {
  if (!wanted.empty()) return &topic_named(dataset.root.string(), recording, wanted, "--depth-topic");
  std::vector<const BagTopic*> found, registered;
  for (const BagTopic& topic : recording.topics) {
    if (!topic.has_images() || topic.messages.empty() || !is_depth(topic) || &topic == &images) continue;
    const bool same_size = topic.width == images.width && topic.height == images.height;
    if (topic.kind == BagKind::kImage && images.kind == BagKind::kImage && !same_size) continue;
    found.push_back(&topic);
    const std::string name = lower_case(topic.name);
    if (name.find("aligned") != std::string::npos || name.find("registered") != std::string::npos)
      registered.push_back(&topic);
  }
  const auto& from = registered.empty() ? found : registered;
  if (from.size() == 1) return from.front();
  if (from.size() > 1) {
    std::string list;
    for (const BagTopic* topic : from) add_to_list(list, described(*topic));
    dataset.warnings.push_back(
        dataset.root.string() +
        ": has several topics with depth, none is taken; --depth-topic says which: " + list);
  }
  return nullptr;
}

// The topic beside the images, else the one of the same frame; null: none.
[[nodiscard]] inline const BagTopic* camera_topic(const BagRecording& recording, const BagTopic& images) {
  const BagTopic* same_frame = nullptr;
  std::size_t of_frame = 0;
  for (const BagTopic& topic : recording.topics) {
    if (!topic.camera) continue;
    if (topic.name == std::string(parent_of(images.name)) + "/camera_info") return &topic;
    if (images.frame.empty() || topic.camera->frame != images.frame) continue;
    same_frame = &topic;
    ++of_frame;
  }
  return of_frame == 1 ? same_frame : nullptr;
}

}  // namespace bag_detail

}  // namespace sslam::io
