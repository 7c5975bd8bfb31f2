// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --video FILE`: a video of the overlays of all frames, at the speed of the recording.
#pragma once

#include <filesystem>

#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/video/video_file.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

class OverlayVideo {
 public:
  // `camera` is that of the images. Throws io::Error when the video cannot be made.
  OverlayVideo(const std::filesystem::path& path, const io::Dataset& dataset, const Camera<double>& camera);

  void add(const FrameRecord& record, const FrameViewInput& view, const TrackedFrame<double>& frame);

  // Throws io::Error when not all of it could be written.
  void commit() { file_.commit(); }

 private:
  VideoFile file_;
};

}  // namespace sslam::cli
