// SPDX-License-Identifier: BSD-3-Clause
// Which landmarks lie on each plane: the other side of what every landmark says itself, so that a plane's
// members are found without asking all of the map.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/map/landmark.hpp"

namespace sslam {

class PlaneMembers {
 public:
  // In the order of their ids.
  struct Lists {
    std::vector<LandmarkId> points, lines;

    [[nodiscard]] std::size_t size() const noexcept { return points.size() + lines.size(); }
  };

  // The landmarks are others: they are taken in by the next make().
  void forget() noexcept { made_ = false; }
  [[nodiscard]] bool made() const noexcept { return made_; }

  template <class Points, class Lines>
  void make(const Points& points, const Lines& lines) {
    lists_.clear();
    made_ = true;
    const auto take = [&](const auto& landmarks, auto kind) {
      for (std::size_t i = 0; i < landmarks.size(); ++i)
        if (landmarks[i].alive && landmarks[i].plane != kNone)
          (list(landmarks[i].plane).*kind).push_back(static_cast<LandmarkId>(i));
    };
    take(points, &Lists::points);
    take(lines, &Lists::lines);
  }

  // The landmark lay on plane `from`, and lies on `into` now; kNone: on none.
  void move(LandmarkId id, std::vector<LandmarkId> Lists::*kind, LandmarkId from, LandmarkId into) {
    if (!made_ || from == into) return;
    if (from != kNone) {
      auto& left = list(from).*kind;
      left.erase(std::lower_bound(left.begin(), left.end(), id));
    }
    if (into != kNone) {
      auto& joined = list(into).*kind;
      joined.insert(std::lower_bound(joined.begin(), joined.end(), id), id);
    }
  }

  // After make().
  [[nodiscard]] const Lists& of(LandmarkId plane) const {
    static const Lists none;
    const auto at = static_cast<std::size_t>(plane);
    return at < lists_.size() ? lists_[at] : none;
  }

 private:
  Lists& list(LandmarkId plane) {
    const auto at = static_cast<std::size_t>(plane);
    if (lists_.size() <= at) lists_.resize(at + 1);
    return lists_[at];
  }

  std::vector<Lists> lists_;  // by plane
  bool made_ = false;
};

}  // namespace sslam
