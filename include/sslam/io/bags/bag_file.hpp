// SPDX-License-Identifier: BSD-3-Clause
// A bag as bytes: pieces of the file, and the chunks in which messages lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "sslam/core/error.hpp"
#include "sslam/io/bags/chunk_codec.hpp"

namespace sslam::io {

// Of a chunk, packed or not. Recorders write less than a MiB, or one image.
inline constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;

class BagFile {
 public:
  // Throws Error when it cannot be opened.
  explicit BagFile(std::filesystem::path path) : path_(std::move(path)), stream_(path_, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(path_, error);
    if (error || !stream_) throw Error(path_.string() + ": cannot open this bag");
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] bool has(std::uint64_t at, std::uint64_t size) const noexcept {
    return at <= size_ && size <= size_ - at;
  }

  // Into `out`, in the place of what is there. False: the file ends before, or cannot be read.
  [[nodiscard]] bool read(std::uint64_t at, std::uint64_t size, std::string& out) {
    if (!has(at, size)) return false;
    out.resize(static_cast<std::size_t>(size));
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(at));
    return static_cast<bool>(stream_.read(out.data(), static_cast<std::streamsize>(size)));
  }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

// A run of records in a file. A message that lies in no chunk is one by itself.
struct ChunkPlace {
  std::uint64_t begin = 0;   // of the packed bytes in the file; in a database, the message's id
  std::uint64_t packed = 0;  // bytes there
  std::uint64_t size = 0;    // unpacked
  std::uint32_t crc = 0;     // of the unpacked bytes; 0: none
  std::uint16_t file = 0;    // of the recording
  Packing packing = Packing::kNone;
  bool in_database = false;
};

struct MessagePlace {
  std::uint32_t chunk = 0;  // of the recording's
  std::uint32_t begin = 0;  // in its unpacked bytes
  std::uint32_t size = 0;
};

// False: it is larger than a chunk may be, or damaged. `scratch` and `out` are used again from one to the
// next.
[[nodiscard]] inline bool read_chunk(BagFile& file, const ChunkPlace& chunk, const ChunkCodec& codec,
                                     std::string& scratch, std::string& out) {
  if (chunk.packed > kLargestChunk || chunk.size > kLargestChunk) return false;
  const bool plain = chunk.packing == Packing::kNone;
  if (plain && chunk.packed != chunk.size) return false;
  if (!file.read(chunk.begin, chunk.packed, plain ? out : scratch)) return false;
  if (!plain && !codec.unpack(chunk.packing, scratch, static_cast<std::size_t>(chunk.size), out))
    return false;
  return chunk.crc == 0 || codec.crc32(out) == chunk.crc;
}

}  // namespace sslam::io
