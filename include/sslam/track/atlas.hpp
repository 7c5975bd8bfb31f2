// SPDX-License-Identifier: BSD-3-Clause
// The atlas: worlds that were laid aside when track was lost in them, for when the camera comes back (Elvira,
// Tardos, Montiel, ORBSLAM-Atlas, IROS 2019).
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/track/world.hpp"

namespace sslam {

template <Scalar S>
class Atlas {
 public:
  std::size_t most = 8;  // worlds; the smallest goes for one more. 0: a map is never left

  [[nodiscard]] const std::vector<World<S>>& worlds() const noexcept { return worlds_; }
  [[nodiscard]] std::vector<World<S>>& worlds() noexcept { return worlds_; }

  void lay_aside(World<S> world) {
    worlds_.push_back(std::move(world));
    if (worlds_.size() > most) worlds_.erase(std::min_element(worlds_.begin(), worlds_.end(), smaller));
  }

  // The camera is in another world from now on.
  void forget_meetings() {
    for (World<S>& world : worlds_) world.met.reset();
  }

  [[nodiscard]] World<S> take(std::size_t index) {
    World<S> world = std::move(worlds_[index]);
    worlds_.erase(worlds_.begin() + static_cast<std::ptrdiff_t>(index));
    return world;
  }

  // Each in its turn; worlds().size() where there is none.
  [[nodiscard]] std::size_t next() noexcept { return worlds_.empty() ? 0 : ++turn_ % worlds_.size(); }

  // Of what is aside, that in which most frames were tracked.
  [[nodiscard]] std::size_t largest() const noexcept {
    return static_cast<std::size_t>(std::max_element(worlds_.begin(), worlds_.end(), smaller) -
                                    worlds_.begin());
  }

  [[nodiscard]] static bool smaller(const World<S>& a, const World<S>& b) noexcept {
    return a.log.entries().size() < b.log.entries().size();
  }

 private:
  std::vector<World<S>> worlds_;
  std::size_t turn_ = 0;
};

}  // namespace sslam
