// SPDX-License-Identifier: BSD-3-Clause
// Bags by hand, as the formats' documents have them, so that each part of one can be wrong.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/bag.hpp"

namespace sslam::made_bags {

template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string with_length(const std::string& text) {
  return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

// A packing that the tests understand: the bytes from the last to the first.
inline const io::ChunkCodec& backwards() {
  static constexpr io::ChunkCodec kCodec{
      [](io::Packing, std::string_view packed, std::size_t size, std::string& out) {
        out.assign(packed.rbegin(), packed.rend());
        return out.size() == size;
      },
      [](io::Packing, std::string_view bytes) { return std::string(bytes.rbegin(), bytes.rend()); },
      [](std::string_view bytes) {
        std::uint32_t sum = 1;
        for (const unsigned char byte : bytes) sum = sum * 31 + byte;
        return sum;
      }};
  return kCodec;
}

// ROS 1.

inline std::string header_1(double seconds, const std::string& frame = "optical") {
  const auto whole = static_cast<std::uint32_t>(seconds);
  return bytes_of(std::uint32_t{0}) + bytes_of(whole) +
         bytes_of(static_cast<std::uint32_t>((seconds - whole) * 1e9)) + with_length(frame);
}

// Of 2x1 pixels.
inline std::string image_1(double seconds, const std::string& encoding = "mono8",
                           const std::string& pixels = "ab") {
  return header_1(seconds) + bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{2}) + with_length(encoding) +
         '\0' + bytes_of(static_cast<std::uint32_t>(pixels.size())) + with_length(pixels);
}

inline std::string camera_1(double fx, const std::string& frame = "optical") {
  std::string text = header_1(0, frame) + bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{2}) +
                     with_length("plumb_bob") + bytes_of(std::uint32_t{1}) + bytes_of(0.25);
  for (const double v : {fx, 0.0, 1.0, 0.0, fx, 0.5, 0.0, 0.0, 1.0}) text += bytes_of(v);
  for (int i = 0; i < 9; ++i) text += bytes_of(0.0);
  for (const double v : {fx + 1, 0.0, 1.0, 0.0, 0.0, fx + 1, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0})
    text += bytes_of(v);
  return text;
}

inline std::string pose_1(double seconds, double x, const std::string& child = "optical") {
  std::string text = header_1(seconds, "room") + with_length(child);
  for (const double v : {x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) text += bytes_of(v);
  return text;
}

inline std::string record_1(const std::vector<std::pair<std::string, std::string>>& fields,
                            const std::string& data) {
  std::string header;
  for (const auto& [name, value] : fields) header += with_length(name + "=" + value);
  return with_length(header) + with_length(data);
}

inline std::string connection_1(std::uint32_t number, const std::string& topic, const std::string& type) {
  return record_1({{"op", "\x07"}, {"conn", bytes_of(number)}, {"topic", topic}},
                  with_length("topic=" + topic) + with_length("type=" + type));
}

// Logged at second 7.
inline std::string message_1(std::uint32_t connection, const std::string& data) {
  return record_1({{"op", "\x02"}, {"conn", bytes_of(connection)}, {"time", bytes_of(std::uint64_t{7})}},
                  data);
}

inline std::string chunk_1(const std::string& records, const std::string& compression = "none") {
  const bool packed = compression != "none";
  return record_1({{"op", "\x05"},
                   {"compression", compression},
                   {"size", bytes_of(static_cast<std::uint32_t>(records.size()))}},
                  packed ? std::string(records.rbegin(), records.rend()) : records);
}

inline std::string bag_1(const std::string& records, bool closed = true) {
  const std::uint64_t index = closed ? 4117 : 0;
  return std::string(io::kRos1Magic) + record_1({{"op", "\x03"}, {"index_pos", bytes_of(index)}}, "    ") +
         records;
}

// MCAP.

inline std::string record(io::McapOp op, const std::string& content) {
  return static_cast<char>(op) + bytes_of(static_cast<std::uint64_t>(content.size())) + content;
}

inline std::string channel(std::uint16_t number, const std::string& topic, const std::string& type,
                           const std::string& encoding = "cdr") {
  return record(io::kMcapSchema,
                bytes_of(number) + with_length(type) + with_length("ros2msg") + with_length("")) +
         record(io::kMcapChannel, bytes_of(number) + bytes_of(number) + with_length(topic) +
                                      with_length(encoding) + with_length(""));
}

inline std::string message(std::uint16_t number, const std::string& data) {
  return record(io::kMcapMessage, bytes_of(number) + bytes_of(std::uint32_t{0}) +
                                      bytes_of(std::uint64_t{7'000'000'000}) + bytes_of(std::uint64_t{0}) +
                                      data);
}

inline std::string chunk(const std::string& records, const std::string& compression, std::uint32_t crc) {
  const std::string packed = compression.empty() ? records : std::string(records.rbegin(), records.rend());
  return record(io::kMcapChunk, bytes_of(std::uint64_t{0}) + bytes_of(std::uint64_t{0}) +
                                    bytes_of(static_cast<std::uint64_t>(records.size())) + bytes_of(crc) +
                                    with_length(compression) +
                                    bytes_of(static_cast<std::uint64_t>(packed.size())) + packed);
}

inline std::string mcap(const std::string& records, bool closed = true) {
  return std::string(io::kMcapMagic) + record(io::kMcapHeader, with_length("ros2") + with_length("")) +
         records + (closed ? record(io::kMcapDataEnd, bytes_of(std::uint32_t{0})) : "");
}

// An image of 2x1 pixels in CDR, whose text of three bytes and their zero need no padding.
inline std::string image_2(std::int32_t seconds, bool big_endian = false) {
  const auto number = [&](std::uint32_t value) {
    const std::string text = bytes_of(value);
    return big_endian ? std::string(text.rbegin(), text.rend()) : text;
  };
  using namespace std::string_literals;
  return (big_endian ? "\0\0\0\0"s : "\0\1\0\0"s) + number(static_cast<std::uint32_t>(seconds)) + number(5) +
         number(4) + "cam\0"s + number(1) + number(2) + number(6) + "mono8\0"s + "\0"s + "\0"s + number(2) +
         number(2) + "ab";
}

inline io::Dataset read(const std::filesystem::path& path, const std::string& bytes,
                        const io::BagTopics& topics = {}) {
  std::ofstream(path, std::ios::binary) << bytes;
  io::Dataset dataset = io::unread_bag(path);
  io::fill_bag_frames(dataset, topics, backwards());
  return dataset;
}

}  // namespace sslam::made_bags
