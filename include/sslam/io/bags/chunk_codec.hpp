// SPDX-License-Identifier: BSD-3-Clause
// How chunks of bags are packed. Readers and writers of bags link no library: who calls them brings this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sslam::io {

// As both formats have them: LZ4 frames, Zstandard frames, bzip2.
enum class Packing : std::uint8_t { kNone, kLz4, kZstd, kBzip2 };

struct ChunkCodec {
  // `packed` holds exactly `size` bytes; into `out`, in the place of what is there. False: it does not.
  bool (*unpack)(Packing packing, std::string_view packed, std::size_t size, std::string& out);
  // Throws Error where this machine cannot.
  std::string (*pack)(Packing packing, std::string_view bytes);
  // CRC-32 as of zlib and Ethernet.
  std::uint32_t (*crc32)(std::string_view bytes);
};

}  // namespace sslam::io
