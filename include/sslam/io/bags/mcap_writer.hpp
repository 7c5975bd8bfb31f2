// SPDX-License-Identifier: BSD-3-Clause
// MCAP for writing: messages in packed chunks, an index of each chunk and one of the file (mcap.dev/spec).
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/bags/chunk_codec.hpp"
#include "sslam/io/bags/mcap.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/maps/byte_archive.hpp"

namespace sslam::io {

class McapWriter {
 public:
  // Throws Error when the file cannot be written.
  McapWriter(const std::filesystem::path& path, const ChunkCodec& codec, std::string_view library)
      : file_(path), codec_(codec) {
    write(kMcapMagic);
    ByteWriter header;
    add_text(header, "ros2");
    add_text(header, library);
    write_record(kMcapHeader, header.bytes);
  }

  // Answers with the number of the topic's channel. `definition`: of the type, as of ros2msg.
  std::uint16_t add_topic(std::string_view topic, std::string_view type, std::string_view definition) {
    const auto number = static_cast<std::uint16_t>(counts_.size() + 1);
    ByteWriter schema, channel;
    schema(number);
    add_text(schema, type);
    add_text(schema, "ros2msg");
    add_text(schema, definition);
    channel(number);
    channel(number);
    add_text(channel, topic);
    add_text(channel, "cdr");
    add_text(channel, "");  // no metadata
    counts_[number] = 0;
    schemas_ += record(kMcapSchema, schema.bytes);
    channels_ += record(kMcapChannel, channel.bytes);
    chunk_ += record(kMcapSchema, schema.bytes) + record(kMcapChannel, channel.bytes);
    return number;
  }

  // `time`: nanoseconds. Messages of a channel come in the order of their times.
  void add(std::uint16_t channel, std::int64_t time, std::string_view message) {
    constexpr std::size_t kEnough = std::size_t{1} << 20;
    const auto stamp = static_cast<std::uint64_t>(time);
    ByteWriter content;
    content(channel);
    content(counts_[channel]++);
    content(stamp);
    content(stamp);
    content.bytes += message;
    entries_[channel].emplace_back(stamp, chunk_.size());
    chunk_ += record(kMcapMessage, content.bytes);
    first_ = std::min(first_, stamp);
    last_ = std::max(last_, stamp);
    if (chunk_.size() >= kEnough) end_chunk();
  }

  // Throws Error when it has not reached the file whole.
  void commit() {
    end_chunk();
    write_record(kMcapDataEnd, std::string(4, '\0'));  // without a checksum of all data: chunks have theirs
    write_summary();
    write(kMcapMagic);
    file_.commit();
  }

 private:
  using Entry = std::pair<std::uint64_t, std::uint64_t>;  // time, place in the chunk

  static void add_text(ByteWriter& to, std::string_view text) {
    to(static_cast<std::uint32_t>(text.size()));
    to.bytes += text;
  }

  [[nodiscard]] static std::string record(McapOp op, std::string_view content) {
    ByteWriter made;
    made(static_cast<unsigned char>(op));
    made(static_cast<std::uint64_t>(content.size()));
    return made.bytes.append(content);
  }

  void write(std::string_view bytes) {
    file_.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    at_ += bytes.size();
  }
  void write_record(McapOp op, std::string_view content) { write(record(op, content)); }

  void end_chunk() {
    if (chunk_.empty()) return;
    const std::string packed = codec_.pack(Packing::kZstd, chunk_);
    const bool any = !entries_.empty();
    const std::uint64_t begin = at_, size = chunk_.size(), first = any ? first_chunk_time() : 0;
    const std::uint64_t last = any ? last_chunk_time() : 0;
    ByteWriter chunk;
    chunk(first);
    chunk(last);
    chunk(size);
    chunk(codec_.crc32(chunk_));
    add_text(chunk, "zstd");
    chunk(static_cast<std::uint64_t>(packed.size()));
    chunk.bytes += packed;
    write_record(kMcapChunk, chunk.bytes);
    const std::uint64_t end = at_;
    ByteWriter places;
    for (const auto& [channel, entries] : entries_) {
      places(channel);
      places(at_);
      ByteWriter index;
      index(channel);
      index(static_cast<std::uint32_t>(entries.size() * 2 * sizeof(std::uint64_t)));
      for (const auto& [time, place] : entries) {
        index(time);
        index(place);
      }
      write_record(kMcapMessageIndex, index.bytes);
    }
    ByteWriter about;
    for (const std::uint64_t value : {first, last, begin, end - begin}) about(value);
    add_text(about, places.bytes);
    about(at_ - end);
    add_text(about, "zstd");
    about(static_cast<std::uint64_t>(packed.size()));
    about(size);
    chunk_indexes_ += record(kMcapChunkIndex, about.bytes);
    ++chunks_;
    chunk_.clear();
    entries_.clear();
  }

  [[nodiscard]] std::uint64_t first_chunk_time() const {
    std::uint64_t first = ~std::uint64_t{0};
    for (const auto& [channel, entries] : entries_) first = std::min(first, entries.front().first);
    return first;
  }
  [[nodiscard]] std::uint64_t last_chunk_time() const {
    std::uint64_t last = 0;
    for (const auto& [channel, entries] : entries_) last = std::max(last, entries.back().first);
    return last;
  }

  [[nodiscard]] std::string statistics() const {
    std::uint64_t messages = 0;
    ByteWriter counts;
    for (const auto& [channel, count] : counts_) {
      messages += count;
      counts(channel);
      counts(std::uint64_t{count});
    }
    ByteWriter made;
    made(messages);
    made(static_cast<std::uint16_t>(counts_.size()));    // schemas
    made(static_cast<std::uint32_t>(counts_.size()));    // channels
    for (int i = 0; i < 2; ++i) made(std::uint32_t{0});  // attachments, metadata
    made(chunks_);
    made(messages > 0 ? first_ : 0);
    made(last_);
    add_text(made, counts.bytes);
    return record(kMcapStatistics, made.bytes);
  }

  void write_summary() {
    const std::uint64_t begin = at_;
    ByteWriter all, offsets;
    const auto add = [&](McapOp op, const std::string& group) {
      ByteWriter offset;
      offset(static_cast<unsigned char>(op));
      offset(begin + all.bytes.size());
      offset(static_cast<std::uint64_t>(group.size()));
      offsets.bytes += record(kMcapSummaryOffset, offset.bytes);
      all.bytes += group;
    };
    add(kMcapSchema, schemas_);
    add(kMcapChannel, channels_);
    add(kMcapStatistics, statistics());
    add(kMcapChunkIndex, chunk_indexes_);
    const std::uint64_t offsets_begin = begin + all.bytes.size();
    all.bytes += offsets.bytes;
    // The checksum is of all that stands before it, from the summary's begin.
    ByteWriter footer;
    constexpr std::uint64_t kFooter = 8 + 8 + 4;
    footer(static_cast<unsigned char>(kMcapFooter));
    footer(kFooter);
    footer(begin);
    footer(offsets_begin);
    all.bytes += footer.bytes;
    all(codec_.crc32(all.bytes));
    write(all.bytes);
  }

  OutputFile file_;
  const ChunkCodec& codec_;
  std::uint64_t at_ = 0;  // bytes written
  std::string chunk_, schemas_, channels_, chunk_indexes_;
  std::map<std::uint16_t, std::vector<Entry>> entries_;  // of the messages in chunk_, by channel
  std::map<std::uint16_t, std::uint32_t> counts_;        // of all messages
  std::uint64_t first_ = ~std::uint64_t{0}, last_ = 0;
  std::uint32_t chunks_ = 0;
};

}  // namespace sslam::io
