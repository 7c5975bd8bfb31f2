// SPDX-License-Identifier: BSD-3-Clause
// Mapping and loop closing in a thread of their own. The locks are held for a moment each, to hand something
// over: the tracker waits for no work of the other side.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "sslam/track/presets.hpp"
#include "sslam/track/upkeep/deferred_upkeep.hpp"
#include "sslam/track/upkeep/map_server.hpp"

namespace sslam::live {

template <Scalar S, MappingStage<S> Mapping, LoopStage<S> Loops>
class MappingThread {
 public:
  std::size_t max_waiting = 3;  // keyframes that are not in the map yet, the one in work among them

  MappingThread() = default;
  MappingThread(const MappingThread&) = delete;
  MappingThread& operator=(const MappingThread&) = delete;
  ~MappingThread() { stop(); }

  // The stages are the thread's until finish() or stop().
  void begin(const Map<S>& map, Mapping& mapping, Loops& loops) {
    stop();
    server_.begin(map);
    ending_ = fresh_ = false;
    thread_ = std::thread([this, &mapping, &loops] { work(mapping, loops); });
  }

  [[nodiscard]] bool running() const noexcept { return thread_.joinable(); }

  [[nodiscard]] bool room() {
    const std::lock_guard lock(mutex_);
    return posts_.size() + (busy_ ? 1 : 0) < max_waiting;
  }

  void post(KeyframePost<S> post) {
    {
      const std::lock_guard lock(mutex_);
      posts_.push_back(std::move(post));
    }
    changed_.notify_one();
  }

  // Throws what has stopped the thread, if something has.
  [[nodiscard]] bool newest(MapSnapshot<S>& snapshot) {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (!fresh_) return false;
    std::swap(snapshot, newest_);
    fresh_ = false;
    return true;
  }

  void finish(MapSnapshot<S>& snapshot) {
    end();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    server_.publish(snapshot);
  }

  // Waits for the keyframe in work alone.
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      posts_.clear();
    }
    end();
    failure_ = nullptr;
  }

 private:
  // The thread ends when it has done what waits.
  void end() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

  void work(Mapping& mapping, Loops& loops) {
    try {
      for (KeyframePost<S> post; next(post); post = {}) {  // frees its memory outside the lock
        server_.take(post, mapping, loops);
        server_.publish(spare_);
        const std::lock_guard lock(mutex_);
        std::swap(spare_, newest_);
        fresh_ = true;
        busy_ = false;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      busy_ = false;
    }
  }

  [[nodiscard]] bool next(KeyframePost<S>& post) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !posts_.empty() || ending_; });
    if (posts_.empty()) return false;
    post = std::move(posts_.front());
    posts_.pop_front();
    busy_ = true;
    return true;
  }

  MapServer<S> server_;   // the thread's, while it runs
  MapSnapshot<S> spare_;  // the thread's too
  std::mutex mutex_;      // for what follows
  std::condition_variable changed_;
  std::deque<KeyframePost<S>> posts_;
  MapSnapshot<S> newest_;
  bool fresh_ = false;  // newest_ has not been taken
  bool busy_ = false;   // a post has been taken that is not in newest_
  bool ending_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

template <Scalar S, MappingStage<S> Mapping, LoopStage<S> Loops>
using ThreadedUpkeep = DeferredUpkeep<S, MappingThread<S, Mapping, Loops>>;
static_assert(UpkeepStage<ThreadedUpkeep<double, KeyframeMapping<double>, NoLoopClosing<double>>, double,
                          KeyframeMapping<double>, NoLoopClosing<double>>);

// The preset of the same name, for live use.
template <Scalar S, StageTimer Timer = NoTimer>
using Structure = presets::With<presets::Structure<S, Timer>,
                                slots::Upkeep<ThreadedUpkeep<S, presets::BundleMapping<S>, LoopClosing<S>>>>;

}  // namespace sslam::live
