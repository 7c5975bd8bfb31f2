// SPDX-License-Identifier: BSD-3-Clause
// --record: what a run is given, kept as a dataset in the layout of TUM that `sslam run` tracks in the same
// way.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/stream/live_source.hpp"
#include "sslam/opencv/camera/camera_keys.hpp"

namespace sslam::cli {

class Recording {
 public:
  // Makes the folder. Throws Error when it cannot be written to, or holds something already.
  explicit Recording(std::filesystem::path folder);

  // The camera of the images, for who reads them.
  void keep_camera(const CameraFile& camera);

  // As it comes: what stands in the folder is a dataset at any time. An image's file is kept as it is, other
  // images as PNG. When it cannot be written, the recording ends, and `warning` says so.
  void add(double stamp, const SourceFrame& frame, std::string& warning);

 private:
  void write(double stamp, const SourceFrame& frame);

  std::filesystem::path folder_;
  std::ofstream list_;
  bool over_ = false;
};

}  // namespace sslam::cli
