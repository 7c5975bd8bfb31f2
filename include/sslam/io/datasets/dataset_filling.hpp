// SPDX-License-Identifier: BSD-3-Clause
// What the readers of all layouts do with the frames and the ground truth that they have found: put them in
// order, leave out what is not there, and give each frame its pose.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/evaluation/same_clock.hpp"
#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

// Says why a ground truth that lies in the dataset is not used. Tracking needs none: no reason to refuse.
inline void leave_truth_out(Dataset& dataset, std::string why) {
  dataset.ground_truth.clear();
  for (FrameEntry& frame : dataset.frames) frame.truth = -1;
  dataset.truth_problem = std::move(why);
  dataset.warnings.push_back(dataset.truth_problem + "; ground truth left out");
}

// What `attach` finds of the ground truth is given to the frames; one that it refuses by an Error is left
// out.
template <class Attach>
void attach_or_leave_out(Dataset& dataset, Attach attach) {
  try {
    attach();
  } catch (const Error& error) {
    leave_truth_out(dataset, error.what());
  }
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
  attach_or_leave_out(dataset, [&] {
    Trajectory truth = read_trajectory(file, dataset.warnings);
    if (mirrored) mirror_y(truth);
    attach_ground_truth(dataset, std::move(truth), file);
  });
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

// Lists that were filled up to a steady rate name images again: a camera that seems to stand.
inline void tell_repeated_images(Dataset& dataset, const std::filesystem::path& source) {
  std::unordered_set<std::string_view> seen;
  std::size_t again = 0;
  std::string_view first;
  for (const FrameEntry& frame : dataset.frames)
    if (!seen.insert(frame.image).second && again++ == 0) first = frame.image;
  constexpr std::size_t kOf = 10;  // one by mistake does no harm
  if (kOf * again > dataset.frames.size())
    dataset.warnings.push_back(source.string() + ": " + std::to_string(again) +
                               " frames have an image that another one has, too, the first " +
                               std::string(first));
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
  tell_repeated_images(dataset, source);
  for (std::size_t i = 0; i < dataset.frames.size(); ++i)
    dataset.frames[i].index = static_cast<std::int64_t>(i);
}

// The images that a list names.
inline void take_listed_frames(Dataset& dataset, std::vector<StampedFile> files,
                               const std::filesystem::path& list) {
  for (StampedFile& file : files) {
    FrameEntry frame;
    frame.stamp = file.stamp;
    frame.image = std::move(file.file);
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, list);
}

}  // namespace sslam::io
