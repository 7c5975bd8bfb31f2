// SPDX-License-Identifier: BSD-3-Clause
// What every dataset reader answers: a list of frames with their files and the ground truth. Nothing is
// decoded here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

inline constexpr double kDefaultFrameRate = 30;

struct OpenOptions {
  double frame_rate = kDefaultFrameRate;  // frames a second, for images whose names are no stamps
};

// Which topics of a bag to take; empty: found.
struct BagTopics {
  std::string images, depth;
};

enum class Layout {
  kTum,
  kEuroc,
  kKitti,
  kKittiRaw,
  kReplica,
  kScanNet,
  kSevenScenes,
  kIclNuim,
  kOpenLoris,
  kTartanAir,
  kUzhFpv,
  kArkitScenes,
  kTransforms,
  kColourDepth,
  kColmap,
  kTimedImages,
  kBag,
  kImages,
  kVideo,
  kStream
};

// Small: a long recording has many, and all of them are at hand as long as it runs. A std::filesystem::path
// would keep its parts beside its text.
struct FrameEntry {
  std::int64_t index =
      0;  // position in the whole sequence, before any slice; the frame number of a video or a stream
  double stamp = 0;           // the dataset's own
  std::string image;          // path; the video or the bag itself where it is one
  std::string depth;          // path, or the topic in a bag; empty: none
  std::ptrdiff_t truth = -1;  // position in the dataset's ground truth; -1: none
};

struct BagFrames;  // datasets/bag.hpp

struct Dataset {
  Layout layout = Layout::kImages;
  std::filesystem::path root;         // folder of the sequence, or the video, or the bag
  std::vector<FrameEntry> frames;     // increasing stamps; empty for videos and bags until they are filled in
  Trajectory ground_truth;            // all of it, on its own clock, in our camera axes; empty: none
  std::string truth_problem;          // why the ground truth that lies there is not used
  std::optional<double> video_start;  // time of a video's first frame on its own clock; empty: it has none
  double seconds_per_stamp = 1;       // ICL-NUIM stamps count frames
  std::filesystem::path camera_file;  // that the layout keeps at a place of its own; empty: none
  std::string camera_text;            // a camera file that is no file: what a bag says of it; empty: none
  std::string camera_source;          // where that stands, for people
  std::shared_ptr<const BagFrames> bag;  // where a bag's frames lie; null: it is none, or not filled in
  double depth_factor = 0;               // units of its depth images a metre, by the layout; 0: not known
  std::string name_hint;                 // text that may name the recording, for the built-in calibrations
  Warnings warnings;

  // The ground truth of a frame; null: none.
  [[nodiscard]] const SE3<double>* world_from_cam(const FrameEntry& frame) const noexcept {
    return frame.truth < 0 ? nullptr : &ground_truth[static_cast<std::size_t>(frame.truth)].world_from_cam;
  }
};

[[nodiscard]] inline std::vector<double> frame_stamps(const Dataset& dataset) {
  std::vector<double> stamps;
  stamps.reserve(dataset.frames.size());
  for (const FrameEntry& frame : dataset.frames) stamps.push_back(frame.stamp);
  return stamps;
}

// Part of a sequence: positions start <= i < end in steps of stride; a negative end means all.
struct Slice {
  std::int64_t start = 0;
  std::int64_t end = -1;
  std::int64_t stride = 1;
};

inline void apply_slice(Dataset& dataset, const Slice& slice) {
  if (slice.start < 0 || slice.stride < 1)
    throw Error("slice: start must be at least 0 and stride at least 1");
  const auto size = static_cast<std::int64_t>(dataset.frames.size());
  const std::int64_t end = slice.end < 0 ? size : std::min(slice.end, size);
  if (slice.start >= end) {
    throw Error(dataset.root.string() + ": no frame from " + std::to_string(slice.start) + " up to " +
                std::to_string(end) + "; the sequence has " + std::to_string(size));
  }
  const std::int64_t count = (end - slice.start - 1) / slice.stride + 1;
  std::vector<FrameEntry> kept;
  kept.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i)
    kept.push_back(std::move(dataset.frames[static_cast<std::size_t>(slice.start + i * slice.stride)]));
  dataset.frames = std::move(kept);
}

}  // namespace sslam::io
