// SPDX-License-Identifier: BSD-3-Clause
// What lies beside stored normals, so that --normals files:DIR knows how to read them.
#pragma once

#include <filesystem>

#include "sslam/io/output_file.hpp"
#include "sslam/opencv/normal_picture.hpp"

namespace sslam::cli {

// Says that the images in `folder` are encode_normal's.
inline void write_normal_encoding(const std::filesystem::path& folder) {
  io::OutputFile encoding(folder / "encoding.txt");
  encoding.stream() << kNormalEncoding << '\n';
  encoding.commit();
}

}  // namespace sslam::cli
