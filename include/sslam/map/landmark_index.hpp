// SPDX-License-Identifier: BSD-3-Clause
// What a map keeps in step with its landmarks of one kind, points or lines: which ids are free, and which
// landmarks may look like a descriptor.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/map/free_ids.hpp"
#include "sslam/map/look_index.hpp"

namespace sslam {

// The landmarks are the map's; a call that takes them is about the same list each time.
class LandmarkIndex {
 public:
  // Puts the landmark in a free place, else at the end; its id.
  template <class Landmark>
  LandmarkId settle(std::vector<Landmark>& landmarks, Landmark landmark) {
    return free_.settle(landmarks, std::move(landmark));
  }

  // The landmark looks like this from now on.
  template <class Landmark>
  void look_like(std::vector<Landmark>& landmarks, LandmarkId id, const Descriptor& descriptor) {
    landmarks[static_cast<std::size_t>(id)].descriptor = descriptor;
    looks_.set(id, descriptor);
  }

  // The landmark is dead from now on, and was alive until now.
  template <class Landmark>
  void bury(std::vector<Landmark>& landmarks, LandmarkId id) {
    landmarks[static_cast<std::size_t>(id)].alive = false;
    free_.add(id);
    looks_.remove(id);
  }

  // Starts anew with landmarks that were filled in from outside.
  template <class Landmark>
  void collect(const std::vector<Landmark>& landmarks) {
    looks_.forget();
    free_.collect(landmarks);
  }

  // Which landmarks may look like a descriptor. The first call takes all of them in.
  template <class Landmark>
  [[nodiscard]] const LookIndex& looks(const std::vector<Landmark>& landmarks) const {
    if (!looks_.made()) looks_.make(landmarks);
    return looks_;
  }

 private:
  FreeIds free_;
  mutable LookIndex looks_;  // a copy is made anew when it is first asked
};

}  // namespace sslam
