// SPDX-License-Identifier: BSD-3-Clause
// Bags of ROS 2 in SQLite (.db3): a table of topics, and one of messages. Readers of bags link no library:
// who calls them brings what reads a database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/bags/bag_file.hpp"
#include "sslam/io/bags/record_sink.hpp"

namespace sslam::io {

inline constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

struct DatabaseMessage {
  std::int64_t id = 0, topic = 0;  // as the tables number them
  std::int64_t logged = 0;         // nanoseconds
  std::string_view data;           // until the next one is asked for
};

// All throw Error, in a few words, where the file is damaged.
class BagDatabase {
 public:
  BagDatabase() = default;
  BagDatabase(const BagDatabase&) = delete;
  BagDatabase& operator=(const BagDatabase&) = delete;
  virtual ~BagDatabase() = default;

  // By their ids; types as ROS 2 writes them.
  [[nodiscard]] virtual std::vector<std::pair<std::int64_t, BagChannel>> topics() = 0;
  // In the order in which they were recorded; empty: there are no more.
  [[nodiscard]] virtual std::optional<DatabaseMessage> next() = 0;
  // Reads the data of the message with this id into `out`; false where there is no such message.
  [[nodiscard]] virtual bool read(std::int64_t id, std::string& out) = 0;
};

// Throws Error, in a few words, where the file is no such bag.
using OpenBagDatabase = std::unique_ptr<BagDatabase> (*)(const std::filesystem::path& path);

namespace database_detail {

// Messages that the recorder packed one by one are frames of Zstandard, which no message looks like.
[[nodiscard]] inline bool is_zstd(std::string_view data) noexcept {
  return data.starts_with("\x28\xb5\x2f\xfd");
}

// What the frame's head says (RFC 8878, 3.1.1.1); empty: nothing.
[[nodiscard]] inline std::optional<std::uint64_t> unpacked_size(std::string_view frame) noexcept {
  constexpr std::size_t kMagic = 4;
  if (frame.size() <= kMagic) return {};
  const auto flags = static_cast<unsigned char>(frame[kMagic]);
  const bool single_segment = (flags & 0x20U) != 0;
  const unsigned size_flag = flags >> 6U, dictionary_flag = flags & 3U;
  if (size_flag == 0 && !single_segment) return {};
  const std::size_t at = kMagic + 1 + (single_segment ? 0 : 1) + (dictionary_flag == 3 ? 4 : dictionary_flag);
  const std::size_t bytes = std::size_t{1} << size_flag;
  if (frame.size() < at + bytes) return {};
  std::uint64_t size = 0;
  for (std::size_t i = bytes; i-- > 0;) size = size << 8U | static_cast<unsigned char>(frame[at + i]);
  return size_flag == 1 ? size + 256 : size;
}

// False: it cannot be unpacked. `packed` and `out` are others.
[[nodiscard]] inline bool unpack_message(std::string_view packed, const ChunkCodec& codec, std::string& out) {
  const auto size = unpacked_size(packed);
  return size && *size <= kLargestChunk &&
         codec.unpack(Packing::kZstd, packed, static_cast<std::size_t>(*size), out);
}

}  // namespace database_detail

// The bytes of a message, unpacked. False: it is not there, or damaged.
[[nodiscard]] inline bool read_database_message(BagDatabase& database, std::int64_t id,
                                                const ChunkCodec& codec, std::string& scratch,
                                                std::string& out) {
  if (!database.read(id, out)) return false;
  if (!database_detail::is_zstd(out)) return true;
  out.swap(scratch);
  return database_detail::unpack_message(scratch, codec, out);
}

// Tells `sink` of all that can be read.
template <RecordSink Sink>
void read_bag_database(BagDatabase& database, std::uint16_t number, const ChunkCodec& codec, Sink& sink) {
  std::map<std::int64_t, std::uint32_t> channels;
  for (auto& [id, channel] : database.topics()) {
    const auto [at, added] = channels.try_emplace(id, static_cast<std::uint32_t>(channels.size()));
    channel.type = plain_type(channel.type);
    if (added) sink.channel(at->second, channel);
  }
  std::string bytes;
  std::uint64_t last = 0;
  try {
    while (const auto message = database.next()) {
      last = static_cast<std::uint64_t>(message->id);
      const auto channel = channels.find(message->topic);
      if (channel == channels.end()) continue;
      std::string_view data = message->data;
      if (database_detail::is_zstd(data)) {
        if (!database_detail::unpack_message(data, codec, bytes)) {
          sink.damaged_chunk(last);
          continue;
        }
        data = bytes;
      }
      ChunkPlace place{last, message->data.size(), data.size(), 0, number, Packing::kNone};
      place.in_database = true;
      sink.message({channel->second,
                    {sink.chunk(place), 0, static_cast<std::uint32_t>(data.size())},
                    message->logged,
                    data});
    }
  } catch (const Error& error) {
    sink.broken(last, error.what());
  }
}

}  // namespace sslam::io
