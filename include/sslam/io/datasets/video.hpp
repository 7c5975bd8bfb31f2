// SPDX-License-Identifier: BSD-3-Clause
// A video file. Its frames are known only to who decodes it, and are filled in then.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "sslam/io/datasets/dataset.hpp"

namespace sslam::io {

[[nodiscard]] inline Dataset read_video(const std::filesystem::path& file) {
  Dataset dataset;
  dataset.layout = Layout::kVideo;
  dataset.root = file;
  return dataset;
}

// frame_rate in frames a second, as the container says. Stamps are index / frame_rate.
inline void fill_video_frames(Dataset& dataset, std::int64_t count, double frame_rate) {
  if (count < 1) throw Error(dataset.root.string() + ": the video holds no frame");
  if (!std::isfinite(frame_rate) || frame_rate <= 0)
    throw Error(dataset.root.string() + ": the video has no frame rate");
  dataset.frames.clear();
  for (std::int64_t i = 0; i < count; ++i) {
    FrameEntry frame;
    frame.index = i;
    frame.stamp = static_cast<double>(i) / frame_rate;
    frame.image = dataset.root.string();
    dataset.frames.push_back(std::move(frame));
  }
}

}  // namespace sslam::io
