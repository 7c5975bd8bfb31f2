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

#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/evaluation/same_clock.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

enum class Layout {
  kTum,
  kEuroc,
  kKitti,
  kReplica,
  kScanNet,
  kSevenScenes,
  kIclNuim,
  kTransforms,
  kColourDepth,
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

// Says why a ground truth that lies in the dataset is not used. Tracking needs none: no reason to refuse.
inline void leave_truth_out(Dataset& dataset, std::string why) {
  dataset.ground_truth.clear();
  for (FrameEntry& frame : dataset.frames) frame.truth = -1;
  dataset.truth_problem = std::move(why);
  dataset.warnings.push_back(dataset.truth_problem + "; ground truth left out");
}

// Gives each frame the pose nearest in time. A ground truth on another clock is left out with a warning.
inline void attach_ground_truth(Dataset& dataset, Trajectory truth, const std::filesystem::path& source) {
  const std::vector<double> stamps = frame_stamps(dataset);
  if (truth.empty()) return leave_truth_out(dataset, source.string() + ": holds no pose");
  if (const StampUnit unit = unit_on_clock(stamps, stamps_of(truth), kMaxStampDifference);
      !unit.is_seconds()) {
    for (StampedPose& pose : truth) pose.stamp /= unit.per_second;
    dataset.warnings.push_back(source.string() + ": " + unit_note(unit));
  }
  const std::vector<double> truth_stamps = stamps_of(truth);
  const std::vector<StampPair> pairs = associate(stamps, truth_stamps, kMaxStampDifference);
  if (pairs.empty() && !stamps.empty()) {
    return leave_truth_out(dataset, source.string() + ": no overlap with the images: its stamps go from " +
                                        exact_decimal(truth_stamps.front()) + " to " +
                                        exact_decimal(truth_stamps.back()) + ", theirs from " +
                                        exact_decimal(stamps.front()) + " to " +
                                        exact_decimal(stamps.back()));
  }
  for (const StampPair& pair : pairs) dataset.frames[pair.a].truth = static_cast<std::ptrdiff_t>(pair.b);
  dataset.ground_truth = std::move(truth);
}

// As above, from a file; one that cannot be read is left out too. `mirrored`: its poses have y up.
inline void attach_truth_file(Dataset& dataset, const std::filesystem::path& file, bool mirrored = false) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return;
  try {
    Trajectory truth = read_trajectory(file, dataset.warnings);
    if (mirrored) mirror_y(truth);
    attach_ground_truth(dataset, std::move(truth), file);
  } catch (const Error& error) {
    leave_truth_out(dataset, error.what());
  }
}

// Sorts by stamp; of equal stamps the first in the list is kept.
inline void order_frames(Dataset& dataset, const std::filesystem::path& source) {
  std::vector<FrameEntry>& frames = dataset.frames;
  const auto earlier = [](const FrameEntry& a, const FrameEntry& b) { return a.stamp < b.stamp; };
  if (!std::is_sorted(frames.begin(), frames.end(), earlier)) {
    const auto back = std::is_sorted_until(frames.begin(), frames.end(), earlier);
    dataset.warnings.push_back(source.string() + ": stamps go backwards at " + exact_decimal(back->stamp) +
                               ": images sorted by stamp");
    std::stable_sort(frames.begin(), frames.end(), earlier);
  }
  const auto same = [](const FrameEntry& a, const FrameEntry& b) { return a.stamp == b.stamp; };
  const auto repeated = std::adjacent_find(frames.begin(), frames.end(), same);
  if (repeated == frames.end()) return;
  const double stamp = repeated->stamp;
  const std::size_t before = frames.size();
  frames.erase(std::unique(frames.begin(), frames.end(), same), frames.end());
  if (frames.size() == 1)
    throw Error(source.string() + ": all " + std::to_string(before) + " images have the stamp " +
                exact_decimal(stamp) + "; stamps must increase");
  dataset.warnings.push_back(source.string() + ": " + std::to_string(before - frames.size()) +
                             " repeated stamps, the first at " + exact_decimal(stamp) +
                             ": the first image of each is kept");
}

// Keeps the frames whose image is there, by increasing stamps; a few others are skipped with a warning
// each. `source` is the list or the folder that named them.
inline void drop_bad_frames(Dataset& dataset, const std::filesystem::path& source) {
  const std::size_t total = dataset.frames.size();
  BadEntries bad(source);
  std::vector<FrameEntry> present;
  for (FrameEntry& frame : dataset.frames) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(frame.image, ignored)) {
      present.push_back(std::move(frame));
    } else {
      bad.add("names " + frame.image + ", which is not there");
    }
  }
  bad.settle(total, dataset.warnings);
  dataset.frames = std::move(present);
  order_frames(dataset, source);
  for (std::size_t i = 0; i < dataset.frames.size(); ++i)
    dataset.frames[i].index = static_cast<std::int64_t>(i);
}

}  // namespace sslam::io
