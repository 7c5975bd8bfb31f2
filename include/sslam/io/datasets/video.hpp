// SPDX-License-Identifier: BSD-3-Clause
// A video file. Its frames are known only to who opens it, and are filled in then.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
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

inline void add_video_frame(Dataset& dataset, std::int64_t index, double stamp) {
  FrameEntry frame;
  frame.index = index;
  frame.stamp = stamp;
  frame.image = dataset.root.string();
  dataset.frames.push_back(std::move(frame));
}

// Frames at the times of the video's own clock, in order of display: stamps are seconds since the first. Of
// several frames at one time the first is kept.
inline void fill_video_frames(Dataset& dataset, std::span<const double> times) {
  if (times.empty()) throw Error(dataset.root.string() + ": the video holds no frame");
  dataset.frames.clear();
  dataset.video_start = times.front();
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double stamp = times[i] - times.front();
    if (i == 0 || stamp > dataset.frames.back().stamp)
      add_video_frame(dataset, static_cast<std::int64_t>(i), stamp);
  }
  const std::size_t repeats = times.size() - dataset.frames.size();
  if (repeats > 0)
    dataset.warnings.push_back(dataset.root.string() + ": " + std::to_string(repeats) +
                               " frames have the time of the frame before: left out");
}

// A video without times: stamps are index / frame_rate.
inline void fill_video_frames(Dataset& dataset, std::int64_t count, double frame_rate) {
  if (count < 1) throw Error(dataset.root.string() + ": the video holds no frame");
  if (!std::isfinite(frame_rate) || frame_rate <= 0)
    throw Error(dataset.root.string() + ": the video has neither times nor a frame rate");
  dataset.frames.clear();
  dataset.video_start.reset();
  for (std::int64_t i = 0; i < count; ++i) add_video_frame(dataset, i, static_cast<double>(i) / frame_rate);
}

}  // namespace sslam::io
