// SPDX-License-Identifier: BSD-3-Clause
// A channel without a thread: the map is kept up when the test says so, so that every interleaving can be
// had.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "sslam/track/upkeep/deferred_upkeep.hpp"
#include "sslam/track/upkeep/map_server.hpp"

namespace sslam::testing {

class StepChannel {
 public:
  std::size_t max_waiting = 3;

  template <class Mapping, class Loops>
  void begin(const Map<double>& map, Mapping& mapping, Loops& loops) {
    server_.begin(map);
    posts_.clear();
    fresh_ = false;
    take_ = [this, &mapping, &loops](KeyframePost<double>& post) { server_.take(post, mapping, loops); };
  }
  [[nodiscard]] bool running() const { return take_ != nullptr; }
  [[nodiscard]] bool room() const { return posts_.size() < max_waiting; }
  void post(KeyframePost<double> post) { posts_.push_back(std::move(post)); }
  [[nodiscard]] bool newest(MapSnapshot<double>& snapshot) {
    if (!std::exchange(fresh_, false)) return false;
    std::swap(snapshot, newest_);
    return true;
  }
  void finish(MapSnapshot<double>& snapshot) {
    while (step()) continue;
    server_.publish(snapshot);
    take_ = nullptr;
  }
  void stop() { take_ = nullptr; }

  // Takes the oldest keyframe that waits into the map; false if none does.
  bool step() {
    if (posts_.empty()) return false;
    take_(posts_.front());
    posts_.pop_front();
    server_.publish(newest_);
    fresh_ = true;
    return true;
  }

 private:
  MapServer<double> server_;
  std::deque<KeyframePost<double>> posts_;
  MapSnapshot<double> newest_;
  bool fresh_ = false;
  std::function<void(KeyframePost<double>&)> take_;
};

}  // namespace sslam::testing
