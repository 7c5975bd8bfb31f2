// SPDX-License-Identifier: BSD-3-Clause
// A list of the map that everybody reads and the map alone changes, through ObservationLinks: an observation
// stands in two of them, and they stay in step.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam {

class ObservationLinks;
template <Scalar S>
struct Keyframe;
struct LandmarkCommon;

template <class T>
class MapList {
 public:
  MapList() = default;
  MapList(const MapList&) = default;
  MapList(MapList&&) noexcept = default;
  ~MapList() = default;

  [[nodiscard]] const std::vector<T>& values() const noexcept { return values_; }
  operator const std::vector<T>&() const noexcept { return values_; }

  [[nodiscard]] auto begin() const noexcept { return values_.begin(); }
  [[nodiscard]] auto end() const noexcept { return values_.end(); }
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  [[nodiscard]] bool empty() const noexcept { return values_.empty(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] const T& front() const { return values_.front(); }
  [[nodiscard]] const T& back() const { return values_.back(); }
  friend bool operator==(const MapList& a, const std::vector<T>& b) { return a.values_ == b; }

 private:
  friend class ObservationLinks;
  template <Scalar S>
  friend struct Keyframe;
  friend struct LandmarkCommon;
  friend struct MapDoor;

  MapList& operator=(const MapList&) = default;
  MapList& operator=(MapList&&) noexcept = default;

  std::vector<T> values_;
};

// The way in for what makes a map from outside, a file say, and checks it when it is whole (io::check_map).
struct MapDoor {
  template <class T>
  [[nodiscard]] static std::vector<T>& open(MapList<T>& list) noexcept {
    return list.values_;
  }
};

}  // namespace sslam
