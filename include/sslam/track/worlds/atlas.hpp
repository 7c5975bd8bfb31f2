// SPDX-License-Identifier: BSD-3-Clause
// The atlas: worlds that were laid aside when track was lost in them, for when the camera comes back (Elvira,
// Tardos, Montiel, ORBSLAM-Atlas, IROS 2019).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/track/worlds/world.hpp"

namespace sslam {

template <Scalar S>
struct AtlasOptions {
  std::size_t most = 8;  // worlds; the smallest goes for one more. 0: a map is never left

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("most", self.most, Unit::kCount, 0, 1000,
          "maps that are kept for when the camera comes back; 0: a lost map is never left");
  }
};
static_assert(Described<AtlasOptions<double>>);

template <Scalar S>
class Atlas {
 public:
  AtlasOptions<S> options;

  [[nodiscard]] const std::vector<World<S>>& worlds() const noexcept { return worlds_; }
  [[nodiscard]] std::vector<World<S>>& worlds() noexcept { return worlds_; }

  void lay_aside(World<S> world) {
    worlds_.push_back(std::move(world));
    if (worlds_.size() > options.most)
      worlds_.erase(std::min_element(worlds_.begin(), worlds_.end(), smaller));
  }

  // The camera is in another world from now on.
  void forget_place_matches() {
    for (World<S>& world : worlds_) world.met.reset();
  }

  // `world` is one of worlds().
  [[nodiscard]] World<S> take(World<S>& world) {
    const auto at = worlds_.begin() + (&world - worlds_.data());
    World<S> taken = std::move(*at);
    worlds_.erase(at);
    return taken;
  }

  // Each in its turn; null where there is none.
  [[nodiscard]] World<S>* next() noexcept {
    return worlds_.empty() ? nullptr : &worlds_[++turn_ % worlds_.size()];
  }

  // Of what is aside, that in which most frames were tracked; null where there is none.
  [[nodiscard]] World<S>* largest() noexcept {
    return worlds_.empty() ? nullptr : &*std::max_element(worlds_.begin(), worlds_.end(), smaller);
  }

  // The world of which the keyframe of `map` shows a place, as an earlier one did; null where there is none.
  template <PlaceFinder<S> Finder>
  [[nodiscard]] World<S>* met_by(const Map<S>& map, KeyframeId id, Finder& finder) {
    const Keyframe<S>& keyframe = map.keyframes[map.index(id)];
    const auto met = std::find_if(worlds_.begin(), worlds_.end(), [&](World<S>& world) {
      const std::optional<Loop<S>> place = finder.find(map, id, world.map);
      return place && finder.confirmed(keyframe, world.map, *place, world.met);
    });
    return met == worlds_.end() ? nullptr : &*met;
  }

  [[nodiscard]] static bool smaller(const World<S>& a, const World<S>& b) noexcept {
    return a.log.entries().size() < b.log.entries().size();
  }

 private:
  std::vector<World<S>> worlds_;
  std::size_t turn_ = 0;
};

}  // namespace sslam
