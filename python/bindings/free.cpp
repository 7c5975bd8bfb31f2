// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/free.hpp"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "sslam/core/error.hpp"

namespace sslam::python {
namespace {

std::atomic<int> threads_outside = 0;
std::atomic<std::thread::id> ending;  // the thread that ends Python; none as yet

// Of a process that has forked, the child has the thread that did so alone.
void forget_threads() {
  threads_outside = 0;
}

}  // namespace

Free::Outside::Outside() {
  const std::thread::id last = ending;
  if (last != std::thread::id() && last != std::this_thread::get_id())
    throw Error("sslam: Python is ending, and takes no more calls");
  ++threads_outside;
}

Free::Outside::~Outside() {
  --threads_outside;
}

void wait_at_exit() {
  pthread_atfork(nullptr, nullptr, &forget_threads);
  const auto wait = [] {
    ending = std::this_thread::get_id();
    while (threads_outside > 0) {
      const nanobind::gil_scoped_release others;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  nanobind::module_::import_("atexit").attr("register")(nanobind::cpp_function(wait));
}

}  // namespace sslam::python
