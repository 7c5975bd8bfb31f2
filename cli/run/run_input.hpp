// SPDX-License-Identifier: BSD-3-Clause
// What a run takes its frames from: a dataset or a stream, the camera of its images, and which of their
// pixels count.
#pragma once

#include <optional>

#include "cli/input/camera_choice.hpp"
#include "cli/input/frame_stream.hpp"
#include "cli/input/mask_source.hpp"
#include "cli/results/frame_record.hpp"
#include "cli/run.hpp"
#include "cli/stream/live_source.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::cli {

struct RunInput {
  std::optional<LiveSource> source;  // of a stream
  io::Dataset dataset;               // frames of a stream join it
  CameraChoice camera;
  std::optional<WideView> view;  // of a lens that is too wide for a pinhole
  MaskSource masks;

  // Finds dataset and camera; what is to be told of the camera is printed. Of a stream, waits for the first
  // image, and settings.dataset becomes its name for people. Throws Error; Stop when interrupted.
  void open(RunSettings& settings);
  // View and masks, after open(). Throws Error.
  void choose_pixels(const RunSettings& settings);

  // For one pass through them. `recording` keeps what comes; null: nothing does.
  [[nodiscard]] FrameStreamOptions frames(Recording* recording);

  // What the frames turned out to be like, after the last: losses of a stream, and `normals` (as --normals
  // names them) that were of no use.
  void report(const std::string& normals, RunOutcome& outcome) const;
};

}  // namespace sslam::cli
