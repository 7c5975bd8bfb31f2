// SPDX-License-Identifier: BSD-3-Clause
// What lies beside stored normals, so that --normals files:DIR knows how to read them.
#pragma once

#include <filesystem>

#include "sslam/io/files/output_file.hpp"
#include "sslam/opencv/normals/normal_picture.hpp"

namespace sslam::cli {

// Says that the images in `folder` are encode_normal's, and how far off their planes are.
inline void write_normal_encoding(const std::filesystem::path& folder, double plane_sigma_deg) {
  io::OutputFile encoding(folder / "encoding.txt");
  encoding.stream() << kNormalEncoding;
  if (plane_sigma_deg > 0) encoding.stream() << " plane_sigma_deg=" << plane_sigma_deg;
  encoding.stream() << '\n';
  encoding.commit();
}

}  // namespace sslam::cli
