// SPDX-License-Identifier: BSD-3-Clause
// A courier without a thread: the map is kept up when the test says so, so that every interleaving can be
// had.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "sslam/track/deferred_upkeep.hpp"
#include "sslam/track/map_keeper.hpp"

namespace sslam::testing {

class StepCourier {
 public:
  std::size_t max_waiting = 3;

  template <class Mapping, class Loops>
  void begin(const Map<double>& map, Mapping& mapping, Loops& loops) {
    keeper_.begin(map);
    posts_.clear();
    fresh_ = false;
    take_ = [this, &mapping, &loops](KeyframePost<double>& post) { keeper_.take(post, mapping, loops); };
  }
  [[nodiscard]] bool running() const { return take_ != nullptr; }
  [[nodiscard]] bool room() const { return posts_.size() < max_waiting; }
  void post(KeyframePost<double> post) { posts_.push_back(std::move(post)); }
  [[nodiscard]] bool newest(MapEdition<double>& edition) {
    if (!std::exchange(fresh_, false)) return false;
    std::swap(edition, newest_);
    return true;
  }
  void finish(MapEdition<double>& edition) {
    while (step()) continue;
    keeper_.publish(edition);
    take_ = nullptr;
  }
  void stop() { take_ = nullptr; }

  // Takes the oldest keyframe that waits into the map; false if none does.
  bool step() {
    if (posts_.empty()) return false;
    take_(posts_.front());
    posts_.pop_front();
    keeper_.publish(newest_);
    fresh_ = true;
    return true;
  }

 private:
  MapKeeper<double> keeper_;
  std::deque<KeyframePost<double>> posts_;
  MapEdition<double> newest_;
  bool fresh_ = false;
  std::function<void(KeyframePost<double>&)> take_;
};

}  // namespace sslam::testing
