// SPDX-License-Identifier: BSD-3-Clause
// `sslam run --video FILE`: a video of the overlays of all frames, at the speed of the recording.
#pragma once

#include <filesystem>

#include "cli/results/frame_view.hpp"
#include "cli/video/video_file.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

class OverlayVideo : public Observer {
 public:
  // `camera` is that of the images. Throws Error when the video cannot be made.
  OverlayVideo(const std::filesystem::path& path, const io::Dataset& dataset, const Camera<double>& camera);

  void frame_tracked(const FrameEvent& event) override;

  // Throws Error when not all of it could be written.
  void commit() { file_.commit(); }

 private:
  Camera<double> camera_;
  std::size_t rows_ = 0;  // frames so far
  VideoFile file_;
};

}  // namespace sslam::cli
