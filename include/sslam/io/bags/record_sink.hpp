// SPDX-License-Identifier: BSD-3-Clause
// What a reader of bags tells of a file, in the order in which it lies there.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sslam/io/bags/bag_file.hpp"

namespace sslam::io {

// Messages come on channels; numbers of channels count within a file.
struct BagChannel {
  std::string topic;
  std::string type;      // "sensor_msgs/Image", in ROS 2, too
  std::string encoding;  // "ros1", "cdr", or one of other programs
};

// "sensor_msgs/msg/Image", as ROS 2 calls it, by the name that ROS 1 has for it.
[[nodiscard]] inline std::string plain_type(std::string_view name) {
  std::string type(name);
  if (const std::size_t at = type.find("/msg/"); at != std::string::npos) type.erase(at, 4);
  return type;
}

// A message where its bytes are at hand.
struct BagRecord {
  std::uint32_t channel = 0;
  MessagePlace place;
  std::int64_t logged = 0;  // nanoseconds: when the recorder got it
  std::string_view data;
};

template <class S>
concept RecordSink = requires(S sink, std::uint32_t number, const BagChannel& channel,
                              const ChunkPlace& chunk, const BagRecord& record, std::uint64_t at,
                              const std::string& what, std::string_view packing) {
  // Answers with the number by which messages name it.
  { sink.chunk(chunk) } -> std::same_as<std::uint32_t>;
  sink.channel(number, channel);
  sink.message(record);
  // A chunk, or what stands in it, is damaged; the file goes on behind it. `at`: a byte, or a message's id in
  // a database.
  sink.damaged_chunk(at);
  // A chunk that is packed in a way that nobody here knows, by the name that it has in the file.
  sink.unknown_packing(packing);
  // The file cannot be read from here on.
  sink.broken(at, what);
};

}  // namespace sslam::io
