// SPDX-License-Identifier: BSD-3-Clause
// Ids of erased landmarks, for later ones: a map grows with what it holds, not with what it once held.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/map/landmark.hpp"

namespace sslam {

class FreeIds {
 public:
  void add(LandmarkId id) { ids_.push_back(id); }

  // Puts the landmark in a free place, else at the end; its id.
  template <class Landmark>
  LandmarkId settle(std::vector<Landmark>& landmarks, Landmark&& landmark) {
    if (ids_.empty()) {
      landmarks.push_back(std::forward<Landmark>(landmark));
      return static_cast<LandmarkId>(landmarks.size() - 1);
    }
    const LandmarkId id = ids_.back();
    ids_.pop_back();
    landmarks[static_cast<std::size_t>(id)] = std::forward<Landmark>(landmark);
    return id;
  }

  // Starts anew with landmarks that were filled in from outside.
  template <class Landmark>
  void collect(const std::vector<Landmark>& landmarks) {
    ids_.clear();
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      if (!landmarks[i].alive) add(static_cast<LandmarkId>(i));
  }

 private:
  std::vector<LandmarkId> ids_;
};

}  // namespace sslam
