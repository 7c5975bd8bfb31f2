// SPDX-License-Identifier: BSD-3-Clause
// The trajectory, kept relative to reference keyframes: when mapping moves a keyframe, its frames move along.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
struct TrajectoryEntry {
  std::int64_t index = -1;  // position in the dataset
  double stamp = 0;         // seconds
  KeyframeId reference = kNone;
  bool bridged = false;  // between two poses, by its turn alone: not held by the map
  SE3<S> frame_from_reference;
};

template <Scalar S>
class TrajectoryLog {
 public:
  void add(const Map<S>& map, std::int64_t index, double stamp, KeyframeId reference,
           const SE3<S>& cam_from_world) {
    entries_.push_back({index, stamp, reference, false, cam_from_world * map.pose(reference).inverse()});
  }

  // As another log has it, of the same map.
  void add(const TrajectoryEntry<S>& entry) { entries_.push_back(entry); }

  // In the order of the dataset.
  void sort() { std::stable_sort(entries_.begin(), entries_.end(), earlier); }

  // Of a sorted log: the frame's entry, or null.
  [[nodiscard]] const TrajectoryEntry<S>* find(std::int64_t index) const noexcept {
    const auto at = position(index);
    return at != entries_.end() && at->index == index ? &*at : nullptr;
  }

  // Of a sorted log: the frame's pose is this one.
  void set(const Map<S>& map, std::int64_t index, double stamp, KeyframeId reference,
           const SE3<S>& cam_from_world, bool bridged = false) {
    const TrajectoryEntry<S> entry{index, stamp, reference, bridged,
                                   cam_from_world * map.pose(reference).inverse()};
    const auto at = entries_.begin() + (position(index) - entries_.cbegin());
    if (at != entries_.end() && at->index == index)
      *at = entry;
    else
      entries_.insert(at, entry);
  }

  // Entries for which `gone(entry)` is true go; how many they were.
  template <class Gone>
  std::size_t withdraw(Gone gone) {
    return std::erase_if(entries_, gone);
  }

  // Keyframes have moved by similarities: distances from them are multiplied by scale_at(keyframe).
  template <class ScaleAt>
  void follow(ScaleAt scale_at) {
    for (TrajectoryEntry<S>& entry : entries_)
      entry.frame_from_reference.translation *= scale_at(entry.reference);
  }

  // The other log's map has become part of this one's: what is added to its keyframes' ids, and what its
  // lengths are multiplied by. A frame that both have stays as it is here.
  void append(const TrajectoryLog& other, std::int32_t shift, S scale) {
    std::vector<std::int64_t> known;
    for (const TrajectoryEntry<S>& entry : entries_) known.push_back(entry.index);
    std::sort(known.begin(), known.end());
    for (TrajectoryEntry<S> entry : other.entries_) {
      if (std::binary_search(known.begin(), known.end(), entry.index)) continue;
      entry.reference += shift;
      entry.frame_from_reference.translation *= scale;
      entries_.push_back(entry);
    }
  }

  // cam_from_world of an entry, by its keyframe's pose as it is now.
  [[nodiscard]] static SE3<S> pose(const Map<S>& map, const TrajectoryEntry<S>& entry) {
    return entry.frame_from_reference * map.pose(entry.reference);
  }

  // Stamps of the bridged ones, in order.
  [[nodiscard]] std::vector<double> bridged() const {
    std::vector<double> stamps;
    for (const TrajectoryEntry<S>& entry : entries_)
      if (entry.bridged) stamps.push_back(entry.stamp);
    std::sort(stamps.begin(), stamps.end());
    return stamps;
  }

  [[nodiscard]] const std::vector<TrajectoryEntry<S>>& entries() const noexcept { return entries_; }
  void clear() noexcept { entries_.clear(); }

 private:
  static bool earlier(const TrajectoryEntry<S>& a, const TrajectoryEntry<S>& b) noexcept {
    return a.index < b.index;
  }
  [[nodiscard]] auto position(std::int64_t index) const noexcept {
    return std::lower_bound(entries_.begin(), entries_.end(), TrajectoryEntry<S>{index, 0, kNone, false, {}},
                            earlier);
  }

  std::vector<TrajectoryEntry<S>> entries_;
};

}  // namespace sslam
