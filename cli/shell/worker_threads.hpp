// SPDX-License-Identifier: BSD-3-Clause
// A loop shared by threads, each of which takes the next index when it is done with the last.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sslam::cli {

class WorkerThreads {
 public:
  // 0: one for each processor.
  explicit WorkerThreads(int count)
      : count_(count > 0 ? count : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {}

  // Calls work(i) for every i in [0, count). The first exception stops the loop and is thrown here.
  template <class Work>
  void operator()(std::size_t count, const Work& work) const {
    run(count, [&work] { return [&work](std::size_t i) { work(i); }; });
  }

  // The same, with what make_work() returns as each thread's own work(i).
  template <class MakeWork>
  void run(std::size_t count, const MakeWork& make_work) const {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto loop = [&] {
      try {
        auto work = make_work();
        for (std::size_t i = next++; i < count; i = next++) work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
      }
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < count_; ++i) others.emplace_back(loop);
    loop();
    others.clear();
    if (failure) std::rethrow_exception(failure);
  }

 private:
  int count_;
};

}  // namespace sslam::cli
