// SPDX-License-Identifier: BSD-3-Clause
// A thread for work that is done beside other work, again and again. A new thread each time would cost memory
// without end: OpenCV (4.6) keeps 0.8 kB for every thread that has ever called it.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace sslam {

class SideThread {
 public:
  SideThread() : thread_([this] { work(); }) {}
  SideThread(const SideThread&) = delete;
  SideThread& operator=(const SideThread&) = delete;
  ~SideThread() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  // Calls `there` in the thread and `here` in the caller's, and waits for both. Throws what one has thrown.
  void run(const std::function<void()>& there, const std::function<void()>& here) {
    {
      const std::lock_guard lock(mutex_);
      there_ = &there;
    }
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      here();
    } catch (...) {
      failure = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return there_ == nullptr; });
    const std::exception_ptr other = std::exchange(failure_, nullptr);
    if (failure || other) std::rethrow_exception(failure ? failure : other);
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return there_ != nullptr || ending_; });
      if (there_ == nullptr) return;
      lock.unlock();
      std::exception_ptr failure;
      try {
        (*there_)();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      failure_ = failure;
      there_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;  // for what follows
  std::condition_variable changed_;
  const std::function<void()>* there_ = nullptr;  // what is to do, until it is done
  std::exception_ptr failure_;
  bool ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace sslam
