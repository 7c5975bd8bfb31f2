// SPDX-License-Identifier: BSD-3-Clause
// An observation stands twice: the keyframe's feature names the landmark, and the landmark names the feature.
// Here both are written together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/map/id_shift.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

// For the map alone, which has more to keep in step with them. `seen`: a keyframe's landmarks of one kind.
class ObservationLinks {
  template <Scalar S>
  friend class Map;

  template <Scalar S>
  using Seen = MapList<LandmarkId> Keyframe<S>::*;

  static void add(LandmarkId id, LandmarkCommon& landmark, KeyframeId keyframe, std::size_t feature,
                  MapList<LandmarkId>& seen) {
    seen.values_[feature] = id;
    landmark.observations.values_.push_back({keyframe, static_cast<std::int32_t>(feature)});
  }

  // Of a keyframe that names its landmarks already; what is gone, it sees no longer.
  template <class Landmarks>
  static void complete(KeyframeId keyframe, MapList<LandmarkId>& seen, Landmarks& landmarks) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i] == kNone) continue;
      auto& landmark = landmarks[index(seen[i])];
      if (landmark.alive)
        landmark.observations.values_.push_back({keyframe, static_cast<std::int32_t>(i)});
      else
        seen.values_[i] = kNone;
    }
  }

  // True when fewer than two are left.
  template <Scalar S>
  [[nodiscard]] static bool remove(LandmarkCommon& landmark, KeyframeId keyframe,
                                   std::vector<Keyframe<S>>& keyframes, Seen<S> seen) {
    auto& observations = landmark.observations.values_;
    const auto gone = std::find_if(observations.begin(), observations.end(),
                                   [&](const Observation& o) { return o.keyframe == keyframe; });
    if (gone == observations.end()) return false;
    (keyframes[index(keyframe)].*seen).values_[index(gone->feature)] = kNone;
    observations.erase(gone);
    return observations.size() < 2;
  }

  template <Scalar S>
  static void remove_all(LandmarkId id, LandmarkCommon& landmark, std::vector<Keyframe<S>>& keyframes,
                         Seen<S> seen) {
    for (const Observation& o : landmark.observations) {
      LandmarkId& slot = (keyframes[index(o.keyframe)].*seen).values_[index(o.feature)];
      if (slot == id) slot = kNone;
    }
    landmark.observations.values_.clear();
    landmark.observations.values_.shrink_to_fit();
  }

  // Both halves, of a map that becomes part of another.
  template <Scalar S>
  static void shift(Keyframe<S>& keyframe, const IdShift& by) {
    by.apply_to_matches(keyframe.point_landmarks.values_, keyframe.line_landmarks.values_);
  }
  static void shift(LandmarkCommon& landmark, const IdShift& by) {
    for (Observation& o : landmark.observations.values_) o.keyframe += by.keyframes;
  }

  [[nodiscard]] static constexpr std::size_t index(std::int32_t id) noexcept {
    return static_cast<std::size_t>(id);
  }
};

}  // namespace sslam
