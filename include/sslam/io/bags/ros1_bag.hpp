// SPDX-License-Identifier: BSD-3-Clause
// Bags of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0). Read from the first record to the last, so that a
// bag without an index is no other case.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "sslam/io/bags/bag_file.hpp"
#include "sslam/io/bags/record_sink.hpp"

namespace sslam::io {

inline constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";

namespace ros1_detail {

enum Op : unsigned char { kMessage = 2, kBagHeader = 3, kChunk = 5, kConnection = 7 };

// Longer ones have no field that is known.
inline constexpr std::uint32_t kLongestHeader = 1U << 20U;
inline constexpr std::uint32_t kLongestDefinition = 1U << 24U;

// The number at the front; 0 where there are fewer bytes.
template <class T>
[[nodiscard]] T number_of(std::string_view bytes) noexcept {
  T value = 0;
  if (bytes.size() >= sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

// Fields `name=value`, each with its length in front. Empty: no field has this name.
[[nodiscard]] inline std::string_view field_of(std::string_view header, std::string_view name) noexcept {
  while (header.size() >= 4) {
    const auto length = number_of<std::uint32_t>(header);
    header.remove_prefix(4);
    if (length > header.size()) break;
    const std::string_view field = header.substr(0, length);
    header.remove_prefix(length);
    if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
      return field.substr(name.size() + 1);
  }
  return {};
}

[[nodiscard]] inline unsigned char op_of(std::string_view header) noexcept {
  return number_of<unsigned char>(field_of(header, "op"));
}

[[nodiscard]] inline std::uint32_t connection_of(std::string_view header) noexcept {
  return number_of<std::uint32_t>(field_of(header, "conn"));
}

[[nodiscard]] inline std::int64_t time_of(std::string_view header) noexcept {
  const std::string_view time = field_of(header, "time");
  if (time.size() < 8) return 0;
  return std::int64_t{number_of<std::uint32_t>(time)} * 1'000'000'000 +
         number_of<std::uint32_t>(time.substr(4));
}

template <RecordSink Sink>
void tell_connection(std::string_view header, std::string_view data, Sink& sink) {
  sink.channel(connection_of(header),
               {std::string(field_of(header, "topic")), std::string(field_of(data, "type")), "ros1"});
}

// The records in a chunk. False: it is damaged.
template <RecordSink Sink>
bool read_records(std::string_view chunk, std::uint32_t number, Sink& sink) {
  std::size_t at = 0;
  const auto take = [&](std::string_view& out) {
    if (chunk.size() - at < 4) return false;
    const auto length = number_of<std::uint32_t>(chunk.substr(at));
    if (chunk.size() - at - 4 < length) return false;
    out = chunk.substr(at + 4, length);
    at += 4 + std::size_t{length};
    return true;
  };
  while (at < chunk.size()) {
    std::string_view header, data;
    if (!take(header) || !take(data)) return false;
    if (op_of(header) == kConnection) tell_connection(header, data, sink);
    if (op_of(header) != kMessage) continue;
    const auto size = static_cast<std::uint32_t>(data.size());
    sink.message({connection_of(header),
                  {number, static_cast<std::uint32_t>(at) - size, size},
                  time_of(header),
                  data});
  }
  return true;
}

struct Record {
  std::string header;
  std::uint64_t begin = 0;  // of its data in the file
  std::uint32_t size = 0;
};

// False: there is no whole header at `at`.
[[nodiscard]] inline bool read_record(BagFile& file, std::uint64_t at, Record& record, std::string& scratch) {
  if (!file.read(at, 4, scratch)) return false;
  const auto length = number_of<std::uint32_t>(scratch);
  if (length > kLongestHeader || !file.read(at + 4, length, record.header)) return false;
  if (!file.read(at + 4 + length, 4, scratch)) return false;
  record.size = number_of<std::uint32_t>(scratch);
  record.begin = at + 8 + length;
  return true;
}

// What a chunk's header says of how it is packed. False: in a way that nobody knows.
[[nodiscard]] inline bool packing_of(std::string_view header, Packing& packing) noexcept {
  const std::string_view name = field_of(header, "compression");
  packing = name == "bz2" ? Packing::kBzip2 : name == "lz4" ? Packing::kLz4 : Packing::kNone;
  return name == "none" || packing != Packing::kNone;
}

}  // namespace ros1_detail

// Tells `sink` of all that can be read. The file begins with kRos1Magic.
template <RecordSink Sink>
void read_ros1_bag(BagFile& file, std::uint16_t number, const ChunkCodec& codec, Sink& sink) {
  namespace detail = ros1_detail;
  detail::Record record;
  std::string scratch, bytes;
  std::uint64_t at = kRos1Magic.size();
  bool closed = false;
  while (at < file.size()) {
    if (!detail::read_record(file, at, record, scratch)) return sink.broken(at, "no record");
    const unsigned char op = detail::op_of(record.header);
    ChunkPlace chunk{record.begin, record.size, record.size, 0, number, Packing::kNone};
    // An unpacked chunk that has lost its end is worth as much as there is of it.
    const bool whole = file.has(record.begin, record.size);
    if (!whole) chunk.packed = chunk.size = file.size() - record.begin;
    if (op == detail::kBagHeader)
      closed = detail::number_of<std::uint64_t>(detail::field_of(record.header, "index_pos")) != 0;
    if (op == detail::kConnection && record.size <= detail::kLongestDefinition &&
        file.read(record.begin, record.size, bytes)) {
      detail::tell_connection(record.header, bytes, sink);
    } else if (op == detail::kMessage && whole && read_chunk(file, chunk, codec, scratch, bytes)) {
      sink.message({detail::connection_of(record.header),
                    {sink.chunk(chunk), 0, record.size},
                    detail::time_of(record.header),
                    bytes});
    } else if (op == detail::kChunk) {
      const bool known = detail::packing_of(record.header, chunk.packing);
      if (chunk.packing != Packing::kNone)
        chunk.size = detail::number_of<std::uint32_t>(detail::field_of(record.header, "size"));
      if (!known) sink.unknown_packing(detail::field_of(record.header, "compression"));
      const bool sound = known && read_chunk(file, chunk, codec, scratch, bytes) &&
                         detail::read_records(bytes, sink.chunk(chunk), sink);
      if (known && !sound && whole) sink.damaged_chunk(at);
    }
    if (!whole) return sink.broken(at, "a record without its end");
    at = record.begin + record.size;
  }
  if (!closed) sink.broken(at, "no index: its recorder was stopped");
}

}  // namespace sslam::io
