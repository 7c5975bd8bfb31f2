// SPDX-License-Identifier: BSD-3-Clause
// MCAP, the recordings of ROS 2 and of Foxglove (mcap.dev/spec): the records, and how to read a file from the
// first to the last, with or without an index at its end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"
#include "sslam/io/bags/bag_file.hpp"
#include "sslam/io/bags/record_sink.hpp"
#include "sslam/io/maps/byte_archive.hpp"

namespace sslam::io {

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum McapOp : unsigned char {
  kMcapHeader = 1,
  kMcapFooter = 2,
  kMcapSchema = 3,
  kMcapChannel = 4,
  kMcapMessage = 5,
  kMcapChunk = 6,
  kMcapMessageIndex = 7,
  kMcapChunkIndex = 8,
  kMcapStatistics = 11,
  kMcapSummaryOffset = 14,
  kMcapDataEnd = 15,
};

namespace mcap_detail {

inline constexpr std::uint64_t kRecordHead = 9;  // op, length
inline constexpr std::uint64_t kLongestRecord = 1U
                                                << 24U;  // of those that are no chunk, message or attachment

template <class T>
[[nodiscard]] T number(ByteReader& reader) {
  T value{};
  reader(value);
  return value;
}

[[nodiscard]] inline std::string_view text(ByteReader& reader) {
  return reader.take(number<std::uint32_t>(reader));
}

// The schemas of a file, and what is told of its records. Throws Error where a record is damaged.
template <RecordSink Sink>
class Records {
 public:
  explicit Records(Sink& sink) : sink_(sink) {}

  // A record that is no chunk; the content of a message lies at `begin` in `chunk`.
  void read(unsigned char op, std::string_view content, std::uint32_t chunk, std::uint64_t begin) {
    ByteReader reader(content);
    if (op == kMcapSchema) {
      const auto id = number<std::uint16_t>(reader);
      schemas_[id] = plain_type(text(reader));
    } else if (op == kMcapChannel) {
      const auto id = number<std::uint16_t>(reader), schema = number<std::uint16_t>(reader);
      BagChannel channel;
      channel.topic = text(reader);
      channel.encoding = text(reader);
      if (const auto found = schemas_.find(schema); found != schemas_.end()) channel.type = found->second;
      sink_.channel(id, channel);
    } else if (op == kMcapMessage) {
      BagRecord record;
      record.channel = number<std::uint16_t>(reader);
      (void)number<std::uint32_t>(reader);  // sequence
      record.logged = static_cast<std::int64_t>(number<std::uint64_t>(reader));
      (void)number<std::uint64_t>(reader);  // published
      record.data = reader.left();
      const std::size_t head = content.size() - record.data.size();
      record.place = {chunk, static_cast<std::uint32_t>(begin + head),
                      static_cast<std::uint32_t>(record.data.size())};
      sink_.message(record);
    }
  }

  void read_all(std::string_view bytes, std::uint32_t chunk) {
    ByteReader reader(bytes);
    while (!reader.left().empty()) {
      const auto op = number<unsigned char>(reader);
      const auto size = number<std::uint64_t>(reader);
      const std::size_t begin = bytes.size() - reader.left().size();
      read(op, reader.take(size), chunk, begin);
    }
  }

 private:
  Sink& sink_;
  std::map<std::uint16_t, std::string> schemas_;
};

// Thrown where nobody knows how a chunk is packed.
struct UnknownPacking {
  std::string name;
};

// What stands in front of a chunk's records. Throws Error where it ends too early.
[[nodiscard]] inline ChunkPlace chunk_at(BagFile& file, std::uint64_t at, std::uint64_t size,
                                         std::uint16_t number_of_file) {
  constexpr std::uint64_t kHead = 8 + 8 + 8 + 4 + 4, kLongestName = 16;
  std::string head;
  if (!file.read(at, std::min(size, kHead + kLongestName + 8), head)) throw Error("ends too early");
  ByteReader reader(head);
  (void)number<std::uint64_t>(reader);  // times of the first and the last message
  (void)number<std::uint64_t>(reader);
  ChunkPlace chunk;
  chunk.file = number_of_file;
  chunk.size = number<std::uint64_t>(reader);
  chunk.crc = number<std::uint32_t>(reader);
  const std::string_view name = text(reader);
  chunk.packed = number<std::uint64_t>(reader);
  chunk.begin = at + (head.size() - reader.left().size());
  chunk.packing = name == "lz4" ? Packing::kLz4 : name == "zstd" ? Packing::kZstd : Packing::kNone;
  if (!name.empty() && chunk.packing == Packing::kNone) throw UnknownPacking{std::string(name)};
  return chunk;
}

}  // namespace mcap_detail

// Tells `sink` of all that can be read. The file begins with kMcapMagic.
template <RecordSink Sink>
void read_mcap(BagFile& file, std::uint16_t number, const ChunkCodec& codec, Sink& sink) {
  namespace detail = mcap_detail;
  detail::Records<Sink> records(sink);
  std::string head, scratch, bytes;
  for (std::uint64_t at = kMcapMagic.size();;) {
    if (at >= file.size()) return sink.broken(at, "no index: its recorder was stopped");
    if (!file.read(at, detail::kRecordHead, head)) return sink.broken(at, "no record");
    ByteReader reader(head);
    const auto op = detail::number<unsigned char>(reader);
    const auto size = detail::number<std::uint64_t>(reader);
    const std::uint64_t begin = at + detail::kRecordHead;
    if (op == kMcapDataEnd) return;
    if (op == 0) return sink.broken(at, "no record");
    if (!file.has(begin, size)) return sink.broken(at, "a record without its end");
    try {
      if (op == kMcapChunk) {
        const ChunkPlace chunk = detail::chunk_at(file, begin, size, number);
        if (!read_chunk(file, chunk, codec, scratch, bytes)) throw Error("damaged");
        records.read_all(bytes, sink.chunk(chunk));
      } else if (op == kMcapMessage ||
                 ((op == kMcapSchema || op == kMcapChannel) && size < detail::kLongestRecord)) {
        const ChunkPlace alone{begin, size, size, 0, number, Packing::kNone};
        if (!read_chunk(file, alone, codec, scratch, bytes)) throw Error("damaged");
        records.read(op, bytes, op == kMcapMessage ? sink.chunk(alone) : 0, 0);
      }
    } catch (const detail::UnknownPacking& packing) {
      sink.unknown_packing(packing.name);
    } catch (const Error&) {
      sink.damaged_chunk(at);
    }
    at = begin + size;
  }
}

}  // namespace sslam::io
