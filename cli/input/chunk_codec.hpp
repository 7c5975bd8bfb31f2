// SPDX-License-Identifier: BSD-3-Clause
// How chunks of bags are packed and unpacked here: by libarchive, which knows LZ4, Zstandard and bzip2.
#pragma once

#include "sslam/io/bags/chunk_codec.hpp"

namespace sslam::cli {

[[nodiscard]] const io::ChunkCodec& chunk_codec();

}  // namespace sslam::cli
