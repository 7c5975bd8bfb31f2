// SPDX-License-Identifier: BSD-3-Clause
// What every dataset reader answers: a list of frames with their files and the ground truth. Nothing is
// decoded here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sslam/io/datasets/increasing.hpp"
#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

enum class Layout { kTum, kIclNuim, kSevenScenes, kImages, kVideo };

// Small: a long recording has many, and all of them are at hand as long as it runs. A std::filesystem::path
// would keep its parts beside its text.
struct FrameEntry {
  std::int64_t index = 0;     // position in the whole sequence, before any slice; the frame number of a video
  double stamp = 0;           // the dataset's own
  std::string image;          // path; the video itself for a video
  std::string depth;          // path; empty: none
  std::ptrdiff_t truth = -1;  // position in the dataset's ground truth; -1: none
};

struct Dataset {
  Layout layout = Layout::kImages;
  std::filesystem::path root;         // folder of the sequence, or the video
  std::vector<FrameEntry> frames;     // increasing stamps; empty for a video until fill_video_frames
  Trajectory ground_truth;            // all of it, on its own clock, in our camera axes; empty: none
  double seconds_per_stamp = 1;       // ICL-NUIM stamps count frames
  std::optional<double> video_start;  // time of a video's first frame on its own clock; empty: it has none
  std::string name_hint;              // text that may name the recording, for the built-in calibrations
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

// Gives each frame the pose nearest in time. Throws Error when no frame gets one: a ground truth on another
// clock is a mistake to hear of before the run.
inline void attach_ground_truth(Dataset& dataset, Trajectory truth, const std::filesystem::path& source) {
  const std::vector<double> stamps = frame_stamps(dataset);
  const std::vector<double> truth_stamps = stamps_of(truth);
  const std::vector<StampPair> pairs = associate(stamps, truth_stamps, kMaxStampDifference);
  if (pairs.empty() && !stamps.empty()) {
    throw Error(source.string() + ": no overlap with the images: its stamps go from " +
                exact_decimal(truth_stamps.front()) + " to " + exact_decimal(truth_stamps.back()) +
                ", theirs from " + exact_decimal(stamps.front()) + " to " + exact_decimal(stamps.back()) +
                "; correct or remove it");
  }
  for (const StampPair& pair : pairs) dataset.frames[pair.a].truth = static_cast<std::ptrdiff_t>(pair.b);
  dataset.ground_truth = std::move(truth);
}

// Keeps the frames whose image is there and whose stamps increase; a few others are skipped with a warning
// each. `source` is the list or the folder that named them.
inline void drop_bad_frames(Dataset& dataset, const std::filesystem::path& source) {
  const std::size_t total = dataset.frames.size();
  BadEntries bad(source);
  std::vector<FrameEntry> present;
  std::vector<double> stamps;
  for (FrameEntry& frame : dataset.frames) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(frame.image, ignored)) {
      bad.add("names " + frame.image + ", which is not there");
      continue;
    }
    stamps.push_back(frame.stamp);
    present.push_back(std::move(frame));
  }
  const std::vector<bool> keep = keep_increasing(stamps);
  dataset.frames.clear();
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (keep[i]) {
      dataset.frames.push_back(std::move(present[i]));
    } else {
      bad.add("stamp " + exact_decimal(present[i].stamp) + " of " + present[i].image +
              " goes backwards or repeats; stamps must increase");
    }
  }
  bad.settle(total, dataset.warnings);
  for (std::size_t i = 0; i < dataset.frames.size(); ++i)
    dataset.frames[i].index = static_cast<std::int64_t>(i);
}

}  // namespace sslam::io
